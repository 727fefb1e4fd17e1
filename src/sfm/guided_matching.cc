// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "plumbline/common/check.h"
#include "plumbline/geometry/absolute_pose.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "sfm/likeness.h"
#include "sfm/localizer.h"

namespace plumb {
namespace {

// Lowe's ratio, squared, against the second-best feature within the search radius.
constexpr double kMaxSquaredRatio = 0.8 * 0.8;

struct PredictedLandmark {
  LandmarkId id;
  Eigen::Vector2d pixel;
  double scale_px = 0.0;
  const std::uint8_t* descriptor = nullptr;
};

class GuidedMatcher {
 public:
  GuidedMatcher(const LocalizerOptions& options,
                const Camera& camera,
                const Map& map,
                const PhotoRecord& photo)
      : options_(options), camera_(camera), map_(map), photo_(photo) {}

  std::vector<MapMatch> Match(const Localization& localization, const std::vector<PhotoId>& views) {
    std::set<LandmarkId> seen;
    std::vector<char> is_feature_used(photo_.features->size(), 0);
    for (const MapMatch& match : localization.inliers) {
      seen.insert(match.landmark);
      is_feature_used[match.feature_idx] = 1;
    }
    std::vector<MapMatch> matches;
    for (const PhotoId view : views) {
      for (const LandmarkId id : map_.view(view).landmark_of_feature) {
        if (!id.IsValid() || !seen.insert(id).second) continue;
        const auto predicted = Predict(id, view, localization.cam_from_map);
        if (!predicted) continue;
        const auto feature_idx = BestFeature(*predicted);
        if (!feature_idx || is_feature_used[*feature_idx]) continue;
        is_feature_used[*feature_idx] = 1;
        matches.push_back({*feature_idx, id});
      }
    }
    return matches;
  }

 private:
  std::optional<PredictedLandmark> Predict(LandmarkId id,
                                           PhotoId view_id,
                                           const Rigid3& cam_from_map) const {
    const Landmark& landmark = map_.landmark(id);
    const Eigen::Vector3d point_in_cam = cam_from_map * landmark.position_in_map;
    const auto pixel = camera_.Project(point_in_cam);
    if (!pixel || !camera_.IsInImage(*pixel)) return std::nullopt;
    const auto observation =
        std::find_if(landmark.track.begin(), landmark.track.end(), [&](const Observation& other) {
          return other.photo == view_id;
        });
    const View& view = map_.view(view_id);
    const double depth_in_view = (view.cam_from_map * landmark.position_in_map).z();
    const double scale = view.features->features[observation->feature_idx].scale_px *
                         depth_in_view / point_in_cam.z();
    return PredictedLandmark{
        id,
        *pixel,
        scale,
        view.features->descriptors.row(static_cast<Eigen::Index>(observation->feature_idx)).data()};
  }

  std::optional<std::uint32_t> BestFeature(const PredictedLandmark& predicted) {
    photo_.grid->FindWithin(predicted.pixel, options_.guided_radius_px, &nearby_);
    std::int32_t best = kMaxSquaredDistance;
    std::int32_t second = 2 * kMaxSquaredDistance;
    std::optional<std::uint32_t> best_idx;
    for (const std::uint32_t idx : nearby_) {
      if (!IsScaleAlike(photo_.features->features[idx].scale_px, predicted.scale_px)) continue;
      const std::int32_t distance =
          SquaredDistance(predicted.descriptor,
                          photo_.features->descriptors.row(static_cast<Eigen::Index>(idx)).data());
      if (distance < best) {
        second = best_idx ? best : second;
        best = distance;
        best_idx = idx;
      } else {
        second = std::min(second, distance);
      }
    }
    if (!best_idx || best > kMaxSquaredRatio * second) return std::nullopt;
    return photo_.first_at_spot[*best_idx];
  }

  const LocalizerOptions& options_;
  const Camera& camera_;
  const Map& map_;
  const PhotoRecord& photo_;
  std::vector<std::uint32_t> nearby_;
};

}  // namespace

void ExtendByGuidedMatching(const LocalizerOptions& options,
                            const Camera& camera,
                            const Map& map,
                            const PhotoRecord& photo,
                            const std::vector<PhotoId>& views,
                            Localization* localization) {
  PLUMB_CHECK(localization->status == Localization::Status::kOk);
  std::vector<MapMatch> matches = localization->inliers;
  for (const MapMatch& match :
       GuidedMatcher(options, camera, map, photo).Match(*localization, views)) {
    matches.push_back(match);
  }
  RefineOnMatches(options, camera, map, photo, matches, options.max_refined_error_px, localization);
}

}  // namespace plumb
