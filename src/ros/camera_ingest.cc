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
#include "ros/position_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr double kTimerPeriod_s = 0.5;
constexpr std::chrono::milliseconds kWatchFor{500};
constexpr double kComplainEvery_s = 60.0;

// Images of a topic that wait in memory for a full disk: some minutes of a camera at 1 Hz.
constexpr std::size_t kMaxImageBytes = 512U << 20U;

constexpr const char* kGoesOn = ". Nothing is lost, it goes on by itself";

double SteadySeconds() { return ros::SteadyTime::now().toSec(); }

Timestamp Now() { return {static_cast<std::int64_t>(ros::WallTime::now().toNSec())}; }

std::chrono::milliseconds Milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * seconds));
}

}  // namespace

CameraIngest::CameraIngest(const ros::NodeHandle& handle, const CameraIngestOptions& options)
    : handle_(handle),
      options_(options),
      gate_(options.min_listeners, options.recorder_wait_s, SteadySeconds()),
      intake_(options.session_folder),
      diagnostics_(handle, ros::NodeHandle("~")),
      window_(options.max_in_flight, options.resend_after_s) {
  LoadCamera();
  if (!options_.photos_folder.empty()) {
    watcher_ = std::make_unique<FolderWatcher>(options_.photos_folder,
                                               WatchOptions{Milliseconds(options_.untouched_for_s),
                                                            options_.max_subfolder_depth,
                                                            options_.session_folder});
  }
  for (const TakenPhoto& photo : intake_.photos()) window_.Add(photo.sequence);
  photo_publisher_ = handle_.advertise<plumbline::Photo>("photo", 100);
  positions_publisher_ =
      handle_.advertise<plumbline::PhotoPositions>("photo_positions", 1, /*latch=*/true);
  Subscribe();
  diagnostics_.setHardwareID("camera_ingest");
  diagnostics_.add("photos", this, &CameraIngest::Diagnose);
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s), [this](const auto&) {
    TakeImages();
    SendDue();
    PublishPositions();
    diagnostics_.force_update();  // Twice a second: they are what the pilot counts by.
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
  has_new_positions_ = true;
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
  NoteFolder();
  while (!is_stopping_) {
    for (std::string& name : watcher_->Wait(kWatchFor)) names.push_back(std::move(name));
    NoteFolder();
    TakeFiles(&names);
  }
}

void CameraIngest::NoteFolder() {
  if (!watcher_->is_watching()) {
    BeginTrouble(&folder_trouble_,
                 options_.photos_folder +
                     ": this folder is not there. Put the card in or correct photos_folder: "
                     "photos are taken up as soon as it is there, without a restart",
                 0);
  } else if (EndTrouble(&folder_trouble_)) {
    ROS_INFO("%s: the folder is there now; its photos are taken up",
             options_.photos_folder.c_str());
  }
}

// Takes up those it can and leaves the others, to be tried again.
void CameraIngest::TakeFiles(std::vector<std::string>* names) {
  std::vector<std::string> left;
  std::string trouble;
  bool can_write = true;
  for (const std::string& name : *names) {
    if (is_stopping_) return;
    if (!can_write) {
      left.push_back(name);
      continue;
    }
    try {
      TakeFile(name);
    } catch (const UnreadablePhoto& error) {
      if (!std::filesystem::exists(options_.photos_folder + '/' + name)) {
        watcher_->Forget(name);  // The card was pulled: found again when it is back.
        continue;
      }
      left.push_back(name);
      trouble = error.what();
    } catch (const std::runtime_error& error) {
      left.push_back(name);
      trouble = error.what();
      can_write = false;
    }
  }
  *names = std::move(left);
  if (!names->empty()) {
    BeginTrouble(&file_trouble_, trouble + kGoesOn, names->size());
  } else if (const auto num_waited = EndTrouble(&file_trouble_)) {
    ROS_INFO("photos are taken up again, going on: %zu photos were waiting", *num_waited);
  }
}

void CameraIngest::TakeFile(const std::string& name) {
  const std::string folder =
      (std::filesystem::path(options_.photos_folder) / name).parent_path().string();
  bool is_new = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_new = folders_.insert(folder).second;
  }
  if (is_new) ROS_INFO("%s: photos in this folder are taken up", folder.c_str());
  if (const auto photo = intake_.TakeFile(options_.photos_folder, name)) Enqueue(*photo);
}

void CameraIngest::TakeFromTopic(const std::string& source,
                                 const ros::Time& stamp,
                                 const std::vector<std::uint8_t>& bytes) {
  if (stamp.isZero()) {
    ROS_ERROR_THROTTLE(kComplainEvery_s, "image dropped: its stamp is zero");
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!camera_) {
      ROS_WARN_THROTTLE(kComplainEvery_s, "image dropped: no camera_info was heard yet");
      return;
    }
  }
  if (!images_.empty() && num_image_bytes_ + bytes.size() > kMaxImageBytes) {
    ++num_images_lost_;
    return;
  }
  num_image_bytes_ += bytes.size();
  images_.push_back({source, FromRosTime(stamp), bytes});
  TakeImages();
}

// A topic does not bring an image twice: what cannot be kept yet waits here.
void CameraIngest::TakeImages() {
  try {
    while (!images_.empty()) {
      const TopicImage& image = images_.front();
      const auto photo = intake_.TakeBytes(image.source, image.exposure_time, image.bytes);
      num_image_bytes_ -= image.bytes.size();
      images_.pop_front();
      if (photo) Enqueue(*photo);
    }
  } catch (const std::runtime_error& error) {
    const std::string lost = std::to_string(num_images_lost_) + " images of the topic are lost: ";
    BeginTrouble(&image_trouble_,
                 num_images_lost_ > 0 ? lost + error.what() : error.what() + std::string(kGoesOn),
                 images_.size());
    return;
  }
  if (const auto num_waited = EndTrouble(&image_trouble_)) {
    ROS_INFO("images are taken up again, going on: %zu images were waiting", *num_waited);
  }
}

void CameraIngest::Enqueue(const TakenPhoto& photo) {
  const bool is_renamed = photo.source != photo.name;
  ROS_INFO("photo %u: %s%s",
           photo.sequence,
           photo.name.c_str(),
           is_renamed ? (", from " + photo.source).c_str() : "");
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    window_.Add(photo.sequence);
    has_new_positions_ = true;
  }
  SendDue();
}

void CameraIngest::BeginTrouble(Trouble* trouble,
                                const std::string& text,
                                std::size_t num_waiting) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (trouble->Set(text, num_waiting, SteadySeconds())) ROS_ERROR("%s", text.c_str());
}

std::optional<std::size_t> CameraIngest::EndTrouble(Trouble* trouble) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return trouble->Clear();
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
    ROS_ERROR_THROTTLE(kComplainEvery_s, "%s", error.what());
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
    ROS_ERROR_THROTTLE(kComplainEvery_s, "image dropped: %s", error.what());
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

void CameraIngest::SendDue() {
  if (!gate_.MaySend(photo_publisher_.getNumSubscribers(), SteadySeconds())) return;
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
    ROS_ERROR_THROTTLE(kComplainEvery_s, "%s", error.what());
    return;  // It is sent again.
  }
  photo_publisher_.publish(ToPhotoMsg(wire, ToCameraInfoMsg(*camera_), options_.camera_frame_id));
}

// How long the oldest photo without a verdict has been waiting for it.
double CameraIngest::SecondsBehind() const {
  const std::optional<std::uint32_t> oldest = window_.Oldest();
  if (!oldest) return 0.0;
  return static_cast<double>(Now().ns - intake_.photo(*oldest).received.ns) * 1e-9;
}

void CameraIngest::PublishPositions() {
  PhotoPositions positions;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!std::exchange(has_new_positions_, false)) return;
    positions.camera = camera_;
  }
  for (const TakenPhoto& photo : intake_.photos()) {
    if (photo.position) positions.position_of_photo[PhotoId{photo.sequence}] = *photo.position;
  }
  std_msgs::Header header;
  header.frame_id = options_.camera_frame_id;
  header.stamp = ros::Time::now();
  positions_publisher_.publish(ToPhotoPositionsMsg(positions, header));
}

void CameraIngest::Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "ok");
  for (const Trouble* trouble : {&image_trouble_, &file_trouble_, &folder_trouble_}) {
    if (!trouble->text().empty()) status.mergeSummary(DiagnosticStatus::ERROR, trouble->text());
  }
  if (!camera_) status.mergeSummary(DiagnosticStatus::WARN, "no camera_info was heard yet");
  const std::uint32_t num_listeners = photo_publisher_.getNumSubscribers();
  if (!gate_.IsHeard(num_listeners)) {
    status.mergeSummary(DiagnosticStatus::WARN,
                        "the photos wait for the mapper and the marker detector to listen");
  }
  if (gate_.IsRecordingMissed(num_listeners, SteadySeconds())) {
    status.mergeSummary(DiagnosticStatus::ERROR,
                        "photos are not recorded: the recorder has ended. The flight goes on");
  }
  for (const std::string& folder : folders_) status.add("photos in", folder);
  status.add("images waiting for the disk", images_.size());
  status.add("images lost", num_images_lost_);
  status.add("photos taken", intake_.num_photos());
  status.add("seconds behind the camera", SecondsBehind());
  status.add("photos waiting", window_.num_waiting());
  status.add("photos in flight", window_.num_in_flight());
  status.add("photos sent again", window_.num_sent_again());
}

}  // namespace plumb::ros_adapter
