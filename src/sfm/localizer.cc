// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/localizer.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <set>

#include "plumbline/geometry/absolute_pose.h"

namespace plumb {
namespace {

constexpr double kDegree = M_PI / 180.0;

// The matches as the pose solvers take them.
struct MatchArrays {
  std::vector<Eigen::Vector2d> xy;
  std::vector<Eigen::Vector3d> points_in_map;
};

MatchArrays ToArrays(const Map& map,
                     const PhotoRecord& photo,
                     const std::vector<MapMatch>& matches) {
  MatchArrays arrays;
  for (const MapMatch& match : matches) {
    arrays.xy.push_back(photo.normalized[match.feature_idx]);
    arrays.points_in_map.push_back(map.landmark(match.landmark).position_in_map);
  }
  return arrays;
}

AbsolutePoseOptions PoseOptions(const LocalizerOptions& options, const Camera& camera) {
  AbsolutePoseOptions pose_options;
  pose_options.max_error = options.max_error_px / camera.MeanFocalLength();
  pose_options.confidence = options.confidence;
  pose_options.min_iterations = options.min_iterations;
  pose_options.max_iterations = options.max_iterations;
  pose_options.random_seed = options.random_seed;
  return pose_options;
}

double MedianDepth(const Rigid3& cam_from_map,
                   const MatchArrays& arrays,
                   const std::vector<char>& is_inlier) {
  std::vector<double> depths;
  for (std::size_t i = 0; i < arrays.points_in_map.size(); ++i) {
    if (is_inlier[i]) depths.push_back((cam_from_map * arrays.points_in_map[i]).z());
  }
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

bool IsSamePlace(const LocalizerOptions& options,
                 const Rigid3& cam1_from_map,
                 const Rigid3& cam2_from_map,
                 double median_depth) {
  const double angle = cam1_from_map.rotation.angularDistance(cam2_from_map.rotation);
  const double distance =
      (cam1_from_map.TargetOriginInSource() - cam2_from_map.TargetOriginInSource()).norm();
  return angle < options.same_pose_angle_deg * kDegree &&
         distance < options.same_pose_distance_ratio * median_depth;
}

// Iterations after which a pose with `num_inliers` of `num_matches` is found with 99 %.
int IterationsToFind(double num_inliers, std::size_t num_matches, int max_iterations) {
  const double ratio = std::min(0.99, num_inliers / static_cast<double>(num_matches));
  const double iterations = std::log(0.01) / std::log(1.0 - ratio * ratio * ratio);
  return static_cast<int>(std::min<double>(max_iterations, std::ceil(iterations)));
}

// Repeated windows: do the matches that contradict the pose agree on another one?
bool FitsSecondPlace(const LocalizerOptions& options,
                     const Camera& camera,
                     const MatchArrays& arrays,
                     const AbsolutePoseResult& first) {
  MatchArrays rest;
  for (std::size_t i = 0; i < arrays.xy.size(); ++i) {
    if (first.is_inlier[i]) continue;
    rest.xy.push_back(arrays.xy[i]);
    rest.points_in_map.push_back(arrays.points_in_map[i]);
  }
  const double enough = options.max_second_pose_ratio * first.num_inliers;
  if (static_cast<double>(rest.xy.size()) < enough || rest.xy.size() < 4) return false;

  AbsolutePoseOptions pose_options = PoseOptions(options, camera);
  pose_options.max_iterations = IterationsToFind(enough, rest.xy.size(), options.max_iterations);
  pose_options.min_iterations = std::min(options.min_iterations, pose_options.max_iterations);
  const auto second = EstimateAbsolutePose(pose_options, rest.xy, rest.points_in_map);
  if (!second || second->num_inliers < enough) return false;
  const double depth = MedianDepth(first.cam_from_map, arrays, first.is_inlier);
  return !IsSamePlace(options, first.cam_from_map, second->cam_from_map, depth);
}

struct ScoredMatch {
  MapMatch match;
  double error_px = 0.0;
};

// Matches within `max_error_px` of the pose, best first, each feature and landmark once.
std::vector<ScoredMatch> OneToOneInliers(const Camera& camera,
                                         const Map& map,
                                         const PhotoRecord& photo,
                                         const std::vector<MapMatch>& matches,
                                         const Rigid3& cam_from_map,
                                         double max_error_px) {
  std::vector<ScoredMatch> scored;
  for (const MapMatch& match : matches) {
    const auto pixel = camera.Project(cam_from_map * map.landmark(match.landmark).position_in_map);
    if (!pixel) continue;
    const double error = (*pixel - photo.features->features[match.feature_idx].Pixel()).norm();
    if (error <= max_error_px) scored.push_back({match, error});
  }
  std::stable_sort(scored.begin(), scored.end(), [](const ScoredMatch& a, const ScoredMatch& b) {
    return a.error_px < b.error_px;
  });
  std::vector<char> is_feature_used(photo.features->size(), 0);
  std::set<LandmarkId> used_landmarks;
  std::vector<ScoredMatch> inliers;
  for (const ScoredMatch& candidate : scored) {
    if (is_feature_used[candidate.match.feature_idx]) continue;
    if (!used_landmarks.insert(candidate.match.landmark).second) continue;
    is_feature_used[candidate.match.feature_idx] = 1;
    inliers.push_back(candidate);
  }
  return inliers;
}

std::vector<MapMatch> MatchesOf(const std::vector<ScoredMatch>& scored) {
  std::vector<MapMatch> matches;
  for (const ScoredMatch& match : scored) matches.push_back(match.match);
  return matches;
}

int NumOccupiedCells(const Camera& camera,
                     const PhotoRecord& photo,
                     const std::vector<MapMatch>& matches) {
  std::bitset<64> cells;
  for (const MapMatch& match : matches) {
    const Feature& feature = photo.features->features[match.feature_idx];
    const int column = std::clamp(
        static_cast<int>(8.0F * feature.x_px / static_cast<float>(camera.width_px())), 0, 7);
    const int row = std::clamp(
        static_cast<int>(8.0F * feature.y_px / static_cast<float>(camera.height_px())), 0, 7);
    cells.set(static_cast<std::size_t>(8 * row + column));
  }
  return static_cast<int>(cells.count());
}

}  // namespace

Localization LocalizePhoto(const LocalizerOptions& options,
                           const Camera& camera,
                           const Map& map,
                           const PhotoRecord& photo,
                           const std::vector<MapMatch>& matches) {
  Localization result;
  result.num_matches = static_cast<int>(matches.size());
  if (result.num_matches < options.min_num_matches) return result;

  const MatchArrays arrays = ToArrays(map, photo, matches);
  const auto pose =
      EstimateAbsolutePose(PoseOptions(options, camera), arrays.xy, arrays.points_in_map);
  result.status = Localization::Status::kTooFewInliers;
  if (!pose) return result;

  result.cam_from_map = pose->cam_from_map;
  RefineOnMatches(options, camera, map, photo, matches, options.max_error_px, &result);
  RefineOnMatches(options, camera, map, photo, matches, options.max_refined_error_px, &result);
  if (static_cast<int>(result.inliers.size()) < options.min_num_inliers ||
      NumOccupiedCells(camera, photo, result.inliers) < options.min_num_cells) {
    return result;
  }
  if (FitsSecondPlace(options, camera, arrays, *pose)) {
    result.status = Localization::Status::kAmbiguous;
    return result;
  }
  result.status = Localization::Status::kOk;
  return result;
}

void RefineOnMatches(const LocalizerOptions& options,
                     const Camera& camera,
                     const Map& map,
                     const PhotoRecord& photo,
                     const std::vector<MapMatch>& matches,
                     double max_error_px,
                     Localization* localization) {
  const auto inliers_within = [&](double bound_px) {
    return OneToOneInliers(camera, map, photo, matches, localization->cam_from_map, bound_px);
  };
  std::vector<ScoredMatch> inliers = inliers_within(max_error_px);
  if (inliers.size() >= 4) {
    const MatchArrays arrays = ToArrays(map, photo, MatchesOf(inliers));
    localization->cam_from_map =
        RefineAbsolutePose(localization->cam_from_map,
                           arrays.xy,
                           arrays.points_in_map,
                           std::vector<char>(arrays.xy.size(), 1),
                           0.25 * options.max_refined_error_px / camera.MeanFocalLength());
    inliers = inliers_within(options.max_refined_error_px);
  }
  localization->inliers = MatchesOf(inliers);
  localization->median_error_px = inliers.empty() ? 0.0 : inliers[inliers.size() / 2].error_px;
}

}  // namespace plumb
