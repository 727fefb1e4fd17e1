// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/simulation/world.h"

namespace plumb {

// How the control points were measured.
struct SurveyOptions {
  double sigma_m = 0.001;    // Noise on each coordinate: a theodolite's.
  double check_share = 0.3;  // Share of the points that are kept to check the result with, 0..1.
  std::uint32_t seed = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(SurveyOptions& options, Visitor&& visit) {
  visit("sigma_m", options.sigma_m);
  visit("check_share", options.check_share);
  visit("seed", options.seed);
}

// As measured: the middle of a plate.
struct SurveyedTarget {
  int id = -1;  // Plate::id.
  Eigen::Vector3d point_in_world;
  double sigma_m = 0.0;
  bool is_check = false;  // Otherwise a control point.
};

// The plates' middles with noise; check points are spread evenly through the list. Throws
// std::invalid_argument listing options.Problems().
std::vector<SurveyedTarget> SurveyTargets(const World& world, const SurveyOptions& options);

// id,x_m,y_m,z_m,sigma_m,role; role control or check. Replaces the file as a whole. Throws
// std::runtime_error naming the file, the cause and the cure.
void WriteSurveyCsv(const std::vector<SurveyedTarget>& targets, const std::string& path);

}  // namespace plumb
