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
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "plumbline/camera/camera.h"
#include "ros/camera_ingest_options.h"
#include "ros/folder_watcher.h"
#include "ros/listener_gate.h"
#include "ros/photo_intake.h"
#include "ros/send_window.h"
#include "ros/trouble.h"

namespace plumb::ros_adapter {

// Takes photos from a watched folder and from image topics, keeps their bytes in the session and
// publishes each on `photo` until its verdict is heard on `photo_verdict`. Callbacks and
// the watching thread may run at the same time.
class CameraIngest {
 public:
  // Throws naming the file and field if the camera is wrong or not the session's, the folder cannot
  // be read or the session not written. A folder that is not there yet is waited for.
  CameraIngest(const ros::NodeHandle& handle, const CameraIngestOptions& options);
  ~CameraIngest();

  CameraIngest(const CameraIngest&) = delete;
  CameraIngest& operator=(const CameraIngest&) = delete;

 private:
  void LoadCamera();
  void SetCamera(const Camera& camera);
  void Subscribe();

  // Of the watching thread.
  void WatchFolder();
  void NoteFolder();
  void TakeFiles(std::vector<std::string>* names);
  void TakeFile(const std::string& name);

  // Of the callbacks, one at a time.
  void TakeFromTopic(const std::string& source,
                     const ros::Time& stamp,
                     const std::vector<std::uint8_t>& bytes);
  void TakeImages();

  void Enqueue(const TakenPhoto& photo);
  void BeginTrouble(Trouble* trouble, const std::string& text, std::size_t num_waiting);

  // The most photos that waited, if there was this trouble.
  std::optional<std::size_t> EndTrouble(Trouble* trouble);

  void OnCameraInfo(const sensor_msgs::CameraInfo& msg);
  void OnImage(const sensor_msgs::ImageConstPtr& msg);
  void OnCompressedImage(const sensor_msgs::CompressedImage& msg);
  void OnVerdict(const plumbline::PhotoVerdict& msg);
  void OnStoredPhotos(const plumbline::StoredPhotos& msg);

  struct TopicImage {
    std::string source;
    Timestamp exposure_time;
    std::vector<std::uint8_t> bytes;
  };

  // Publishes whatever the window says is due.
  void SendDue();
  void Send(std::uint32_t sequence);
  double SecondsBehind() const;
  void PublishPositions();
  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_;
  CameraIngestOptions options_;
  ListenerGate gate_;
  PhotoIntake intake_;
  ros::Publisher photo_publisher_;
  ros::Publisher positions_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  diagnostic_updater::Updater diagnostics_;

  std::mutex mutex_;  // Of what follows.
  std::optional<Camera> camera_;
  bool has_new_positions_ = true;  // Or a new camera, to be published.
  SendWindow window_;
  ros::Time mapper_started_;
  Trouble folder_trouble_;
  Trouble file_trouble_;
  Trouble image_trouble_;
  std::set<std::string> folders_;  // Those photos were found in.

  std::deque<TopicImage> images_;  // To be taken up; of the callbacks.
  std::size_t num_image_bytes_ = 0;
  std::size_t num_images_lost_ = 0;

  std::unique_ptr<FolderWatcher> watcher_;  // Of the watching thread.
  std::atomic<bool> is_stopping_{false};
  std::thread watching_;
};

}  // namespace plumb::ros_adapter
