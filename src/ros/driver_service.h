// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plumb::ros_adapter {

// Where a camera's driver takes its calibration, by the resolved topic of its images:
// set_camera_info beside the topic, as camera_info_manager has it. What image_transport appends
// for compressed images is not part of the driver's name.
std::string SetCameraInfoServiceOf(const std::string& image_topic);

}  // namespace plumb::ros_adapter
