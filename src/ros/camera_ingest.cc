// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/camera_ingest.h"

#include <cv_bridge/cv_bridge.h>
#include <plumbline/Photo.h>

#include <chrono>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <utility>

#include "plumbline/common/atomic_file.h"
#include "ros/camera_conversion.h"
#include "ros/geometry_conversion.h"
#include "ros/photo_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr double kTimerPeriod_s = 0.5;
constexpr std::chrono::milliseconds kWatchFor{500};

double SteadySeconds() { return ros::SteadyTime::now().toSec(); }

Timestamp Now() { return {static_cast<std::int64_t>(ros::WallTime::now().toNSec())}; }

std::chrono::milliseconds Milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * seconds));
}

}  // namespace

CameraIngest::CameraIngest(const ros::NodeHandle& handle, const CameraIngestOptions& options)
    : handle_(handle),
      options_(options),
      intake_(options.session_folder),
      diagnostics_(handle, ros::NodeHandle("~")),
      window_(options.max_in_flight, options.resend_after_s) {
  LoadCamera();
  if (!options_.photos_folder.empty()) {
    watcher_ = std::make_unique<FolderWatcher>(options_.photos_folder,
                                               Milliseconds(options_.untouched_for_s));
  }
  for (const TakenPhoto& photo : intake_.photos()) window_.Add(photo.sequence);
  photo_publisher_ = handle_.advertise<plumbline::Photo>("photo", 100);
  Subscribe();
  diagnostics_.setHardwareID("camera");
  diagnostics_.add("photos", this, &CameraIngest::Diagnose);
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s), [this](const auto&) {
    SendDue();
    diagnostics_.update();
  });
  if (watcher_) watching_ = std::thread([this] { WatchFolder(); });
}

CameraIngest::~CameraIngest() {
  is_stopping_ = true;
  if (watching_.joinable()) watching_.join();
}

// The camera of the file or, for a session begun with one from a topic, that of the session.
void CameraIngest::LoadCamera() {
  const std::string kept = options_.session_folder + "/camera.yaml";
  std::optional<Camera> camera;
  if (!options_.camera_file.empty()) {
    camera = ReadCameraYaml(options_.camera_file);
  } else if (std::filesystem::exists(kept)) {
    camera = ReadCameraYaml(kept);
  }
  if (camera) SetCamera(*camera);
}

// Keeps the camera with the session, which has only one.
void CameraIngest::SetCamera(const Camera& camera) {
  const std::string kept = options_.session_folder + "/camera.yaml";
  if (!std::filesystem::exists(kept)) {
    WriteFileAtomically(kept, ToCameraYaml(camera));
  } else if (!IsSameCamera(ReadCameraYaml(kept), camera)) {
    throw std::runtime_error("the session was begun with another camera, see " + kept +
                             "; take another session folder");
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  camera_ = camera;
}

void CameraIngest::Subscribe() {
  subscribers_.push_back(handle_.subscribe("photo_verdict", 1000, &CameraIngest::OnVerdict, this));
  subscribers_.push_back(
      handle_.subscribe("stored_photos", 10, &CameraIngest::OnStoredPhotos, this));
  if (!options_.image_topic.empty()) {
    subscribers_.push_back(
        handle_.subscribe(options_.image_topic, 10, &CameraIngest::OnImage, this));
  }
  if (!options_.compressed_image_topic.empty()) {
    subscribers_.push_back(handle_.subscribe(
        options_.compressed_image_topic, 10, &CameraIngest::OnCompressedImage, this));
  }
  if (options_.camera_file.empty()) {
    subscribers_.push_back(
        handle_.subscribe(options_.camera_info_topic, 10, &CameraIngest::OnCameraInfo, this));
  }
}

void CameraIngest::WatchFolder() {
  std::vector<std::string> names;  // Those still to be taken up, after a full disk for instance.
  while (!is_stopping_) {
    for (std::string& name : watcher_->Wait(kWatchFor)) names.push_back(std::move(name));
    std::vector<std::string> left;
    for (const std::string& name : names) {
      if (!left.empty() || !TakeFile(name)) left.push_back(name);
    }
    names = std::move(left);
    is_folder_gone_ = !watcher_->is_watching();
    if (is_folder_gone_) ROS_ERROR_THROTTLE(5.0, "%s is gone", options_.photos_folder.c_str());
  }
}

// False if it must be tried again.
bool CameraIngest::TakeFile(const std::string& name) {
  const std::string path = options_.photos_folder + '/' + name;
  try {
    if (const std::optional<TakenPhoto> photo = intake_.TakeFile(path)) Enqueue(*photo);
    return true;
  } catch (const std::runtime_error& error) {
    ROS_ERROR_THROTTLE(5.0, "%s is not taken up yet: %s", path.c_str(), error.what());
    const std::lock_guard<std::mutex> lock(mutex_);
    trouble_ = error.what();
    return !std::filesystem::exists(path);
  }
}

void CameraIngest::TakeFromTopic(const std::string& source,
                                 const ros::Time& stamp,
                                 const std::vector<std::uint8_t>& bytes) {
  if (stamp.isZero()) {
    ROS_ERROR_THROTTLE(5.0, "image dropped: its stamp is zero");
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!camera_) {
      ROS_WARN_THROTTLE(5.0, "image dropped: no camera_info was heard yet");
      return;
    }
  }
  try {
    const auto photo = intake_.TakeBytes(source, FromRosTime(stamp), bytes);
    if (photo) Enqueue(*photo);
  } catch (const std::runtime_error& error) {
    ROS_ERROR("the image of %.3f s is lost: %s", stamp.toSec(), error.what());
    const std::lock_guard<std::mutex> lock(mutex_);
    trouble_ = error.what();
  }
}

void CameraIngest::Enqueue(const TakenPhoto& photo) {
  ROS_INFO("photo %u: %s", photo.sequence, photo.name.c_str());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    trouble_.clear();
    window_.Add(photo.sequence);
  }
  SendDue();
}

void CameraIngest::OnCameraInfo(const sensor_msgs::CameraInfo& msg) {
  try {
    const Camera camera = FromCameraInfoMsg(msg, "camera");
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (camera_ && IsSameCamera(*camera_, camera)) return;
    }
    SetCamera(camera);
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(5.0, "%s", error.what());
  }
}

void CameraIngest::OnImage(const sensor_msgs::ImageConstPtr& msg) {
  std::vector<std::uint8_t> bytes;
  try {
    const bool is_color = sensor_msgs::image_encodings::numChannels(msg->encoding) > 1 ||
                          sensor_msgs::image_encodings::isBayer(msg->encoding);
    const auto image = cv_bridge::toCvShare(msg, is_color ? "bgr8" : "mono8");
    cv::imencode(".png", image->image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const std::exception& error) {  // cv_bridge's, OpenCV's and image_encodings' own.
    ROS_ERROR_THROTTLE(5.0, "image dropped: %s", error.what());
    return;
  }
  TakeFromTopic(std::to_string(msg->header.stamp.toNSec()) + ".png", msg->header.stamp, bytes);
}

void CameraIngest::OnCompressedImage(const sensor_msgs::CompressedImage& msg) {
  const bool is_png = ImageFormat(msg.data) == "png";
  TakeFromTopic(std::to_string(msg.header.stamp.toNSec()) + (is_png ? ".png" : ".jpg"),
                msg.header.stamp,
                msg.data);
}

void CameraIngest::OnVerdict(const plumbline::PhotoVerdict& msg) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    window_.Answer(msg.sequence);
  }
  SendDue();
}

void CameraIngest::OnStoredPhotos(const plumbline::StoredPhotos& msg) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (msg.mapper_started == mapper_started_) return;
    mapper_started_ = msg.mapper_started;
    window_.Restart(msg.sequences);
  }
  SendDue();
}

bool CameraIngest::IsHeard() const {
  return photo_publisher_.getNumSubscribers() >= static_cast<std::uint32_t>(options_.min_listeners);
}

void CameraIngest::SendDue() {
  if (!IsHeard()) return;
  while (!is_stopping_) {
    std::optional<std::uint32_t> sequence;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!camera_) return;
      sequence = window_.Next(SteadySeconds());
      if (!sequence) return;
    }
    Send(*sequence);
  }
}

void CameraIngest::Send(std::uint32_t sequence) {
  const TakenPhoto photo = intake_.photo(sequence);
  WirePhoto wire{PhotoId{sequence},
                 photo.name,
                 photo.exposure_time,
                 photo.position,
                 photo.received,
                 Now(),
                 {}};
  try {
    wire.bytes = intake_.ReadBytes(photo);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_THROTTLE(5.0, "%s", error.what());
    return;  // It is sent again.
  }
  photo_publisher_.publish(ToPhotoMsg(wire, ToCameraInfoMsg(*camera_), options_.camera_frame_id));
}

void CameraIngest::Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  using diagnostic_msgs::DiagnosticStatus;
  if (!trouble_.empty()) {
    status.summary(DiagnosticStatus::ERROR, trouble_);
  } else if (is_folder_gone_) {
    status.summary(DiagnosticStatus::ERROR, "the folder " + options_.photos_folder + " is gone");
  } else if (!camera_) {
    status.summary(DiagnosticStatus::WARN, "no camera_info was heard yet");
  } else if (!IsHeard()) {
    status.summary(DiagnosticStatus::WARN, "nobody listens to the photos yet");
  } else {
    status.summary(DiagnosticStatus::OK, "ok");
  }
  status.add("photos waiting", window_.num_waiting());
  status.add("photos in flight", window_.num_in_flight());
  status.add("photos sent again", window_.num_sent_again());
}

}  // namespace plumb::ros_adapter
