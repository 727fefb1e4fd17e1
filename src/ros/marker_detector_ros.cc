// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/marker_detector_ros.h"

#include <cv_bridge/cv_bridge.h>
#include <plumbline/SearchedPhotos.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>
#include <sys/resource.h>

#include <stdexcept>
#include <utility>

#include "ros/annotated_markers.h"
#include "ros/camera_conversion.h"
#include "ros/marker_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr double kTimerPeriod_s = 0.5;
constexpr double kComplainEvery_s = 60.0;

// As camera_ingest's. Messages are taken from here at once: the stage's queue is the one that
// counts.
constexpr std::uint32_t kPhotoQueue = 100;
constexpr std::uint32_t kDetectionsQueue = 1000;

constexpr const char* kFullQueue =
    "the queue is full: photos come faster than markers are found. With a session, those left out "
    "are searched once nothing waits; else `plumbline detect` finds them afterwards";

double SteadySeconds() { return ros::SteadyTime::now().toSec(); }

plumbline::MarkerDetectionArray AnswerTo(const std_msgs::Header& header,
                                         std::uint32_t sequence,
                                         const std::string& name) {
  plumbline::MarkerDetectionArray answer;
  answer.header = header;
  answer.sequence = sequence;
  answer.name = name;
  return answer;
}

void FillIn(const MarkerSearch& search, double latency_s, plumbline::MarkerDetectionArray* answer) {
  answer->reason = search.problem;
  for (const MarkerDetection& detection : search.detections) {
    answer->detections.push_back(ToMarkerDetectionMsg(detection));
  }
  answer->decode_s = static_cast<float>(search.decode_s);
  answer->detect_s = static_cast<float>(search.detect_s);
  answer->latency_s = static_cast<float>(latency_s);
}

void Log(const plumbline::MarkerDetectionArray& answer) {
  if (answer.reason.empty()) {
    ROS_INFO("%s: %zu markers (%.2f s)",
             answer.name.c_str(),
             answer.detections.size(),
             static_cast<double>(answer.latency_s));
  } else {
    ROS_WARN("%s: not searched for markers: %s", answer.name.c_str(), answer.reason.c_str());
  }
}

}  // namespace

MarkerDetectorRos::MarkerDetectorRos(const ros::NodeHandle& handle,
                                     const MarkerDetectorRosOptions& options)
    : options_(options), diagnostics_(handle, ros::NodeHandle("~")) {
  ros::NodeHandle own(handle);
  detections_publisher_ =
      own.advertise<plumbline::MarkerDetectionArray>("marker_detections", kDetectionsQueue);
  annotated_publisher_ = own.advertise<sensor_msgs::Image>("annotated_markers", 1, /*latch=*/true);
  searched_publisher_ =
      own.advertise<plumbline::SearchedPhotos>("searched_photos", 1, /*latch=*/true);
  if (!options_.session_folder.empty()) GoOnWithSession();
  search_ = std::make_unique<Stage<ArrivedPhoto>>(
      static_cast<std::size_t>(options_.max_queue),
      [this](const ArrivedPhoto& arrived) { Search(arrived); });
  detections_server_ = own.advertiseService(
      "get_marker_detections", &MarkerDetectorRos::OnGetMarkerDetections, this);
  photo_subscriber_ = own.subscribe("photo", kPhotoQueue, &MarkerDetectorRos::OnPhoto, this);
  diagnostics_.setHardwareID("marker_detector");
  diagnostics_.add("markers", this, &MarkerDetectorRos::Diagnose);
  timer_ = own.createWallTimer(ros::WallDuration(kTimerPeriod_s), [this](const auto&) {
    if (unsearched_) SearchUnsearched();
    diagnostics_.update();
  });
}

void MarkerDetectorRos::GoOnWithSession() {
  store_ = std::make_unique<AnswerStore>(options_.session_folder);
  unsearched_ = std::make_unique<UnsearchedPhotos>(options_.session_folder);
  for (plumbline::MarkerDetectionArray& answer : store_->Load()) {
    num_markers_ += answer.detections.size();
    answers_[answer.sequence] = std::move(answer);
  }
  if (answers_.empty()) return;
  ROS_INFO("going on after %zu photos with %zu markers", answers_.size(), num_markers_);
  PublishSearched();
}

// One at a time, when nothing waits: what comes over the wire goes before.
void MarkerDetectorRos::SearchUnsearched() {
  if (search_->counters().queue_depth > 0) return;
  try {
    const std::optional<plumbline::Photo> photo =
        unsearched_->Next([this](std::uint32_t sequence) { return IsAnsweredOrInWork(sequence); });
    if (photo) OnPhoto(*photo);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_THROTTLE(kComplainEvery_s, "%s", error.what());
  }
}

bool MarkerDetectorRos::IsAnsweredOrInWork(std::uint32_t sequence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return answers_.count(sequence) != 0 || in_work_.count(sequence) != 0;
}

bool MarkerDetectorRos::OnGetMarkerDetections(plumbline::GetMarkerDetections::Request&,
                                              plumbline::GetMarkerDetections::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [sequence, answer] : answers_) response.answers.push_back(answer);
  return true;
}

void MarkerDetectorRos::PublishSearched() {
  plumbline::SearchedPhotos msg;
  msg.header.stamp = ros::Time::now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [sequence, answer] : answers_) msg.sequences.push_back(sequence);
  }
  searched_publisher_.publish(msg);
}

void MarkerDetectorRos::OnPhoto(const plumbline::Photo& msg) {
  std::optional<WirePhoto> photo = FromPhotoMsg(msg);
  if (!photo) {
    ROS_ERROR_THROTTLE(5.0, "message on `photo` dropped: no sequence or no file name");
    return;
  }
  if (IsKnown(msg)) return;
  if (search_->TryPush({std::move(*photo), msg.header, msg.camera_info, {}})) return;
  RefuseForFullQueue(msg);
}

// Whether it was answered before, and is now again, or will be. Else it is in work from now on.
bool MarkerDetectorRos::IsKnown(const plumbline::Photo& msg) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = answers_.find(msg.sequence);
  const bool is_answered = known != answers_.end() && known->second.name == msg.name &&
                           known->second.header.stamp == msg.header.stamp;
  if (is_answered) detections_publisher_.publish(known->second);
  return is_answered || !in_work_.insert(msg.sequence).second;
}

// The answer is not kept: sent again, the photo gets another chance.
void MarkerDetectorRos::RefuseForFullQueue(const plumbline::Photo& msg) {
  plumbline::MarkerDetectionArray answer = AnswerTo(msg.header, msg.sequence, msg.name);
  answer.reason = kFullQueue;
  detections_publisher_.publish(answer);
  const std::lock_guard<std::mutex> lock(mutex_);
  in_work_.erase(msg.sequence);
  const std::size_t num_waiting = search_->counters().queue_depth;
  if (full_queue_.Set(kFullQueue, num_waiting, SteadySeconds())) Log(answer);
}

void MarkerDetectorRos::Search(const ArrivedPhoto& arrived) {
  // On Linux that of this thread alone, and of those it starts.
  setpriority(PRIO_PROCESS, 0, options_.niceness);
  MarkerSearch search;
  try {
    const Camera camera = FromCameraInfoMsg(arrived.camera_info, "camera");
    search = SearchForMarkers(options_.detector, camera, arrived.photo.bytes);
  } catch (const std::invalid_argument& error) {
    search.problem = error.what();
  }
  plumbline::MarkerDetectionArray answer =
      AnswerTo(arrived.header, arrived.photo.id.value, arrived.photo.name);
  FillIn(search, arrived.since_arrival.Seconds(), &answer);
  Keep(answer);  // Before anybody hears it: who asks again then gets it again.
  detections_publisher_.publish(answer);
  PublishSearched();
  if (store_) Store(answer);
  Log(answer);
  Show(search, answer);
}

void MarkerDetectorRos::Keep(const plumbline::MarkerDetectionArray& answer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  in_work_.erase(answer.sequence);
  answers_[answer.sequence] = answer;
  latency_.Add(static_cast<double>(answer.latency_s));
  num_markers_ += answer.detections.size();
  if (!answer.reason.empty()) ++num_not_searched_;
  if (search_->counters().queue_depth == 0) full_queue_.Clear();
}

// What a full disk does not take is searched again after a restart.
void MarkerDetectorRos::Store(const plumbline::MarkerDetectionArray& answer) {
  std::string trouble;
  try {
    store_->Save(answer);
  } catch (const std::runtime_error& error) {
    trouble = std::string("the markers are not saved: ") + error.what() +
              ". They are in use all the same, and searched for again after a restart";
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (trouble.empty()) {
    store_trouble_.Clear();
  } else if (store_trouble_.Set(trouble, 0, SteadySeconds())) {
    ROS_ERROR("%s", trouble.c_str());
  }
}

void MarkerDetectorRos::Show(const MarkerSearch& search,
                             const plumbline::MarkerDetectionArray& answer) {
  const cv::Mat picture = DrawAnnotatedMarkers(search, answer.name, options_.annotated_width_px);
  const cv_bridge::CvImage image(answer.header, sensor_msgs::image_encodings::BGR8, picture);
  annotated_publisher_.publish(image.toImageMsg());
}

void MarkerDetectorRos::Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(mutex_);
  const StageCounters counters = search_->counters();
  if (!store_trouble_.text().empty()) {
    status.summary(DiagnosticStatus::ERROR, store_trouble_.text());
  } else if (!full_queue_.text().empty()) {
    status.summary(DiagnosticStatus::WARN, full_queue_.text());
  } else {
    status.summary(DiagnosticStatus::OK, counters.accepted == 0 ? "no photo yet" : "ok");
  }
  status.add("photos answered", answers_.size());
  status.add("photos that could not be searched", num_not_searched_);
  status.add("photos dropped", counters.dropped);
  status.add("markers found", num_markers_);
  status.add("queue", counters.queue_depth);
  if (latency_.IsEmpty()) return;
  status.add("latency last [s]", latency_.Last_s());
  status.add("latency median [s]", latency_.Quantile_s(0.5));
  status.add("latency 95th percentile [s]", latency_.Quantile_s(0.95));
}

}  // namespace plumb::ros_adapter
