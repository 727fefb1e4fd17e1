// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mapper_ros.h"

#include <plumbline/PhotoVerdict.h>
#include <plumbline/StoredPhotos.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "ros/camera_conversion.h"
#include "ros/constraints_conversion.h"
#include "ros/run_node.h"
#include "ros/verdict_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr double kTimerPeriod_s = 0.5;

// Messages wait here while a reply is prepared; the mapper's own queue is the one that counts.
constexpr std::uint32_t kPhotoQueue = 4;
constexpr std::uint32_t kVerdictQueue = 1000;

double SteadySeconds() { return ros::SteadyTime::now().toSec(); }

std::string NotSaved(const std::string& trouble) {
  return "the session is not saved: " + trouble + ". Nothing is lost, it goes on by itself";
}

void LogVerdict(const PhotoVerdict& verdict) {
  if (verdict.status == VerdictStatus::kRefused) {
    ROS_WARN("%s: refused, %s (%.2f s): %s",
             verdict.name.c_str(),
             ToString(verdict.reason),
             verdict.seconds.verdict_s,
             verdict.hint.c_str());
    return;
  }
  ROS_INFO("%s: %s (%.2f s) %s",
           verdict.name.c_str(),
           ToString(verdict.status),
           verdict.seconds.verdict_s,
           verdict.hint.c_str());
}

}  // namespace

MapperRos::MapperRos(const ros::NodeHandle& handle, const MapperRosOptions& options)
    : handle_(handle),
      options_(options),
      started_(static_cast<double>(ros::WallTime::now().toSec())),
      diagnostics_(handle, ros::NodeHandle("~")) {
  // Latched: RViz may be opened late.
  verdict_publisher_ =
      handle_.advertise<plumbline::PhotoVerdict>("photo_verdict", kVerdictQueue, /*latch=*/true);
  stored_publisher_ =
      handle_.advertise<plumbline::StoredPhotos>("stored_photos", 1, /*latch=*/true);
  if (std::filesystem::exists(options_.session_folder + "/session.db")) {
    const Camera camera = SessionStore::OpenExisting(options_.session_folder).camera();
    Start(camera);
  } else {
    PublishStored({});
  }
  photo_subscriber_ = handle_.subscribe("photo", kPhotoQueue, &MapperRos::OnPhoto, this);
  control_points_subscriber_ =
      handle_.subscribe("control_points", 1, &MapperRos::OnControlPoints, this);
  diagnostics_.setHardwareID("mapper");
  diagnostics_.add("mapper", this, &MapperRos::Diagnose);
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s),
                                   [this](const auto&) { OnTimer(); });
  ros::NodeHandle service_handle(handle_);
  service_handle.setCallbackQueue(&service_queue_);
  finish_server_ = service_handle.advertiseService("finish", &MapperRos::OnFinish, this);
  service_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &service_queue_);
  service_spinner_->start();
}

MapperRos::~MapperRos() {
  service_spinner_->stop();
  live_.reset();
}

void MapperRos::Start(const Camera& camera) {
  publisher_ = std::make_unique<MapPublisher>(handle_, options_, camera);
  auto live = std::make_unique<LiveMapper>(
      options_.mapper, options_.session_folder, camera, options_.max_queue, MakeOutput());
  publisher_->ServeMap();
  if (constraints_) live->SetConstraints(*std::exchange(constraints_, std::nullopt));
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [photo, verdict] : live->verdicts()) status_of_photo_[photo] = verdict.status;
  live_ = std::move(live);
  if (status_of_photo_.empty()) return;
  ROS_INFO("going on after %zu photos (%d accepted)",
           status_of_photo_.size(),
           CountPhotos().num_accepted);
}

// The session is made with the first photo, whose camera it has.
void MapperRos::StartWith(const Camera& camera) {
  try {
    Start(camera);
  } catch (const std::runtime_error& error) {
    throw IncurableError(error.what());
  }
}

LiveMapperOutput MapperRos::MakeOutput() {
  LiveMapperOutput output;
  output.on_verdict = [this](const PhotoVerdict& verdict, const PhotoBytes& bytes) {
    PublishVerdict(verdict, bytes);
  };
  output.on_map_delta = [this](const MapDelta& delta) { publisher_->OnMapDelta(delta); };
  output.on_stored = [this](const std::vector<std::uint32_t>& sequences) {
    PublishStored(sequences);
  };
  output.on_storage_trouble = [this](const std::string& trouble, std::size_t num_waiting) {
    NoteStorageTrouble(trouble, num_waiting);
  };
  return output;
}

void MapperRos::NoteStorageTrouble(const std::string& trouble, std::size_t num_waiting) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (trouble.empty()) {
    const std::size_t num_waited = storage_trouble_.Clear().value_or(0);
    ROS_INFO("the session is saved again, going on: %zu photos were waiting", num_waited);
  } else if (storage_trouble_.Set(NotSaved(trouble), num_waiting, SteadySeconds())) {
    ROS_ERROR("%s", storage_trouble_.text().c_str());
  }
}

void MapperRos::OnPhoto(const plumbline::Photo& msg) {
  std::optional<WirePhoto> photo = FromPhotoMsg(msg);
  if (!photo) {
    ROS_ERROR_THROTTLE(5.0, "message on `photo` dropped: no sequence or no file name");
    return;
  }
  std::optional<Camera> camera;
  try {
    camera = FromCameraInfoMsg(msg.camera_info, "camera");
  } catch (const std::invalid_argument& error) {
    ROS_ERROR_THROTTLE(5.0, "%s dropped: %s", photo->name.c_str(), error.what());
    return;
  }
  if (!live_) StartWith(*camera);
  if (!IsSameCamera(*camera, live_->camera())) return RefuseOtherCamera(*photo);
  const std::string name = photo->name;
  if (live_->Offer(std::move(*photo))) return;
  ROS_WARN("%s dropped: the queue is full; it is sent again", name.c_str());
  const std::lock_guard<std::mutex> lock(mutex_);
  ++num_dropped_;
}

void MapperRos::RefuseOtherCamera(const WirePhoto& photo) {
  PhotoVerdict verdict;
  verdict.photo = photo.id;
  verdict.name = photo.name;
  verdict.status = VerdictStatus::kRefused;
  verdict.reason = RefusalReason::kWrongSize;
  verdict.hint =
      "It came with another camera calibration than this session's; begin a new session.";
  PublishVerdict(verdict, nullptr);
}

void MapperRos::OnControlPoints(const plumbline::ControlPoints& msg) {
  std::optional<BundleConstraints> constraints = FromControlPointsMsg(msg);
  if (!constraints) {
    ROS_ERROR_THROTTLE(5.0, "message on `control_points` dropped: its numbers make no sense");
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    num_control_points_ = static_cast<std::size_t>(std::count_if(
        constraints->markers.begin(), constraints->markers.end(), [](const MarkerTrack& track) {
          return track.survey.has_value();
        }));
  }
  if (live_) {
    live_->SetConstraints(std::move(*constraints));
  } else {
    constraints_ = std::move(constraints);
  }
}

void MapperRos::OnTimer() {
  if (live_) {
    live_->RethrowFailure();
    live_->Poll();
  }
  diagnostics_.force_update();  // Twice a second: they are what the pilot counts by.
}

bool MapperRos::OnFinish(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  LiveMapper* live = nullptr;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    live = live_.get();
  }
  const std::string trouble = live != nullptr ? live->Finish() : ReportNoPhotos();
  const std::lock_guard<std::mutex> lock(mutex_);
  const PhotoCounts counts = CountPhotos();
  response.success = trouble.empty();
  response.message = trouble.empty() ? std::to_string(counts.num_accepted) + " accepted, " +
                                           std::to_string(counts.num_waiting) + " waiting, " +
                                           std::to_string(counts.num_refused) + " refused"
                                     : NotSaved(trouble) + "; then call finish again";
  return true;
}

// Without a photo there is no camera, and so no session yet to report on.
std::string MapperRos::ReportNoPhotos() const {
  RunReport report;
  report.wall_s = (ros::WallTime::now() - ros::WallTime(started_.toSec())).toSec();
  report.usage = CurrentProcessUsage();
  report.options = OptionsToJson(options_.mapper);
  try {
    std::filesystem::create_directories(options_.session_folder);
    WriteRunReport(report, options_.session_folder + "/report.json");
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

// The verdict goes out before anything else is done about it.
void MapperRos::PublishVerdict(const PhotoVerdict& verdict, const PhotoBytes& bytes) {
  verdict_publisher_.publish(ToVerdictMsg(verdict, options_.map_frame_id, ros::Time::now()));
  PhotoCounts counts;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_of_photo_[verdict.photo] = verdict.status;
    counts = CountPhotos();
    if (bytes) latency_.Add(verdict.seconds.verdict_s);
  }
  LogVerdict(verdict);
  if (bytes) publisher_->OnVerdict(verdict, bytes, counts);
}

void MapperRos::PublishStored(const std::vector<std::uint32_t>& sequences) {
  plumbline::StoredPhotos msg;
  msg.header.stamp = ros::Time::now();
  msg.mapper_started = started_;
  msg.sequences = sequences;
  stored_publisher_.publish(msg);
}

PhotoCounts MapperRos::CountPhotos() const {
  PhotoCounts counts;
  for (const auto& [photo, status] : status_of_photo_) {
    if (status == VerdictStatus::kAccepted) ++counts.num_accepted;
    if (status == VerdictStatus::kWaiting) ++counts.num_waiting;
    if (status == VerdictStatus::kRefused) ++counts.num_refused;
  }
  return counts;
}

void MapperRos::Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!storage_trouble_.text().empty()) {
    status.summary(DiagnosticStatus::ERROR, storage_trouble_.text());
  } else if (!live_) {
    status.summary(DiagnosticStatus::OK, "no photo yet");
  } else {
    status.summary(DiagnosticStatus::OK, "ok");
  }
  const PhotoCounts counts = CountPhotos();
  status.add("photos accepted", counts.num_accepted);
  status.add("photos waiting", counts.num_waiting);
  status.add("photos refused", counts.num_refused);
  status.add("photos dropped and to be sent again", num_dropped_);
  status.add("control points of the bundle", num_control_points_);
  if (!latency_.IsEmpty()) {
    status.add("latency last [s]", latency_.Last_s());
    status.add("latency median [s]", latency_.Quantile_s(0.5));
    status.add("latency 95th percentile [s]", latency_.Quantile_s(0.95));
  }
  if (!live_) return;
  status.add("queue of features", live_->analysis_counters().queue_depth);
  status.add("queue of mapping", live_->mapping_counters().queue_depth);
  status.add("queue of disk", live_->storage_counters().queue_depth);
}

}  // namespace plumb::ros_adapter
