// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mapper_ros_options.h"

#include <cmath>

#include "plumbline/common/options.h"
#include "ros/absolute_path.h"

namespace plumb::ros_adapter {

std::vector<std::string> MapperRosOptions::Problems() const {
  ProblemList problems;
  problems.Require(!session_folder.empty(), "session_folder", "given", session_folder);
  RequireAbsolute("session_folder", session_folder, &problems);
  problems.Require(!map_frame_id.empty(), "map_frame_id", "given", map_frame_id);
  problems.Require(!camera_frame_id.empty() && camera_frame_id != map_frame_id,
                   "camera_frame_id",
                   "given and not the map's",
                   camera_frame_id);
  problems.Require(!overview_frame_id.empty() && overview_frame_id != map_frame_id,
                   "overview_frame_id",
                   "given and not the map's",
                   overview_frame_id);
  problems.Require(std::isfinite(overview_yaw_deg), "overview_yaw_deg", "finite", overview_yaw_deg);
  problems.Require(
      std::abs(overview_pitch_deg) <= 90.0, "overview_pitch_deg", "-90 to 90", overview_pitch_deg);
  problems.Require(overview_distance > 0.0, "overview_distance", "positive", overview_distance);
  problems.Require(overview_half_angle_deg > 0.0 && overview_half_angle_deg < 90.0,
                   "overview_half_angle_deg",
                   "between 0 and 90",
                   overview_half_angle_deg);
  problems.Require(max_queue >= 1, "max_queue", "at least 1", max_queue);
  problems.Require(display_period_s > 0.0, "display_period_s", "positive", display_period_s);
  problems.Require(annotated_width_px >= 64 && annotated_width_px <= 1920,
                   "annotated_width_px",
                   "64 to 1920",
                   annotated_width_px);
  problems.Require(min_drawn_views >= 2, "min_drawn_views", "at least 2", min_drawn_views);
  problems.Append("mapper", mapper.Problems());
  return problems.Take();
}

}  // namespace plumb::ros_adapter
