// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map.h"
#include "sfm/photo_record.h"

namespace plumb {

// Distance between an observation and where its view projects the point [raw px]; nothing if the
// point is not in front of the camera.
std::optional<double> ReprojectionError(const Camera& camera,
                                        const Map& map,
                                        const Observation& observation,
                                        const Eigen::Vector3d& point_in_map);

// True if the track holds an observation of that photo.
bool IsSeenIn(const std::vector<Observation>& track, PhotoId photo);

// Largest angle between two rays of the track [rad].
double LargestParallax(const Map& map,
                       const std::vector<Observation>& track,
                       const Eigen::Vector3d& point_in_map);

struct TriangulatedTrack {
  Eigen::Vector3d point_in_map;
  std::vector<Observation> track;  // Those of the candidates that agree, one a view.
};

// Finds the point that most of the candidates agree on, from the pair of rays with the largest
// parallax that any other candidates support. The first candidate is always part of it. Nothing if
// no point has two observations within `max_error_px` and `min_parallax_rad`.
std::optional<TriangulatedTrack> TriangulateCandidates(const Camera& camera,
                                                       const Map& map,
                                                       const PhotoRecords& photos,
                                                       const std::vector<Observation>& candidates,
                                                       double max_error_px,
                                                       double min_parallax_rad);

}  // namespace plumb
