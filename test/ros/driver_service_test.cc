// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/driver_service.h"

#include <gtest/gtest.h>

namespace plumb::ros_adapter {
namespace {

TEST(SetCameraInfoServiceOf, LiesBesideTheImagesWhateverCarriesThem) {
  EXPECT_EQ(SetCameraInfoServiceOf("/cam/image_raw"), "/cam/set_camera_info");
  EXPECT_EQ(SetCameraInfoServiceOf("/cam/image_raw/compressed"), "/cam/set_camera_info");
  EXPECT_EQ(SetCameraInfoServiceOf("/rig/left/image"), "/rig/left/set_camera_info");
  EXPECT_EQ(SetCameraInfoServiceOf("/image"), "/set_camera_info");
  EXPECT_EQ(SetCameraInfoServiceOf("/compressed"), "/set_camera_info");
}

}  // namespace
}  // namespace plumb::ros_adapter
