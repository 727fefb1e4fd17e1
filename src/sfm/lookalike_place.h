// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/map/map.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "plumbline/sfm/lookalike_options.h"
#include "sfm/localizer.h"
#include "sfm/photo_record.h"

namespace plumb {

// A point that a photo shows, as another view saw it.
struct SeenPoint {
  Eigen::Vector3d point_in_map;
  double scale_at_unit_depth_px = 0.0;       // Of its feature.
  const std::uint8_t* descriptor = nullptr;  // kDescriptorSize bytes, owned by the view.
  Eigen::Vector2d pixel;                     // Where the photo shows it.
};

// The inliers of a localization, as one of `views` saw them.
std::vector<SeenPoint> InliersAsSeen(const Map& map,
                                     const PhotoRecord& photo,
                                     const std::vector<PhotoId>& views,
                                     const Localization& localization);

// The matches of two photos that agree with their relative pose within `max_error_px`, as the
// first saw them and the second shows them; the map is the first's camera frame. idx1 of the
// matches belongs to `photo1`.
std::vector<SeenPoint> PairAsSeen(const Camera& camera,
                                  const PhotoRecord& photo1,
                                  const PhotoRecord& photo2,
                                  const std::vector<FeatureMatch>& matches,
                                  const Rigid3& cam2_from_cam1,
                                  double max_error_px);

// How much the photo would look the same from elsewhere, a bay further on: the share of the points
// in view from there that it shows again, 0 to 1. The distinct matches cannot tell: of two like
// places they know only the one that looks most like. So each point is looked for in the rest of
// the photo; what is found agrees on another pose, and from there the points are searched again,
// by place and look. Deterministic. Thread-safe.
double LookalikeShare(const LookalikeOptions& options,
                      const Camera& camera,
                      const PhotoRecord& photo,
                      const std::vector<SeenPoint>& points,
                      const Rigid3& cam_from_map);

}  // namespace plumb
