// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/MapDelta.h>
#include <plumbline/StoredPhotos.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <functional>

#include "plumbline/map/map_delta.h"

namespace plumb::ros_adapter {

// Hears the map's deltas in order, and asks get_map for the whole where one is missing: at the
// start, after a gap, after a restart of the mapper. Call from one thread.
class MapFollower {
 public:
  // `apply` gets the deltas of a map from a snapshot on. It returns whether it took one.
  MapFollower(const ros::NodeHandle& handle, std::function<bool(const MapDelta&)> apply);

  // Asks for the whole map if it is wanted and somebody gives it; call it now and then.
  void Poll();

 private:
  void OnDelta(const plumbline::MapDelta& msg);
  void OnStoredPhotos(const plumbline::StoredPhotos& msg);
  bool Take(const plumbline::MapDelta& msg);

  std::function<bool(const MapDelta&)> apply_;
  ros::NodeHandle handle_;
  ros::Subscriber delta_subscriber_;
  ros::Subscriber stored_subscriber_;
  ros::Time mapper_started_;
  ros::SteadyTime last_asked_;
  std::uint32_t sequence_ = 0;
  bool wants_map_ = true;
};

}  // namespace plumb::ros_adapter
