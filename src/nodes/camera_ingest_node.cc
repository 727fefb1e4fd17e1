// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes up the camera's photos, keeps them in the session and publishes them.
#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "ros/camera_ingest.h"
#include "ros/read_options.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "camera_ingest");
  ros::NodeHandle handle;  // Outside the try block: its end would stop logging before the catch.
  try {
    using plumb::ros_adapter::CameraIngestOptions;
    const auto options = plumb::ros_adapter::ReadOptions<CameraIngestOptions>(ros::NodeHandle("~"));
    const plumb::ros_adapter::CameraIngest ingest(handle, options);
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
