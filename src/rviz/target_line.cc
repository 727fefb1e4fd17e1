// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rviz/target_line.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "ros/target_name.h"

namespace plumb::rviz_panel {
namespace {

using ros_adapter::TargetName;

// Of longer lists the first names say enough.
constexpr std::size_t kMaxNames = 3;

std::string NamesOfWrong(const plumbline::Georeference& georeference) {
  std::string names;
  std::size_t num_wrong = 0;
  for (const plumbline::TargetResidual& target : georeference.targets) {
    if (target.state != plumbline::TargetResidual::WRONG) continue;
    if (++num_wrong <= kMaxNames) names += (num_wrong > 1 ? ", " : "") + TargetName(target);
  }
  return num_wrong > kMaxNames ? names + " ..." : names;
}

std::string Points(std::uint32_t count, const char* role, double mean_mm) {
  std::ostringstream text;
  text << count << ' ' << role;
  if (count > 0 && std::isfinite(mean_mm)) {
    text << ' ' << std::fixed << std::setprecision(1) << mean_mm << " mm";
  }
  return text.str();
}

}  // namespace

TargetLine TargetLineOf(const plumbline::Georeference& georeference) {
  const std::string wrong = NamesOfWrong(georeference);
  if (!wrong.empty()) return {"WRONG targets, left out: " + wrong, true};
  if (georeference.source == plumbline::Georeference::TARGETS) {
    return {
        "Targets: " + Points(georeference.num_control, "control", georeference.control_mean_mm) +
            ", " + Points(georeference.num_check, "check", georeference.check_mean_mm),
        false};
  }
  if (georeference.source == plumbline::Georeference::GPS) {
    return {"Placed by GPS alone: metres off", false};
  }
  if (georeference.survey.empty()) return {};
  return {"Targets: too few seen yet to place the map", false};
}

}  // namespace plumb::rviz_panel
