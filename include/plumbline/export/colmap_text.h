// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

// `camera` with the snapshot's refined lens, if it holds one.
Camera CameraOf(const MapDelta& snapshot, const Camera& camera);

// Writes cameras.txt, images.txt and points3D.txt, COLMAP's text model (COLMAP documentation,
// "Output Format"), into `folder`, which is made if need be. Each file is replaced as a whole.
//   camera  PINHOLE, OPENCV or FULL_OPENCV: the smallest that holds the distortion exactly.
//   pixels  COLMAP's (0.5, 0.5) is the centre of the top-left pixel, Plumbline's is (0, 0): the
//           principal point and all observations are shifted.
//   poses   cam_from_map, quaternion w first, in the map's frame and unit of length.
//   ids     photo and landmark ids plus one; of a photo's features only those with a landmark.
// Numbers are written so that they read back to the last bit. `snapshot` is the whole map; `camera`
// is as the session holds it. Throws std::runtime_error naming the file and the cause.
void ExportColmapText(const MapDelta& snapshot, const Camera& camera, const std::string& folder);

}  // namespace plumb
