// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/target_layout.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "georeference/finding_text.h"

namespace plumb {
namespace {

// Points out here are few and often wrong.
constexpr double kTail = 0.02;

// Below this width over length a turn about the line is seven times less certain than across it.
constexpr double kMinWidthRatio = 0.15;

// With fewer, two wrong ones may agree with each other.
constexpr std::size_t kEnough = 5;

Eigen::Matrix3d ScatterOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    scatter += (point - mean) * (point - mean).transpose();
  }
  return scatter;
}

// Columns: the directions of least to most extent.
Eigen::Matrix3d AxesOf(const std::vector<Eigen::Vector3d>& points) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(ScatterOf(points)).eigenvectors();
}

double WidthRatio(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d squares =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(ScatterOf(points), Eigen::EigenvaluesOnly)
          .eigenvalues();
  return std::sqrt(std::max(0.0, squares[1]) / squares[2]);
}

struct Range {
  double low = 0.0;
  double high = 0.0;
};

// Without a share of `tail` of the points at each end.
Range RangeAlong(const Eigen::Vector3d& axis,
                 const std::vector<Eigen::Vector3d>& points,
                 double tail) {
  std::vector<double> places;
  places.reserve(points.size());
  for (const Eigen::Vector3d& point : points) places.push_back(axis.dot(point));
  std::sort(places.begin(), places.end());
  const auto cut = static_cast<std::size_t>(tail * static_cast<double>(places.size()));
  return {places[cut], places[places.size() - 1 - cut]};
}

// "+x" and so on, as the axis points most; z is up in every frame of a survey.
std::string NameOf(const Eigen::Vector3d& axis) {
  Eigen::Index idx = 0;
  axis.cwiseAbs().maxCoeff(&idx);
  if (idx == 2) return axis.z() > 0.0 ? "the top (+z)" : "the bottom (-z)";
  return (axis[idx] > 0.0 ? "+" : "-") + std::string(idx == 0 ? "x" : "y");
}

void CheckSide(double min_coverage,
               const Eigen::Vector3d& axis,
               const std::vector<Eigen::Vector3d>& control,
               const std::vector<Eigen::Vector3d>& model,
               std::vector<Finding>* findings) {
  const Range of_model = RangeAlong(axis, model, kTail);
  const Range of_control = RangeAlong(axis, control, 0.0);
  const double length = of_model.high - of_model.low;
  if (!(length > 0.0)) return;
  const double from_low = (of_control.high - of_model.low) / length;
  const double from_high = (of_model.high - of_control.low) / length;
  if (from_low >= min_coverage && from_high >= min_coverage) return;
  const bool is_high_bare = from_low < from_high;
  const double bare_m =
      is_high_bare ? of_model.high - of_control.high : of_control.low - of_model.low;
  AddFinding(Finding::Severity::kWarning,
             "one_sided_targets",
             Text("all control points are on one side of the model: towards ",
                  NameOf(is_high_bare ? axis : -axis),
                  " ",
                  bare_m,
                  " m of its ",
                  length,
                  " m lie beyond the last one, where its error grows; survey a marker there"),
             findings);
}

}  // namespace

std::vector<Finding> CheckLayout(double min_coverage,
                                 const std::vector<Eigen::Vector3d>& control,
                                 const std::vector<Eigen::Vector3d>& model) {
  std::vector<Finding> findings;
  if (control.size() < kEnough) {
    AddFinding(Finding::Severity::kWarning,
               "few_targets",
               Text("only ",
                    control.size(),
                    " control points fix the model: ",
                    control.size() == 3 ? "a wrong one would not be noticed"
                                        : "which one is wrong would be hard to tell",
                    "; survey five or more"),
               &findings);
  }
  const double width_ratio = WidthRatio(control);
  if (width_ratio < kMinWidthRatio) {
    AddFinding(Finding::Severity::kWarning,
               "collinear_targets",
               Text("the control points lie nearly on a line (width over length ",
                    width_ratio,
                    "), so that the model can turn about it; survey a marker beside the line"),
               &findings);
  }
  if (model.size() < 10) return findings;
  const Eigen::Matrix3d axes = AxesOf(model);
  for (const int axis : {2, 1}) {
    CheckSide(min_coverage, axes.col(axis), control, model, &findings);
  }
  return findings;
}

}  // namespace plumb
