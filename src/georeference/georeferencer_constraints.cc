// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "plumbline/georeference/georeferencer.h"

namespace plumb {
namespace {

// No survey is better.
constexpr double kLeastSigma_m = 1e-4;

MeasuredPosition ToMap(const SurveyTarget& target,
                       const GeoFrame& frame,
                       const Similarity3& enu_from_map) {
  return {enu_from_map.Inverse() * frame.ToEnu(target.point_in_crs),
          std::max(target.sigma_m, kLeastSigma_m) / enu_from_map.scale};
}

}  // namespace

// One standard deviation for all three coordinates: the largest.
void Georeferencer::AddCenters(BundleConstraints* constraints) const {
  if (!options_.gps_in_bundle || !gps_enu_from_map_) return;
  const double sigma_m = std::max(options_.gps_sigma_horizontal_m, options_.gps_sigma_vertical_m);
  const Similarity3 map_from_enu = gps_enu_from_map_->Inverse();
  for (const auto& [photo, position] : positions_) {
    if (views_.count(photo) == 0 || !position.alt_m) continue;
    const auto in_enu = used_gps_frame_->FromWgs84(position);
    if (!in_enu) continue;
    constraints->centers.push_back(
        {photo, {map_from_enu * *in_enu, sigma_m / gps_enu_from_map_->scale}});
  }
}

BundleConstraints Georeferencer::Constraints() const {
  BundleConstraints constraints;
  AddCenters(&constraints);
  for (const auto& [id, target] : targets_) {
    if (!target.triangulated || target.triangulated->second_point_in_map) continue;
    MarkerTrack track;
    track.marker_id = id;
    track.position_in_map = target.triangulated->point_in_map;
    for (const int idx : target.triangulated->used) {
      const TargetSighting& sighting = target.sightings[static_cast<std::size_t>(idx)];
      const double variance_px2 = 0.5 * sighting.covariance_px2.trace();
      track.sightings.push_back({sighting.photo,
                                 sighting.pixel,
                                 std::sqrt(variance_px2 + std::pow(options_.min_sigma_px, 2))});
    }
    constraints.markers.push_back(std::move(track));
  }
  if (georeference_.source != GeoreferenceSource::kTargets) return constraints;
  for (const TargetReport& report : georeference_.targets) {
    if (report.state != TargetState::kGood || report.is_check) continue;
    const auto surveyed = std::find_if(survey_->targets.begin(),
                                       survey_->targets.end(),
                                       [&](const auto& target) { return target.id == report.id; });
    const auto track = std::find_if(
        constraints.markers.begin(), constraints.markers.end(), [&](const MarkerTrack& marker) {
          return marker.marker_id == report.id;
        });
    if (surveyed == survey_->targets.end() || track == constraints.markers.end()) continue;
    track->survey = ToMap(*surveyed, *frame_, georeference_.enu_from_map);
  }
  return constraints;
}

}  // namespace plumb
