// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/bundle_noise.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace plumb::internal {
namespace {

// One landmark in so many is kept; of those, a half, a quarter and so on are looked at once they
// are more than kMaxTracks: their measurements tell a second decimal of the noise, and the time
// does not grow with the map.
constexpr std::uint32_t kOneIn = 16;
constexpr std::size_t kMaxTracks = 2000;
constexpr std::size_t kMinResiduals = 100;

// Of a normal distribution: sigma / median of the absolute values.
constexpr double kSigmaByMedian = 1.4826;

bool IsSampled(LandmarkId id) { return id.IsValid() && id.value % kOneIn == 0; }

}  // namespace

void BundleNoise::Apply(const MapDelta& delta) {
  if (delta.is_snapshot) tracks_.clear();
  Remove(delta);
  for (const LandmarkState& landmark : delta.landmarks_set) {
    if (IsSampled(landmark.id)) tracks_[landmark.id].position_in_map = landmark.position_in_map;
  }
  for (const ObservationState& observation : delta.observations_added) {
    const auto found = tracks_.find(observation.landmark);
    if (found == tracks_.end()) continue;
    found->second.pixel_of_feature[{observation.photo, observation.feature_idx}] =
        observation.pixel;
  }
}

void BundleNoise::Remove(const MapDelta& delta) {
  for (const ObservationState& observation : delta.observations_removed) {
    const auto found = tracks_.find(observation.landmark);
    if (found == tracks_.end()) continue;
    found->second.pixel_of_feature.erase({observation.photo, observation.feature_idx});
  }
  for (const LandmarkId id : delta.landmarks_removed) tracks_.erase(id);
  if (delta.views_removed.empty()) return;
  const std::set<PhotoId> gone(delta.views_removed.begin(), delta.views_removed.end());
  for (auto& [id, track] : tracks_) {
    for (auto it = track.pixel_of_feature.begin(); it != track.pixel_of_feature.end();) {
      it = gone.count(it->first.first) != 0 ? track.pixel_of_feature.erase(it) : std::next(it);
    }
  }
}

std::optional<double> BundleNoise::Estimate(const Camera& camera,
                                            const std::map<PhotoId, Rigid3>& cam_from_map) const {
  std::vector<double> residuals;
  std::uint32_t one_in = kOneIn;
  while (tracks_.size() * kOneIn / one_in > kMaxTracks) one_in *= 2;
  for (const auto& [id, track] : tracks_) {
    if (id.value % one_in != 0) continue;
    const std::size_t first = residuals.size();
    for (const auto& [feature, measured] : track.pixel_of_feature) {
      const auto view = cam_from_map.find(feature.first);
      if (view == cam_from_map.end()) continue;
      const auto pixel = camera.Project(view->second * track.position_in_map);
      if (!pixel) continue;
      for (int k = 0; k < 2; ++k) residuals.push_back(std::abs((*pixel)[k] - measured[k]));
    }
    // The point was fitted to them: three of their degrees of freedom are gone, and with two
    // photos what is left are errors of poses as much as noise.
    const double num = static_cast<double>(residuals.size() - first);
    if (num < 6.0) {
      residuals.resize(first);
      continue;
    }
    const double growth = std::sqrt(num / (num - 3.0));
    for (std::size_t i = first; i < residuals.size(); ++i) residuals[i] *= growth;
  }
  if (residuals.size() < kMinResiduals) return std::nullopt;
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return std::isfinite(*middle) ? std::optional(kSigmaByMedian * *middle) : std::nullopt;
}

}  // namespace plumb::internal
