// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/marker_detector_ros_options.h"

#include "plumbline/common/options.h"
#include "ros/absolute_path.h"

namespace plumb::ros_adapter {

std::vector<std::string> MarkerDetectorRosOptions::Problems() const {
  ProblemList problems;
  RequireAbsolute("session_folder", session_folder, &problems);
  problems.Require(max_queue >= 1, "max_queue", "at least 1", max_queue);
  problems.Require(niceness >= 0 && niceness <= 19, "niceness", "0 to 19", niceness);
  problems.Require(annotated_width_px >= 64 && annotated_width_px <= 1920,
                   "annotated_width_px",
                   "64 to 1920",
                   annotated_width_px);
  problems.Append("detector", detector.Problems());
  return problems.Take();
}

}  // namespace plumb::ros_adapter
