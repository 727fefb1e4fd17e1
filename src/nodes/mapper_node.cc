// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the map from the photos and answers each with a verdict.
#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "ros/mapper_ros.h"
#include "ros/read_options.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "mapper");
  ros::NodeHandle handle;  // Outside the try block: its end would stop logging before the catch.
  try {
    using plumb::ros_adapter::MapperRosOptions;
    const auto options = plumb::ros_adapter::ReadOptions<MapperRosOptions>(ros::NodeHandle("~"));
    const plumb::ros_adapter::MapperRos mapper(handle, options);
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
