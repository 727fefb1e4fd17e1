// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <sstream>
#include <tuple>

#include "plumbline/quality/gaps.h"

namespace plumb {
namespace {

// Shorter ways are not told: a pilot does not hold the place better [share of the distance to the
// gap].
constexpr double kMinTold = 0.08;

std::string Decimal(double value) {
  std::ostringstream text;
  text.precision(value < 9.95 ? 1 : 0);
  text << std::fixed << value;
  return text.str();
}

}  // namespace

Move MoveTo(const Gap& gap, const Rigid3& cam_from_map) {
  const Eigen::Vector3d in_cam = cam_from_map * gap.camera_in_map;
  return {in_cam.x(), -in_cam.y(), in_cam.z()};
}

std::string Problem(const Gap& gap, const GapOptions& options, const Measure& measure) {
  const bool is_metric = measure.metres_per_map_unit.has_value();
  if (gap.share_unsure >= 0.5) {
    if (gap.num_views == 0) return "No photo sees it";
    return "Only " + std::to_string(gap.num_views) +
           (gap.num_views == 1 ? " photo sees it" : " photos see it");
  }
  if (!is_metric) return "Too coarse, " + Decimal(gap.gsd) + " times the first photos' GSD";
  return "Too coarse, " + Decimal(gap.gsd) + " mm instead of " +
         Decimal(WantedGsd(options, measure)) + " mm";
}

std::string Way(const Gap& gap, const Measure& measure, const Rigid3& cam_from_map) {
  const Move move = MoveTo(gap, cam_from_map);
  const double distance = (cam_from_map * gap.center_in_map).norm();
  const double scale = measure.metres_per_map_unit.value_or(1.0 / distance);
  std::string way;
  for (const auto& [length, towards, away] : {std::tuple{move.right, "right", "left"},
                                              {move.up, "up", "down"},
                                              {move.forward, "closer", "back"}}) {
    if (!(std::abs(length) >= kMinTold * distance)) continue;
    way += (way.empty() ? "" : ", ") + Decimal(scale * std::abs(length)) +
           (measure.metres_per_map_unit ? " m " : " x ") + (length > 0.0 ? towards : away);
  }
  return way;
}

std::string Advice(const Gap& gap,
                   const GapOptions& options,
                   const Measure& measure,
                   const Rigid3& cam_from_map) {
  const std::string problem = Problem(gap, options, measure);
  const std::string way = Way(gap, measure, cam_from_map);
  if (way.empty()) return problem + ". Take a photo here.";
  return problem + ". Fly " + way +
         (measure.metres_per_map_unit ? "." : " (x: your distance to it).");
}

}  // namespace plumb
