// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/bundle_constraints.h"

#include <algorithm>
#include <cmath>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/alignment.h"
#include "plumbline/geometry/triangulation.h"
#include "plumbline/map/map.h"

namespace plumb {
namespace {

// A marker that is off by this many times what all others are does not say how the map moved: one
// of its views was located anew.
constexpr double kOutlierFactor = 4.0;

std::optional<Eigen::Vector3d> Triangulate(const MarkerTrack& track,
                                           const Camera& camera,
                                           const Map& map) {
  std::vector<NormalizedObservation> observations;
  for (const MarkerSighting& sighting : track.sightings) {
    if (!map.HasView(sighting.photo)) continue;
    const auto xy = camera.Unproject(sighting.center_px);
    if (xy) observations.push_back({&map.view(sighting.photo).cam_from_map, *xy});
  }
  return TriangulateViews(observations);
}

// Takes the worst out as long as it stands apart from the others, and half of them are left.
std::optional<Similarity3> Align(std::vector<Eigen::Vector3d> before,
                                 std::vector<Eigen::Vector3d> now) {
  std::optional<Similarity3> now_from_before = AlignPoints(before, now);
  const std::size_t least = std::max<std::size_t>(4, before.size() / 2);
  while (now_from_before && before.size() > least) {
    const std::vector<double> errors = AlignmentResiduals(*now_from_before, before, now);
    const auto worst = std::max_element(errors.begin(), errors.end()) - errors.begin();
    const std::vector<Eigen::Vector3d> worst_before = {before[static_cast<std::size_t>(worst)]};
    const std::vector<Eigen::Vector3d> worst_now = {now[static_cast<std::size_t>(worst)]};
    before.erase(before.begin() + worst);
    now.erase(now.begin() + worst);
    const std::optional<Similarity3> of_others = AlignPoints(before, now);
    if (!of_others) break;
    const std::vector<double> others = AlignmentResiduals(*of_others, before, now);
    const double error = AlignmentResiduals(*of_others, worst_before, worst_now)[0];
    if (error <= kOutlierFactor * *std::max_element(others.begin(), others.end())) break;
    now_from_before = of_others;
  }
  return now_from_before;
}

MeasuredPosition Moved(const Similarity3& now_from_before, const MeasuredPosition& measured) {
  return {now_from_before * measured.position_in_map, now_from_before.scale * measured.sigma};
}

}  // namespace

BundleConstraints MovedWithMap(const BundleConstraints& constraints,
                               const Camera& camera,
                               const Map& map) {
  std::vector<std::optional<Eigen::Vector3d>> points;
  std::vector<Eigen::Vector3d> before;
  std::vector<Eigen::Vector3d> now;
  for (const MarkerTrack& track : constraints.markers) {
    points.push_back(Triangulate(track, camera, map));
    if (!points.back()) continue;
    before.push_back(track.position_in_map);
    now.push_back(*points.back());
  }
  const std::optional<Similarity3> now_from_before = Align(before, now);
  BundleConstraints moved = constraints;
  for (std::size_t i = 0; i < points.size(); ++i) {
    MarkerTrack& track = moved.markers[i];
    if (points[i]) track.position_in_map = *points[i];
    if (now_from_before) {
      if (!points[i]) track.position_in_map = *now_from_before * track.position_in_map;
      if (track.survey) track.survey = Moved(*now_from_before, *track.survey);
    } else {
      track.survey.reset();
    }
  }
  if (!now_from_before) {
    moved.centers.clear();
    return moved;
  }
  for (CenterPrior& prior : moved.centers) prior.center = Moved(*now_from_before, prior.center);
  return moved;
}

}  // namespace plumb
