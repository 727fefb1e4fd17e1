// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment_measure.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "plumbline/evaluation/distance_summary.h"
#include "plumbline/evaluation/wall_bend.h"
#include "plumbline/sfm/landmark_accuracy.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kMmPerM = 1000.0;

// Null of none: 0 mm would say that they fit.
Json ToJson(const std::vector<double>& errors_mm) {
  if (errors_mm.empty()) return nullptr;
  double sum = 0.0;
  for (const double error : errors_mm) sum += error;
  return {{"count", errors_mm.size()},
          {"mean", sum / static_cast<double>(errors_mm.size())},
          {"max", *std::max_element(errors_mm.begin(), errors_mm.end())}};
}

// Against the survey, which has errors of its own, and against the truth.
void AddTargets(const ExperimentData& data, const Georeference& georeference, Json* json) {
  std::map<std::string, std::vector<double>> errors_mm = {
      {"control_mm", {}}, {"check_mm", {}}, {"true_control_mm", {}}, {"true_check_mm", {}}};
  for (const TargetReport& target : georeference.targets) {
    if (target.state != TargetState::kGood && target.state != TargetState::kWrong) continue;
    if (target.state == TargetState::kWrong && !target.is_check) continue;  // Not fitted.
    const std::string role = target.is_check ? "check_mm" : "control_mm";
    errors_mm[role].push_back(kMmPerM * target.residual_m.norm());
    const auto truth = data.flight.true_targets.find(target.id);
    if (truth == data.flight.true_targets.end()) continue;
    const Eigen::Vector3d in_survey =
        georeference.frame->ToCrs(georeference.enu_from_map * target.point_in_map);
    errors_mm["true_" + role].push_back(kMmPerM * (in_survey - truth->second).norm());
  }
  for (const auto& [name, errors] : errors_mm) (*json)[name] = ToJson(errors);
}

// Mean bend over the cells of each column of the wall.
Json ProfileOf(const WallBend& wall, double cell_m) {
  std::map<int, std::pair<double, int>> columns;
  for (const WallCell& cell : wall.cells) {
    auto& [sum, count] = columns[static_cast<int>(std::floor(cell.u_m / cell_m))];
    sum += cell.bend_mm;
    ++count;
  }
  Json profile = Json::array();
  for (const auto& [column, sum_count] : columns) {
    profile.push_back(
        {{"u_m", (column + 0.5) * cell_m}, {"bend_mm", sum_count.first / sum_count.second}});
  }
  return profile;
}

void AddWall(const ExperimentData& data, const Points& points, Json* json) {
  const WallBendOptions options;
  const auto wall =
      MeasureBend(options, PointsOfMainWall(options, data.surface, *data.surface_index, points));
  (*json)["bend_mm"] = wall ? Json(wall->max_mm) : Json(nullptr);
  (*json)["bend_rms_mm"] = wall ? Json(wall->rms_mm) : Json(nullptr);
  (*json)["bend_profile"] = wall ? ProfileOf(*wall, options.cell_m) : Json::array();
}

Json LaserJson(const std::vector<double>& distances_m) {
  std::vector<double> shares(kHistogramBins, 0.0);
  double within_2_mm = 0.0;
  const double share = 1.0 / static_cast<double>(distances_m.size());
  for (const double distance_m : distances_m) {
    const auto bin = static_cast<std::size_t>(kMmPerM * distance_m / kHistogramStep_mm);
    if (bin < shares.size()) shares[bin] += share;
    if (kMmPerM * distance_m <= 2.0) within_2_mm += share;
  }
  const DistanceSummary summary = SummariseDistances(distances_m);
  return {{"median", summary.median_mm},
          {"p90", summary.p90_mm},
          {"within_2_mm", within_2_mm},
          {"histogram", shares}};
}

// Points whose error is below twice what was predicted for them. A point's error is its distance
// from the surface: the rest of it, along the surface, nobody can see.
void AddPoints(const ExperimentData& data,
               const AccuracyPrediction& prediction,
               const Points& points,
               double m_per_map_unit,
               Json* json) {
  const std::vector<double> distances_m = EvaluateAtPoints(
      points,
      [&](const Eigen::Vector3d& point) { return data.surface_index->NearestTo(point).distance; });
  double within = 0.0;
  double within_ray = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LandmarkAccuracy& landmark = prediction.landmarks[i];
    within += distances_m[i] <= 2.0 * m_per_map_unit * landmark.Sigma() ? 1.0 : 0.0;
    within_ray += distances_m[i] <= 2.0 * m_per_map_unit * landmark.RaySigma() ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(points.size());
  const DistanceSummary summary = SummariseDistances(distances_m);
  (*json)["points"] = points.size();
  (*json)["sigma_px"] = prediction.sigma_px;
  (*json)["within_2_sigma"] = within / count;
  (*json)["within_2_ray_sigma"] = within_ray / count;
  (*json)["surface_mm"] = {{"median", summary.median_mm}, {"p90", summary.p90_mm}};
  if (!data.laser_index) {
    (*json)["laser_mm"] = nullptr;
    return;
  }
  (*json)["laser_mm"] = LaserJson(EvaluateAtPoints(points, [&](const Eigen::Vector3d& point) {
    return data.laser_index->DistanceToSurface(point);
  }));
}

}  // namespace

Json MeasureMap(const ExperimentData& data,
                const Map& map,
                const Camera& camera,
                const Georeference& georeference) {
  if (georeference.source != GeoreferenceSource::kTargets) return nullptr;
  Json json = {{"focal_px", camera.MeanFocalLength()}, {"k1", camera.lens()[kK1]}};
  AddTargets(data, georeference, &json);
  const AccuracyPrediction prediction = PredictLandmarkAccuracy(map, camera.lens());
  Points points;  // In the survey's frame, which is the truth's.
  for (const LandmarkAccuracy& landmark : prediction.landmarks) {
    const Eigen::Vector3d& in_map = map.landmark(landmark.id).position_in_map;
    points.push_back(georeference.frame->ToCrs(georeference.enu_from_map * in_map));
  }
  if (points.empty()) return nullptr;
  AddWall(data, points, &json);
  AddPoints(data, prediction, points, georeference.enu_from_map.scale, &json);
  return json;
}

}  // namespace plumb::tools
