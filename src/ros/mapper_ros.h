// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <plumbline/ControlPoints.h>
#include <plumbline/Photo.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "plumbline/camera/camera.h"
#include "ros/latency.h"
#include "ros/live_mapper.h"
#include "ros/map_publisher.h"
#include "ros/mapper_ros_options.h"
#include "ros/trouble.h"

namespace plumb::ros_adapter {

// Answers each message on `photo` with one on `photo_verdict` and publishes the map that grows
// from them; the service finish completes the map when the flight is over. The camera is that of
// the stored session or of the first photo. Call from one thread.
class MapperRos {
 public:
  // Throws naming the file if the session cannot be opened.
  MapperRos(const ros::NodeHandle& handle, const MapperRosOptions& options);
  ~MapperRos();

 private:
  void Start(const Camera& camera);
  void StartWith(const Camera& camera);
  LiveMapperOutput MakeOutput();

  // These throw what stopped the mapper.
  void OnPhoto(const plumbline::Photo& msg);
  void OnTimer();

  void OnControlPoints(const plumbline::ControlPoints& msg);
  bool OnFinish(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  std::string ReportNoPhotos() const;
  void RefuseOtherCamera(const WirePhoto& photo);
  void PublishVerdict(const PhotoVerdict& verdict, const PhotoBytes& bytes);
  void PublishStored(const std::vector<std::uint32_t>& sequences);
  void NoteStorageTrouble(const std::string& trouble, std::size_t num_waiting);
  PhotoCounts CountPhotos() const;
  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_;
  MapperRosOptions options_;
  ros::Time started_;
  ros::Publisher verdict_publisher_;
  ros::Publisher stored_publisher_;
  ros::Subscriber photo_subscriber_;
  ros::Subscriber control_points_subscriber_;
  ros::WallTimer timer_;
  diagnostic_updater::Updater diagnostics_;

  std::mutex mutex_;  // Of what follows.
  std::map<PhotoId, VerdictStatus> status_of_photo_;
  Latency latency_;
  std::size_t num_dropped_ = 0;
  std::size_t num_control_points_ = 0;  // Those that hold the bundles.
  Trouble storage_trouble_;

  std::unique_ptr<MapPublisher> publisher_;
  std::unique_ptr<LiveMapper> live_;
  std::optional<BundleConstraints> constraints_;  // Heard before there is a mapper.

  ros::CallbackQueue service_queue_;
  ros::ServiceServer finish_server_;
  std::unique_ptr<ros::AsyncSpinner> service_spinner_;
};

}  // namespace plumb::ros_adapter
