// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Transform.h>
#include <ros/time.h>

#include <Eigen/Core>
#include <optional>

#include "plumbline/common/timestamp.h"
#include "plumbline/geometry/rigid3.h"

namespace plumb::ros_adapter {

// Whether ROS can hold the time: from 1970 to 2106.
bool FitsRosTime(Timestamp time);

// The time must fit.
ros::Time ToRosTime(Timestamp time);
Timestamp FromRosTime(const ros::Time& time);

geometry_msgs::Point ToPointMsg(const Eigen::Vector3d& point);

geometry_msgs::Transform ToTransformMsg(const Rigid3& target_from_source);

// Nothing if a value is not finite, or the quaternion is not of unit length to 1e-3 (default
// messages carry 0, 0, 0, 0): an identity pose must never stand for "unknown".
std::optional<Rigid3> FromTransformMsg(const geometry_msgs::Transform& msg);

}  // namespace plumb::ros_adapter
