// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/lookalike_place.h"

#include <algorithm>
#include <optional>

#include "plumbline/geometry/absolute_pose.h"
#include "plumbline/geometry/triangulation.h"
#include "sfm/likeness.h"

namespace plumb {
namespace {

// Nearer than this part of the photo's width a like feature is the point itself, or a neighbour.
constexpr double kMinShiftRatio = 0.04;

// Copies that agree on a pose within this radius belong to one place [px].
constexpr double kRadius_px = 8.0;

// Fewer agree by chance. So may 13 of 215, as on Herz-Jesus-P8, but on a turned camera.
constexpr int kMinNumCopies = 12;

// Windows repeat to the left, to the right, above and below. The copies of one place taken out,
// the next one shows.
constexpr int kMaxNumPlaces = 4;

// A bay further on the camera looks the same way. Poses of chance, 13 copies on Herz-Jesus-P8, are
// turned by 16 degrees and more.
constexpr double kMaxTurn_rad = 0.1;

constexpr double kConfidence = 0.99;

// Points and the features that look like them elsewhere in the photo.
struct Copies {
  std::vector<Eigen::Vector2d> xy;
  std::vector<Eigen::Vector3d> points_in_map;
};

class LookalikeSearch {
 public:
  LookalikeSearch(const LookalikeOptions& options,
                  const Camera& camera,
                  const PhotoRecord& photo,
                  const std::vector<SeenPoint>& points)
      : options_(options), camera_(camera), photo_(photo), points_(points) {}

  Copies FindCopies(const Rigid3& cam_from_map) const {
    Copies copies;
    const auto max_samples = static_cast<std::size_t>(options_.max_samples);
    const std::size_t step = (points_.size() + max_samples - 1) / max_samples;
    for (std::size_t i = 0; i < points_.size(); i += step) {
      const auto copy = FindCopy(points_[i], (cam_from_map * points_[i].point_in_map).z());
      if (!copy) continue;
      copies.xy.push_back(photo_.normalized[*copy]);
      copies.points_in_map.push_back(points_[i].point_in_map);
    }
    return copies;
  }

  // Of the points in view from there, the share that the photo shows again; 0 if they are too few
  // to compare.
  double ShareFoundFrom(const Rigid3& cam_from_map) const {
    int num_in_view = 0;
    int num_found = 0;
    std::vector<std::uint32_t> nearby;
    for (const SeenPoint& point : points_) {
      const Eigen::Vector3d in_cam = cam_from_map * point.point_in_map;
      const auto pixel = camera_.Project(in_cam);
      if (!pixel || !camera_.IsInImage(*pixel)) continue;
      ++num_in_view;
      photo_.grid->FindWithin(*pixel, kRadius_px, &nearby);
      const double scale_px = point.scale_at_unit_depth_px / in_cam.z();
      const bool is_found = std::any_of(nearby.begin(), nearby.end(), [&](std::uint32_t idx) {
        return IsScaleAlike(photo_.features->features[idx].scale_px, scale_px) &&
               DistanceTo(point, idx) < kMaxSquaredDistance;
      });
      if (is_found) ++num_found;
    }
    const double enough = options_.min_common_share * static_cast<double>(points_.size());
    return num_in_view == 0 || num_in_view < enough ? 0.0
                                                    : num_found / static_cast<double>(num_in_view);
  }

 private:
  std::int32_t DistanceTo(const SeenPoint& point, std::uint32_t feature_idx) const {
    return SquaredDistance(
        point.descriptor,
        photo_.features->descriptors.row(static_cast<Eigen::Index>(feature_idx)).data());
  }

  // The feature that looks most like the point, of those away from it.
  std::optional<std::uint32_t> FindCopy(const SeenPoint& point, double depth) const {
    const std::vector<Feature>& features = photo_.features->features;
    const double scale_px = point.scale_at_unit_depth_px / depth;
    const double min_shift_px = kMinShiftRatio * camera_.width_px();
    std::int32_t best = kMaxSquaredDistance;
    std::optional<std::uint32_t> copy;
    // Features are ordered by decreasing scale.
    const auto begin =
        std::partition_point(features.begin(), features.end(), [&](const Feature& feature) {
          return feature.scale_px > kMaxScaleRatio * scale_px;
        });
    for (auto it = begin; it != features.end(); ++it) {
      if (!IsScaleAlike(it->scale_px, scale_px)) break;
      if ((it->Pixel() - point.pixel).squaredNorm() < min_shift_px * min_shift_px) continue;
      const auto idx = static_cast<std::uint32_t>(it - features.begin());
      const std::int32_t distance = DistanceTo(point, idx);
      if (distance >= best) continue;
      best = distance;
      copy = idx;
    }
    return copy;
  }

  const LookalikeOptions& options_;
  const Camera& camera_;
  const PhotoRecord& photo_;
  const std::vector<SeenPoint>& points_;
};

Copies Without(const Copies& copies, const std::vector<char>& is_taken) {
  Copies rest;
  for (std::size_t i = 0; i < copies.xy.size(); ++i) {
    if (is_taken[i]) continue;
    rest.xy.push_back(copies.xy[i]);
    rest.points_in_map.push_back(copies.points_in_map[i]);
  }
  return rest;
}

SeenPoint AsSeen(const FeatureSet& features,
                 std::uint32_t feature_idx,
                 const Eigen::Vector3d& point_in_map,
                 double depth,
                 const Eigen::Vector2d& pixel) {
  return {point_in_map,
          features.features[feature_idx].scale_px * depth,
          features.descriptors.row(static_cast<Eigen::Index>(feature_idx)).data(),
          pixel};
}

}  // namespace

std::vector<SeenPoint> InliersAsSeen(const Map& map,
                                     const PhotoRecord& photo,
                                     const std::vector<PhotoId>& views,
                                     const Localization& localization) {
  std::vector<SeenPoint> points;
  for (const MapMatch& match : localization.inliers) {
    const Landmark& landmark = map.landmark(match.landmark);
    const auto is_of_views = [&](const Observation& observation) {
      return std::find(views.begin(), views.end(), observation.photo) != views.end();
    };
    const auto seen = std::find_if(landmark.track.begin(), landmark.track.end(), is_of_views);
    if (seen == landmark.track.end()) continue;
    const View& view = map.view(seen->photo);
    points.push_back(AsSeen(*view.features,
                            seen->feature_idx,
                            landmark.position_in_map,
                            (view.cam_from_map * landmark.position_in_map).z(),
                            photo.features->features[match.feature_idx].Pixel()));
  }
  return points;
}

std::vector<SeenPoint> PairAsSeen(const Camera& camera,
                                  const PhotoRecord& photo1,
                                  const PhotoRecord& photo2,
                                  const std::vector<FeatureMatch>& matches,
                                  const Rigid3& cam2_from_cam1,
                                  double max_error_px) {
  std::vector<SeenPoint> points;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector2d& xy1 = photo1.normalized[match.idx1];
    const auto point_in_cam1 =
        TriangulateTwoViews(Rigid3(), cam2_from_cam1, xy1, photo2.normalized[match.idx2]);
    if (!point_in_cam1) continue;
    const Eigen::Vector2d pixel2 = photo2.features->features[match.idx2].Pixel();
    const auto projected2 = camera.Project(cam2_from_cam1 * *point_in_cam1);
    if (!projected2 || (*projected2 - pixel2).norm() > max_error_px) continue;
    points.push_back(
        AsSeen(*photo1.features, match.idx1, *point_in_cam1, point_in_cam1->z(), pixel2));
  }
  return points;
}

double LookalikeShare(const LookalikeOptions& options,
                      const Camera& camera,
                      const PhotoRecord& photo,
                      const std::vector<SeenPoint>& points,
                      const Rigid3& cam_from_map) {
  const LookalikeSearch search(options, camera, photo, points);
  AbsolutePoseOptions pose_options;
  pose_options.max_error = kRadius_px / camera.MeanFocalLength();
  pose_options.confidence = kConfidence;
  pose_options.min_iterations = std::min(pose_options.min_iterations, options.max_iterations);
  pose_options.max_iterations = options.max_iterations;
  pose_options.random_seed = options.random_seed;
  double largest_share = 0.0;
  Copies copies = search.FindCopies(cam_from_map);
  for (int place = 0; place < kMaxNumPlaces; ++place) {
    if (copies.xy.size() < static_cast<std::size_t>(kMinNumCopies)) break;
    const auto elsewhere = EstimateAbsolutePose(pose_options, copies.xy, copies.points_in_map);
    if (!elsewhere || elsewhere->num_inliers < kMinNumCopies) break;
    const Rigid3& other_from_map = elsewhere->cam_from_map;
    if (other_from_map.rotation.angularDistance(cam_from_map.rotation) < kMaxTurn_rad) {
      largest_share = std::max(largest_share, search.ShareFoundFrom(other_from_map));
    }
    copies = Without(copies, elsewhere->is_inlier);
  }
  return largest_share;
}

}  // namespace plumb
