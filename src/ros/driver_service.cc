// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/driver_service.h"

#include <ros/names.h>

namespace plumb::ros_adapter {

std::string SetCameraInfoServiceOf(const std::string& image_topic) {
  const std::string space = ros::names::parentNamespace(image_topic);
  const bool is_transport = image_topic == ros::names::append(space, "compressed");
  return ros::names::append(is_transport ? ros::names::parentNamespace(space) : space,
                            "set_camera_info");
}

}  // namespace plumb::ros_adapter
