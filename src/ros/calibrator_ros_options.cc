// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_ros_options.h"

#include "plumbline/common/options.h"
#include "ros/absolute_path.h"

namespace plumb::ros_adapter {

std::vector<std::string> CalibratorRosOptions::Problems() const {
  ProblemList problems;
  problems.Require(!photos_folder.empty() || !image_topic.empty(),
                   "photos_folder",
                   "given unless image_topic is",
                   photos_folder);
  problems.Require(!output_folder.empty(), "output_folder", "given", output_folder);
  RequireAbsolute("photos_folder", photos_folder, &problems);
  RequireAbsolute("output_folder", output_folder, &problems);
  problems.Require(
      max_subfolder_depth >= 0, "max_subfolder_depth", "0 or more", max_subfolder_depth);
  problems.Require(untouched_for_s > 0.0, "untouched_for_s", "positive", untouched_for_s);
  problems.Require(!camera_name.empty(), "camera_name", "given", camera_name);
  problems.Require(max_queue >= 1, "max_queue", "at least 1", max_queue);
  problems.Require(picture_width_px >= 160, "picture_width_px", "at least 160", picture_width_px);
  problems.Append("views", views.Problems());
  problems.Append("detector", detector.Problems());
  problems.Append("calibration", calibration.Problems());
  return problems.Take();
}

}  // namespace plumb::ros_adapter
