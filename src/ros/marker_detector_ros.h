// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <plumbline/MarkerDetectionArray.h>
#include <plumbline/Photo.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "plumbline/common/stage.h"
#include "plumbline/common/stopwatch.h"
#include "ros/latency.h"
#include "ros/marker_detector_ros_options.h"
#include "ros/marker_search.h"
#include "ros/photo_conversion.h"
#include "ros/trouble.h"

namespace plumb::ros_adapter {

// Answers each message on `photo` with one on `marker_detections`, and shows the markers on
// `annotated_markers`. One thread searches, ahead of a bounded queue. Call from one thread.
class MarkerDetectorRos {
 public:
  MarkerDetectorRos(const ros::NodeHandle& handle, const MarkerDetectorRosOptions& options);

 private:
  // A photo that waits for its turn.
  struct ArrivedPhoto {
    WirePhoto photo;
    std_msgs::Header header;
    sensor_msgs::CameraInfo camera_info;
    Stopwatch since_arrival;
  };

  void OnPhoto(const plumbline::Photo& msg);
  bool IsKnown(const plumbline::Photo& msg);
  void RefuseForFullQueue(const plumbline::Photo& msg);

  // Of the searching thread.
  void Search(const ArrivedPhoto& arrived);
  void Keep(const plumbline::MarkerDetectionArray& answer);
  void Show(const MarkerSearch& search, const plumbline::MarkerDetectionArray& answer);

  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  MarkerDetectorRosOptions options_;
  ros::Publisher detections_publisher_;
  ros::Publisher annotated_publisher_;
  ros::Subscriber photo_subscriber_;
  ros::WallTimer timer_;
  diagnostic_updater::Updater diagnostics_;

  std::mutex mutex_;                                                  // Of what follows.
  std::map<std::uint32_t, plumbline::MarkerDetectionArray> answers_;  // By sequence.
  std::set<std::uint32_t> in_work_;
  Latency latency_;
  std::size_t num_markers_ = 0;
  std::size_t num_not_searched_ = 0;
  Trouble full_queue_;

  std::unique_ptr<Stage<ArrivedPhoto>> search_;
};

}  // namespace plumb::ros_adapter
