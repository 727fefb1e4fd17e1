// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/geometry_conversion.h"

#include <cmath>
#include <limits>

#include "plumbline/common/check.h"

namespace plumb::ros_adapter {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

}  // namespace

bool FitsRosTime(Timestamp time) {
  return time.ns >= 0 && time.ns / kNsPerS <= std::numeric_limits<std::uint32_t>::max();
}

ros::Time ToRosTime(Timestamp time) {
  PLUMB_CHECK(FitsRosTime(time));
  return ros::Time(static_cast<std::uint32_t>(time.ns / kNsPerS),
                   static_cast<std::uint32_t>(time.ns % kNsPerS));
}

Timestamp FromRosTime(const ros::Time& time) {
  return {static_cast<std::int64_t>(time.sec) * kNsPerS + static_cast<std::int64_t>(time.nsec)};
}

geometry_msgs::Point ToPointMsg(const Eigen::Vector3d& point) {
  geometry_msgs::Point msg;
  msg.x = point.x();
  msg.y = point.y();
  msg.z = point.z();
  return msg;
}

geometry_msgs::Transform ToTransformMsg(const Rigid3& target_from_source) {
  geometry_msgs::Transform msg;
  msg.translation.x = target_from_source.translation.x();
  msg.translation.y = target_from_source.translation.y();
  msg.translation.z = target_from_source.translation.z();
  msg.rotation.w = target_from_source.rotation.w();
  msg.rotation.x = target_from_source.rotation.x();
  msg.rotation.y = target_from_source.rotation.y();
  msg.rotation.z = target_from_source.rotation.z();
  return msg;
}

std::optional<Rigid3> FromTransformMsg(const geometry_msgs::Transform& msg) {
  const Eigen::Quaterniond rotation(msg.rotation.w, msg.rotation.x, msg.rotation.y, msg.rotation.z);
  const Eigen::Vector3d translation(msg.translation.x, msg.translation.y, msg.translation.z);
  if (!translation.allFinite() || !(std::abs(rotation.norm() - 1.0) <= 1e-3)) return std::nullopt;
  return Rigid3(rotation, translation);
}

}  // namespace plumb::ros_adapter
