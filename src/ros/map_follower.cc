// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/map_follower.h"

#include <plumbline/GetMap.h>
#include <ros/service.h>

#include <optional>
#include <utility>

#include "ros/map_conversion.h"

namespace plumb::ros_adapter {
namespace {

// A whole map may be large: what falls behind asks for it anew anyway.
constexpr std::uint32_t kDeltaQueue = 100;

constexpr double kAskEvery_s = 0.5;
constexpr double kComplainEvery_s = 5.0;

}  // namespace

MapFollower::MapFollower(const ros::NodeHandle& handle, std::function<bool(const MapDelta&)> apply)
    : apply_(std::move(apply)), handle_(handle) {
  delta_subscriber_ = handle_.subscribe("map_delta", kDeltaQueue, &MapFollower::OnDelta, this);
  stored_subscriber_ = handle_.subscribe("stored_photos", 1, &MapFollower::OnStoredPhotos, this);
}

void MapFollower::Poll() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!wants_map_ || (now - last_asked_).toSec() < kAskEvery_s) return;
  last_asked_ = now;
  const std::string service = handle_.resolveName("get_map");
  if (!ros::service::exists(service, /*print_failure_reason=*/false)) return;
  plumbline::GetMap get_map;
  if (ros::service::call(service, get_map)) Take(get_map.response.snapshot);
}

// Deltas older than a snapshot that was asked for come after it: they are in it.
void MapFollower::OnDelta(const plumbline::MapDelta& msg) {
  const bool is_in_it = msg.is_snapshot == 0 && !wants_map_ && msg.sequence <= sequence_;
  if (is_in_it || Take(msg)) return;
  wants_map_ = true;
}

// A mapper that was restarted may count on from less than was heard.
void MapFollower::OnStoredPhotos(const plumbline::StoredPhotos& msg) {
  if (!mapper_started_.isZero() && msg.mapper_started != mapper_started_) wants_map_ = true;
  mapper_started_ = msg.mapper_started;
}

bool MapFollower::Take(const plumbline::MapDelta& msg) {
  const std::optional<MapDelta> delta = FromMapDeltaMsg(msg);
  if (!delta) {
    ROS_ERROR_THROTTLE(
        kComplainEvery_s, "delta %u of the map dropped: its numbers make no sense", msg.sequence);
    return false;
  }
  if (wants_map_ && !delta->is_snapshot) return false;
  if (!apply_(*delta)) return false;
  sequence_ = delta->sequence;
  wants_map_ = false;
  return true;
}

}  // namespace plumb::ros_adapter
