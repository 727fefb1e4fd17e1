// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/track_geometry.h"

#include <algorithm>

#include "plumbline/geometry/triangulation.h"

namespace plumb {
namespace {

std::vector<Observation> AgreeingWith(const Camera& camera,
                                      const Map& map,
                                      const std::vector<Observation>& candidates,
                                      const Eigen::Vector3d& point_in_map,
                                      double max_error_px) {
  std::vector<Observation> agreeing;
  for (const Observation& candidate : candidates) {
    if (IsSeenIn(agreeing, candidate.photo)) continue;
    const auto error = ReprojectionError(camera, map, candidate, point_in_map);
    if (error && *error <= max_error_px) agreeing.push_back(candidate);
  }
  return agreeing;
}

std::optional<Eigen::Vector3d> TriangulateTrack(const Map& map,
                                                const PhotoRecords& photos,
                                                const std::vector<Observation>& track) {
  std::vector<NormalizedObservation> rays;
  for (const Observation& observation : track) {
    rays.push_back({&map.view(observation.photo).cam_from_map,
                    photos.at(observation.photo).normalized[observation.feature_idx]});
  }
  return TriangulateViews(rays);
}

}  // namespace

std::optional<double> ReprojectionError(const Camera& camera,
                                        const Map& map,
                                        const Observation& observation,
                                        const Eigen::Vector3d& point_in_map) {
  const auto pixel = camera.Project(map.view(observation.photo).cam_from_map * point_in_map);
  if (!pixel) return std::nullopt;
  return (*pixel - map.PixelOf(observation)).norm();
}

bool IsSeenIn(const std::vector<Observation>& track, PhotoId photo) {
  return std::any_of(track.begin(), track.end(), [&](const Observation& observation) {
    return observation.photo == photo;
  });
}

double LargestParallax(const Map& map,
                       const std::vector<Observation>& track,
                       const Eigen::Vector3d& point_in_map) {
  std::vector<Eigen::Vector3d> rays;
  for (const Observation& observation : track) {
    const Rigid3& cam_from_map = map.view(observation.photo).cam_from_map;
    rays.push_back((point_in_map - cam_from_map.TargetOriginInSource()).normalized());
  }
  double smallest_cosine = 1.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (std::size_t j = i + 1; j < rays.size(); ++j) {
      smallest_cosine = std::min(smallest_cosine, rays[i].dot(rays[j]));
    }
  }
  return std::acos(std::clamp(smallest_cosine, -1.0, 1.0));
}

std::optional<TriangulatedTrack> TriangulateCandidates(const Camera& camera,
                                                       const Map& map,
                                                       const PhotoRecords& photos,
                                                       const std::vector<Observation>& candidates,
                                                       double max_error_px,
                                                       double min_parallax_rad) {
  const auto ray = [&](const Observation& observation) -> const Eigen::Vector2d& {
    return photos.at(observation.photo).normalized[observation.feature_idx];
  };
  const Rigid3& first = map.view(candidates[0].photo).cam_from_map;
  std::optional<TriangulatedTrack> best;
  double best_parallax = 0.0;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const Rigid3& other = map.view(candidates[i].photo).cam_from_map;
    const auto point = TriangulateTwoViews(first, other, ray(candidates[0]), ray(candidates[i]));
    if (!point) continue;
    std::vector<Observation> track = AgreeingWith(camera, map, candidates, *point, max_error_px);
    if (track.size() < 2 || !(track[0] == candidates[0])) continue;
    const double parallax = LargestParallax(map, track, *point);
    if (parallax < min_parallax_rad) continue;
    const bool is_better = !best || track.size() > best->track.size() ||
                           (track.size() == best->track.size() && parallax > best_parallax);
    if (!is_better) continue;
    best = TriangulatedTrack{*point, std::move(track)};
    best_parallax = parallax;
  }
  if (!best || best->track.size() == 2) return best;

  const auto refined = TriangulateTrack(map, photos, best->track);
  if (!refined) return best;
  std::vector<Observation> track = AgreeingWith(camera, map, candidates, *refined, max_error_px);
  if (track.size() >= best->track.size() && track[0] == candidates[0]) {
    best = TriangulatedTrack{*refined, std::move(track)};
  }
  return best;
}

}  // namespace plumb
