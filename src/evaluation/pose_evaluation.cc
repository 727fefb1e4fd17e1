// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/pose_evaluation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>

#include "evaluation/center_alignment.h"
#include "evaluation/turn_about_line.h"

namespace plumb {
namespace {

constexpr double kDegPerRad = 180.0 / M_PI;
constexpr double kMmPerM = 1000.0;

// Precondition: not empty.
ErrorSummary Summarise(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  const std::size_t middle = errors.size() / 2;
  const double median =
      errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  return {sum / static_cast<double>(errors.size()), median, errors.back()};
}

bool IsWrong(const PhotoError& error, const PoseTolerance& tolerance) {
  return error.center_error_mm > kMmPerM * tolerance.max_center_error_m ||
         error.rotation_error_deg > tolerance.max_rotation_error_deg;
}

struct Pair {
  const ViewState* view;
  const TruePose* truth;
};

// Pairs by name, in the order of the truth; what has no partner goes to `missed`.
std::vector<Pair> PairUp(const std::vector<ViewState>& views,
                         const std::vector<TruePose>& truth,
                         std::vector<std::string>* missed) {
  std::map<std::string, const ViewState*> view_of_name;
  for (const ViewState& view : views) view_of_name[view.name] = &view;
  std::vector<Pair> pairs;
  for (const TruePose& pose : truth) {
    const auto view = view_of_name.find(pose.photo);
    if (view == view_of_name.end()) {
      missed->push_back(pose.photo);
    } else {
      pairs.push_back({view->second, &pose});
    }
  }
  return pairs;
}

std::vector<std::string> WithoutTruth(const std::vector<ViewState>& views,
                                      const std::vector<TruePose>& truth) {
  std::set<std::string> names;
  for (const TruePose& pose : truth) names.insert(pose.photo);
  std::vector<std::string> without;
  for (const ViewState& view : views) {
    if (names.count(view.name) == 0) without.push_back(view.name);
  }
  return without;
}

Centers CentersOf(const std::vector<Pair>& pairs) {
  Centers centers;
  for (const Pair& pair : pairs) {
    centers.in_map.push_back(pair.view->cam_from_map.TargetOriginInSource());
    centers.in_world.push_back(pair.truth->center_in_world_m);
  }
  return centers;
}

std::vector<CameraTurn> TurnsOf(const std::vector<Pair>& pairs) {
  std::vector<CameraTurn> turns;
  for (const Pair& pair : pairs) {
    turns.push_back({pair.view->cam_from_map.rotation, pair.truth->cam_from_world_rotation});
  }
  return turns;
}

Similarity3 Align(const std::vector<Pair>& pairs, double max_error_m) {
  if (pairs.size() < 3) {
    throw std::runtime_error(
        "an alignment needs three photos that are both in the map and in the "
        "truth, but there are " +
        std::to_string(pairs.size()) + "; compare the names of the photos in both");
  }
  const Centers centers = CentersOf(pairs);
  const std::optional<Similarity3> world_from_map = AlignCenters(centers, max_error_m);
  if (!world_from_map) {
    throw std::runtime_error(
        "the camera centres lie on a line, so that the rotation about it is free; evaluate a "
        "flight with photos beside that line");
  }
  return TurnAboutLine(*world_from_map, centers.in_world, TurnsOf(pairs), max_error_m);
}

PhotoError ErrorOf(const Similarity3& world_from_map, const Pair& pair) {
  const Rigid3 cam_from_world = TransformCamera(world_from_map, pair.view->cam_from_map);
  const Eigen::Vector3d offset_m =
      cam_from_world.TargetOriginInSource() - pair.truth->center_in_world_m;
  const double angle_rad =
      cam_from_world.rotation.angularDistance(pair.truth->cam_from_world_rotation);
  return {pair.truth->photo, kMmPerM * offset_m.norm(), kDegPerRad * angle_rad};
}

}  // namespace

PoseEvaluation EvaluatePoses(const std::vector<ViewState>& views,
                             const std::vector<TruePose>& truth,
                             const PoseTolerance& tolerance) {
  PoseEvaluation evaluation;
  const std::vector<Pair> pairs = PairUp(views, truth, &evaluation.missed);
  evaluation.without_truth = WithoutTruth(views, truth);
  evaluation.num_truth = static_cast<int>(truth.size());
  evaluation.num_registered = static_cast<int>(pairs.size());
  evaluation.world_from_map = Align(pairs, tolerance.max_center_error_m);
  std::vector<double> center_errors_mm;
  std::vector<double> rotation_errors_deg;
  for (const Pair& pair : pairs) {
    evaluation.photos.push_back(ErrorOf(evaluation.world_from_map, pair));
    center_errors_mm.push_back(evaluation.photos.back().center_error_mm);
    rotation_errors_deg.push_back(evaluation.photos.back().rotation_error_deg);
    if (IsWrong(evaluation.photos.back(), tolerance)) {
      evaluation.wrong.push_back(pair.truth->photo);
    }
  }
  evaluation.center_error_mm = Summarise(center_errors_mm);
  evaluation.rotation_error_deg = Summarise(rotation_errors_deg);
  return evaluation;
}

}  // namespace plumb
