// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>
#include <topic_tools/shape_shifter.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "plumbline/common/stage.h"
#include "ros/calibrator_ros_options.h"
#include "ros/folder_watcher.h"
#include "ros/live_calibrator.h"
#include "ros/trouble.h"

namespace plumb::ros_adapter {

// Calibrates a camera from a watched folder and an image topic, live or from a bag. Publishes
// `~progress`; the services `~calibrate`, `~save` and `~commit` do what the window's buttons do.
// Callbacks need one thread that spins.
class CalibratorRos {
 public:
  // Throws naming the folder if it cannot be read. One that is not there yet is waited for.
  CalibratorRos(const ros::NodeHandle& handle, const CalibratorRosOptions& options);
  ~CalibratorRos();

  CalibratorRos(const CalibratorRos&) = delete;
  CalibratorRos& operator=(const CalibratorRos&) = delete;

  // Never waits. From any thread, as what follows.
  CalibratorState state() const { return calibrator_.state(); }

  // Begin in the background; state() says what became of it.
  void BeginCalibrate();
  void BeginSave();
  void BeginCommit();

 private:
  using Trigger = std_srvs::Trigger;

  Outcome Commit();
  std::string HowElse() const;  // Than by Commit.
  Outcome SendTo(const std::string& service, const Camera& camera) const;
  std::string SetCameraInfoService() const;
  void Advertise();
  void Serve(const std::string& name, const std::function<Outcome()>& action);

  // Of the watching thread.
  void WatchFolder();
  void TakeFile(const std::string& name);

  void OnImage(const topic_tools::ShapeShifter::ConstPtr& msg);
  void OnTimer();
  SourceNote FolderNote() const;
  SourceNote TopicNote(bool is_enough) const;  // Silence is no trouble once it is enough.
  bool IsTopicShown() const;
  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle private_handle_;
  const CalibratorRosOptions options_;
  std::string image_topic_;  // Resolved; empty: none.
  LiveCalibrator calibrator_;
  std::unique_ptr<Stage<std::function<void()>>> actions_;
  ros::Publisher progress_publisher_;
  ros::Subscriber image_subscriber_;
  ros::WallTimer timer_;
  diagnostic_updater::Updater diagnostics_;
  std::uint64_t published_revision_ = 0;

  mutable std::mutex mutex_;  // Of what follows.
  std::size_t num_images_ = 0;
  double last_image_s_ = 0.0;
  std::string topic_trouble_;
  std::set<std::string> files_;  // Names; one may be written anew.
  std::string file_trouble_;
  bool has_folder_ = false;

  ros::CallbackQueue service_queue_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<ros::AsyncSpinner> service_spinner_;

  std::unique_ptr<FolderWatcher> watcher_;  // Of the watching thread.
  std::atomic<bool> is_stopping_{false};
  std::thread watching_;
};

}  // namespace plumb::ros_adapter
