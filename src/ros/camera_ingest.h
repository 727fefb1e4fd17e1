// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <plumbline/PhotoVerdict.h>
#include <plumbline/StoredPhotos.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "plumbline/camera/camera.h"
#include "ros/camera_ingest_options.h"
#include "ros/folder_watcher.h"
#include "ros/photo_intake.h"
#include "ros/send_window.h"

namespace plumb::ros_adapter {

// Takes photos from a watched folder and from image topics, keeps their bytes in the session and
// publishes each on `photo` until its verdict is heard on `photo_verdict`. Callbacks and
// the watching thread may run at the same time.
class CameraIngest {
 public:
  // Throws naming the file and field if the camera is wrong or not the session's, the folder cannot
  // be watched or the session not written.
  CameraIngest(const ros::NodeHandle& handle, const CameraIngestOptions& options);
  ~CameraIngest();

  CameraIngest(const CameraIngest&) = delete;
  CameraIngest& operator=(const CameraIngest&) = delete;

 private:
  void LoadCamera();
  void SetCamera(const Camera& camera);
  void Subscribe();

  void WatchFolder();
  bool TakeFile(const std::string& name);
  void TakeFromTopic(const std::string& source,
                     const ros::Time& stamp,
                     const std::vector<std::uint8_t>& bytes);
  void Enqueue(const TakenPhoto& photo);

  void OnCameraInfo(const sensor_msgs::CameraInfo& msg);
  void OnImage(const sensor_msgs::ImageConstPtr& msg);
  void OnCompressedImage(const sensor_msgs::CompressedImage& msg);
  void OnVerdict(const plumbline::PhotoVerdict& msg);
  void OnStoredPhotos(const plumbline::StoredPhotos& msg);

  bool IsHeard() const;

  // Publishes whatever the window says is due.
  void SendDue();
  void Send(std::uint32_t sequence);
  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_;
  CameraIngestOptions options_;
  PhotoIntake intake_;
  ros::Publisher photo_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  diagnostic_updater::Updater diagnostics_;

  std::mutex mutex_;  // Of what follows.
  std::optional<Camera> camera_;
  SendWindow window_;
  ros::Time mapper_started_;
  std::string trouble_;  // What keeps photos from being taken up; empty if nothing.

  std::unique_ptr<FolderWatcher> watcher_;  // Of the watching thread.
  std::atomic<bool> is_folder_gone_{false};
  std::atomic<bool> is_stopping_{false};
  std::thread watching_;
};

}  // namespace plumb::ros_adapter
