// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/MarkerDetectionArray.h>
#include <plumbline/SearchedPhotos.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/marker/marker_detector.h"

namespace plumb::ros_adapter {

// Hears the markers of every photo, in any order, and asks get_marker_detections for what it
// missed: at the start, after a restart of either side. Call from one thread.
class DetectionsFollower {
 public:
  using Take = std::function<void(PhotoId, std::vector<MarkerDetection>)>;

  // `take` gets the markers of each photo that was searched, perhaps more than once.
  DetectionsFollower(const ros::NodeHandle& handle, Take take);

  // Asks for what is missing, if anything is; call it now and then.
  void Poll();

 private:
  void OnDetections(const plumbline::MarkerDetectionArray& msg);
  void OnSearchedPhotos(const plumbline::SearchedPhotos& msg);
  void Hear(const plumbline::MarkerDetectionArray& msg);
  bool LacksAny() const;

  Take take_;
  ros::NodeHandle handle_;
  ros::Subscriber detections_subscriber_;
  ros::Subscriber searched_subscriber_;
  ros::SteadyTime last_asked_;
  std::set<std::uint32_t> heard_;
  std::vector<std::uint32_t> searched_;  // As the detector says, until it was asked for them.
};

}  // namespace plumb::ros_adapter
