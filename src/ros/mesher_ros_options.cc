// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mesher_ros_options.h"

#include "plumbline/common/options.h"
#include "plumbline/quality/layer.h"

namespace plumb::ros_adapter {

bool IsScaleOrUnknown(double metres_per_map_unit) {
  return metres_per_map_unit == 0.0 || (metres_per_map_unit >= 1e-3 && metres_per_map_unit <= 1e3);
}

std::vector<std::string> MesherRosOptions::Problems() const {
  ProblemList problems;
  problems.Require(!map_frame_id.empty(), "map_frame_id", "given", map_frame_id);
  problems.Require(
      PaletteFromString(palette).has_value(), "palette", "paper or colour_blind", palette);
  problems.Require(IsScaleOrUnknown(metres_per_map_unit),
                   "metres_per_map_unit",
                   "0.001 to 1000, or 0 if it is not known",
                   metres_per_map_unit);
  problems.Require(display_period_s > 0.0, "display_period_s", "positive", display_period_s);
  problems.Require(max_queue >= 1, "max_queue", "at least 1", max_queue);
  problems.Append("surface", surface.Problems());
  problems.Append("quality", quality.Problems());
  problems.Append("gaps", gaps.Problems());
  return problems.Take();
}

}  // namespace plumb::ros_adapter
