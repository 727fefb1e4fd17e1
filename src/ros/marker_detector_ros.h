// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <plumbline/GetMarkerDetections.h>
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
#include "ros/answer_store.h"
#include "ros/latency.h"
#include "ros/marker_detector_ros_options.h"
#include "ros/marker_search.h"
#include "ros/photo_conversion.h"
#include "ros/trouble.h"
#include "ros/unsearched_photos.h"

namespace plumb::ros_adapter {

// Answers each message on `photo` with one on `marker_detections`, and shows the markers on
// `annotated_markers`; the service get_marker_detections gives all answers so far. One thread
// searches, ahead of a bounded queue. Goes on with the answers of the session, and searches its
// photos that have none. Call from one thread.
class MarkerDetectorRos {
 public:
  // Throws naming the file if the session's answers cannot be read.
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
  void GoOnWithSession();
  void SearchUnsearched();
  bool IsAnsweredOrInWork(std::uint32_t sequence);
  bool OnGetMarkerDetections(plumbline::GetMarkerDetections::Request& request,
                             plumbline::GetMarkerDetections::Response& response);

  // Of the searching thread.
  void Search(const ArrivedPhoto& arrived);
  void Keep(const plumbline::MarkerDetectionArray& answer);
  void Store(const plumbline::MarkerDetectionArray& answer);
  void PublishSearched();
  void Show(const MarkerSearch& search, const plumbline::MarkerDetectionArray& answer);

  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  MarkerDetectorRosOptions options_;
  ros::Publisher detections_publisher_;
  ros::Publisher annotated_publisher_;
  ros::Publisher searched_publisher_;
  ros::ServiceServer detections_server_;
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
  Trouble store_trouble_;

  std::unique_ptr<UnsearchedPhotos> unsearched_;  // Null without a session, as is the next.
  std::unique_ptr<AnswerStore> store_;            // Of the searching thread, once it runs.
  std::unique_ptr<Stage<ArrivedPhoto>> search_;
};

}  // namespace plumb::ros_adapter
