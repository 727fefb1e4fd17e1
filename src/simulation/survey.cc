// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/survey.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "plumbline/common/atomic_file.h"
#include "plumbline/common/options.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr std::uint64_t kSurveyUse = 402;

}  // namespace

std::vector<std::string> SurveyOptions::Problems() const {
  ProblemList list;
  list.Require(sigma_m >= 0.0, "sigma_m", "at least 0", sigma_m);
  list.Require(check_share >= 0.0 && check_share <= 1.0, "check_share", "from 0 to 1", check_share);
  return list.Take();
}

std::vector<SurveyedTarget> SurveyTargets(const World& world, const SurveyOptions& options) {
  ThrowIfProblems("survey", options.Problems());
  std::vector<SurveyedTarget> targets;
  for (const Plate& plate : world.plates) {
    RandomNumbers random(
        DeriveSeed(options.seed, kSurveyUse, static_cast<std::uint64_t>(plate.id)));
    const auto count = static_cast<double>(targets.size());
    SurveyedTarget target;
    target.id = plate.id;
    target.point_in_world = plate.world_from_plate.translation + random.Normal3(options.sigma_m);
    target.sigma_m = options.sigma_m;
    // Round half up, so that neither the first nor the last few are all of one role.
    target.is_check = std::floor((count + 1.0) * options.check_share + 0.5) >
                      std::floor(count * options.check_share + 0.5);
    targets.push_back(target);
  }
  return targets;
}

void WriteSurveyCsv(const std::vector<SurveyedTarget>& targets, const std::string& path) {
  std::ostringstream text;
  text << "id,x_m,y_m,z_m,sigma_m,role\n" << std::fixed << std::setprecision(6);
  for (const SurveyedTarget& target : targets) {
    const Eigen::Vector3d& point = target.point_in_world;
    text << target.id << ',' << point.x() << ',' << point.y() << ',' << point.z() << ','
         << target.sigma_m << ',' << (target.is_check ? "check" : "control") << '\n';
  }
  WriteFileAtomically(path, text.str());
}

}  // namespace plumb
