// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_ros.h"

#include <plumbline/CalibrationProgress.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/service.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/SetCameraInfo.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <utility>

#include "ros/calibration_conversion.h"
#include "ros/calibrator_wording.h"
#include "ros/camera_conversion.h"
#include "ros/driver_service.h"
#include "ros/image_gray.h"

namespace plumb::ros_adapter {
namespace {

constexpr double kTimerPeriod_s = 0.2;
constexpr std::chrono::milliseconds kWatchFor{500};

// The stage behind has a queue of its own, which counts what it drops.
constexpr std::uint32_t kImageQueue = 2;
constexpr std::uint32_t kProgressQueue = 10;

// A camera that is slower is told apart from one that has stopped.
constexpr double kSilence_s = 3.0;

double SteadySeconds() { return ros::SteadyTime::now().toSec(); }

void LogView(const CalibratorView& view) {
  if (view.is_problem) {
    ROS_WARN("%s: %s", view.name.c_str(), view.note.c_str());
  } else {
    ROS_INFO("%s: %s", view.name.c_str(), view.note.c_str());
  }
}

void LogOutcome(const Outcome& outcome) {
  if (outcome.kind == Outcome::Kind::kDone) {
    ROS_INFO("%s", outcome.text.c_str());
  } else {
    ROS_WARN("%s", outcome.text.c_str());
  }
}

// A stamp of zero is a driver's that sets none.
double StampOf(const std_msgs::Header& header) {
  return header.stamp.isZero() ? ros::WallTime::now().toSec() : header.stamp.toSec();
}

}  // namespace

CalibratorRos::CalibratorRos(const ros::NodeHandle& handle, const CalibratorRosOptions& options)
    : private_handle_("~"),
      options_(options),
      calibrator_(options, LogView),
      diagnostics_(handle, private_handle_) {
  actions_ = std::make_unique<Stage<std::function<void()>>>(
      4, [](const std::function<void()>& action) { action(); });
  if (!options_.photos_folder.empty()) {
    watcher_ = std::make_unique<FolderWatcher>(
        options_.photos_folder,
        WatchOptions{
            std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * options_.untouched_for_s)),
            options_.max_subfolder_depth,
            options_.output_folder});
    has_folder_ = watcher_->is_watching();
  }
  if (!options_.image_topic.empty()) {
    image_topic_ = ros::names::resolve(options_.image_topic);  // A handle takes no "~".
    image_subscriber_ =
        private_handle_.subscribe(image_topic_, kImageQueue, &CalibratorRos::OnImage, this);
  }
  last_image_s_ = SteadySeconds();
  Advertise();
  diagnostics_.setHardwareID("camera");
  diagnostics_.add("calibration", this, &CalibratorRos::Diagnose);
  timer_ = private_handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s),
                                           [this](const auto&) { OnTimer(); });
  if (watcher_) watching_ = std::thread([this] { WatchFolder(); });
}

CalibratorRos::~CalibratorRos() {
  is_stopping_ = true;
  service_spinner_->stop();
  timer_.stop();
  image_subscriber_.shutdown();
  if (watching_.joinable()) watching_.join();
}

void CalibratorRos::Advertise() {
  progress_publisher_ = private_handle_.advertise<plumbline::CalibrationProgress>(
      "progress", kProgressQueue, /*latch=*/true);
  Serve("calibrate", [this] { return calibrator_.Calibrate(); });
  Serve("save", [this] { return calibrator_.Save(); });
  Serve("commit", [this] { return Commit(); });
  service_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &service_queue_);
  service_spinner_->start();
}

void CalibratorRos::Serve(const std::string& name, const std::function<Outcome()>& action) {
  using Callback = boost::function<bool(Trigger::Request&, Trigger::Response&)>;
  const Callback callback = [action](Trigger::Request&, Trigger::Response& response) {
    const Outcome outcome = action();
    LogOutcome(outcome);
    response.success = outcome.kind != Outcome::Kind::kFailed;
    response.message = outcome.text;
    return true;
  };
  ros::NodeHandle service_handle(private_handle_);
  service_handle.setCallbackQueue(&service_queue_);
  services_.push_back(service_handle.advertiseService(name, callback));
}

void CalibratorRos::BeginCalibrate() {
  actions_->TryPush([this] { LogOutcome(calibrator_.Calibrate()); });
}

void CalibratorRos::BeginSave() {
  actions_->TryPush([this] { LogOutcome(calibrator_.Save()); });
}

void CalibratorRos::BeginCommit() {
  actions_->TryPush([this] { LogOutcome(Commit()); });
}

Outcome CalibratorRos::Commit() {
  return calibrator_.Commit([this](const Camera& camera) -> Outcome {
    const std::string service = SetCameraInfoService();
    if (service.empty()) {
      return {Outcome::Kind::kFailed,
              "There is no camera to send it to: no image came from a driver. " + HowElse()};
    }
    return SendTo(service, camera);
  });
}

std::string CalibratorRos::SetCameraInfoService() const {
  if (!options_.set_camera_info_service.empty()) {
    return ros::names::resolve(options_.set_camera_info_service);
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (num_images_ == 0) return {};
  }
  return SetCameraInfoServiceOf(image_topic_);
}

std::string CalibratorRos::HowElse() const {
  return (calibrator_.state().is_saved
              ? "It is saved in " + options_.output_folder + "/camera.yaml all the same"
              : std::string("Press Save to have it as a file")) +
         "; a driver's service of another name is told at the start: set_camera_info:=NAME "
         "(parameter set_camera_info_service).";
}

Outcome CalibratorRos::SendTo(const std::string& service, const Camera& camera) const {
  if (!ros::service::exists(service, /*print_failure_reason=*/false)) {
    return {Outcome::Kind::kFailed,
            "There is no service " + service +
                ": the camera's driver does not run or keeps no calibration. " + HowElse()};
  }
  sensor_msgs::SetCameraInfo call;
  call.request.camera_info = ToCameraInfoMsg(camera);
  if (!ros::service::call(service, call)) {
    return {Outcome::Kind::kFailed,
            "The driver has not answered on " + service + "; is it still running?"};
  }
  if (!call.response.success) {
    return {Outcome::Kind::kFailed,
            "The driver refuses the calibration: " + call.response.status_message};
  }
  return {Outcome::Kind::kDone, "The camera has the calibration (" + service + ")."};
}

void CalibratorRos::WatchFolder() {
  while (!is_stopping_) {
    const std::vector<std::string> names = watcher_->Wait(kWatchFor);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      has_folder_ = watcher_->is_watching();
    }
    for (const std::string& name : names) {
      if (is_stopping_) return;
      TakeFile(name);
    }
  }
}

void CalibratorRos::TakeFile(const std::string& name) {
  std::ifstream file(options_.photos_folder + '/' + name, std::ios::binary);
  std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(file)), {});
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    files_.insert(name);
    file_trouble_ = file.is_open() && !file.bad() ? "" : name + " cannot be read from the disk";
    if (!file_trouble_.empty()) {
      ROS_WARN("%s", file_trouble_.c_str());
      watcher_->Forget(name);
      return;
    }
  }
  calibrator_.TakePhoto(name, std::move(bytes));
}

void CalibratorRos::OnImage(const topic_tools::ShapeShifter::ConstPtr& msg) {
  std::string trouble;
  try {
    if (msg->getDataType() == ros::message_traits::datatype<sensor_msgs::Image>()) {
      const auto image = msg->instantiate<sensor_msgs::Image>();
      calibrator_.OfferImage(StampOf(image->header), [image] { return ToGrayPhoto(image); });
    } else if (msg->getDataType() ==
               ros::message_traits::datatype<sensor_msgs::CompressedImage>()) {
      const auto image = msg->instantiate<sensor_msgs::CompressedImage>();
      calibrator_.OfferImage(StampOf(image->header),
                             [image] { return DecodeGrayPhoto(image->data); });
    } else {
      trouble = image_topic_ + " carries " + msg->getDataType() +
                ": name a topic of sensor_msgs/Image or sensor_msgs/CompressedImage";
    }
  } catch (const std::exception& error) {  // ros::serialization's and ShapeShifter's.
    trouble = image_topic_ + ": an image cannot be read: " + error.what();
  }
  if (!trouble.empty()) ROS_ERROR_THROTTLE(60.0, "%s", trouble.c_str());
  const std::lock_guard<std::mutex> lock(mutex_);
  topic_trouble_ = trouble;
  last_image_s_ = SteadySeconds();
  ++num_images_;
}

SourceNote CalibratorRos::FolderNote() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!has_folder_) {
    return {options_.photos_folder +
                ": this folder is not there. Put the card in, or correct "
                "photos_folder; it goes on by itself",
            true};
  }
  if (!file_trouble_.empty()) return {file_trouble_, true};
  return {options_.photos_folder + ": " +
              (files_.empty() ? "no photo yet" : CountOf(static_cast<int>(files_.size()), "photo")),
          false};
}

SourceNote CalibratorRos::TopicNote(bool is_enough) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!topic_trouble_.empty()) return {topic_trouble_, true};
  const bool is_silent = SteadySeconds() - last_image_s_ > kSilence_s;
  if (num_images_ == 0) {
    return {image_topic_ + ": no image yet" +
                (is_silent ? ". Start the camera or the bag, or correct image_topic" : ""),
            is_silent};
  }
  if (!is_silent) return {image_topic_ + ": images come in", false};
  if (is_enough) return {image_topic_ + ": no more images, none are needed", false};
  return {image_topic_ + ": the images have stopped", true};
}

// The topic that a folder's photos are accompanied by may never be meant.
bool CalibratorRos::IsTopicShown() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !image_topic_.empty() && (options_.photos_folder.empty() || num_images_ > 0);
}

void CalibratorRos::OnTimer() {
  std::vector<SourceNote> sources;
  if (!options_.photos_folder.empty()) sources.push_back(FolderNote());
  if (IsTopicShown()) sources.push_back(TopicNote(IsEnough(calibrator_.state())));
  calibrator_.NoteSources(std::move(sources), !SetCameraInfoService().empty());
  diagnostics_.update();
  const CalibratorState state = calibrator_.state();
  if (state.revision == published_revision_ && published_revision_ != 0) return;
  published_revision_ = state.revision;
  plumbline::CalibrationProgress msg = ToCalibrationProgressMsg(state);
  msg.header.stamp = ros::Time::now();
  progress_publisher_.publish(msg);
}

void CalibratorRos::Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const CalibratorState state = calibrator_.state();
  status.summary(DiagnosticStatus::OK, "ok");
  for (const SourceNote& source : state.sources) {
    if (source.is_trouble) status.mergeSummary(DiagnosticStatus::ERROR, source.text);
  }
  status.add("photos with markers", state.progress.coverage.num_photos);
  status.add("images waiting", state.num_waiting);
  status.add("images dropped", state.num_dropped);
  status.add("images that could not be read", state.num_unreadable);
  status.add("advice", *EstimateToShow(state).advice);
}

}  // namespace plumb::ros_adapter
