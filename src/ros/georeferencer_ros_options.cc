// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/georeferencer_ros_options.h"

#include "plumbline/common/options.h"
#include "ros/absolute_path.h"

namespace plumb::ros_adapter {

std::vector<std::string> GeoreferencerRosOptions::Problems() const {
  ProblemList problems;
  RequireAbsolute("survey_file", survey_file, &problems);
  problems.Require(
      survey_heights.empty() || survey_heights == "ellipsoidal" || survey_heights == "orthometric",
      "survey_heights",
      "ellipsoidal, orthometric or empty",
      survey_heights);
  problems.Require(!map_frame_id.empty(), "map_frame_id", "given", map_frame_id);
  problems.Require(!enu_frame_id.empty() && enu_frame_id != map_frame_id,
                   "enu_frame_id",
                   "given and not the map's",
                   enu_frame_id);
  problems.Require(
      !earth_frame_id.empty() && earth_frame_id != map_frame_id && earth_frame_id != enu_frame_id,
      "earth_frame_id",
      "given and neither the map's nor enu's",
      earth_frame_id);
  problems.Require(
      residual_magnification > 0.0, "residual_magnification", "positive", residual_magnification);
  problems.Append("georeferencer", georeferencer.Problems());
  return problems.Take();
}

}  // namespace plumb::ros_adapter
