// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mesher_ros.h"

#include <plumbline/Gaps.h>
#include <plumbline/GetMap.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "plumbline/map/photo_verdict.h"
#include "ros/camera_conversion.h"
#include "ros/map_conversion.h"
#include "ros/mesh_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr std::uint32_t kDeltaQueue = 1000;
constexpr double kComplainEvery_s = 5.0;

// 0: not known.
std::optional<double> KnownScale(double metres_per_map_unit) {
  return metres_per_map_unit > 0.0 ? std::optional<double>(metres_per_map_unit) : std::nullopt;
}

// Of a file that shows nothing there is no place.
bool IsOfAPlace(const std::string& reason) {
  return reason != ToString(RefusalReason::kUndecodable) &&
         reason != ToString(RefusalReason::kWrongSize) &&
         reason != ToString(RefusalReason::kDuplicate);
}

// Rounded up to tenths.
std::string UpToTenths(double value) {
  std::ostringstream text;
  text << std::ceil(10.0 * value) / 10.0;
  return text.str();
}

}  // namespace

MesherRos::MesherRos(const ros::NodeHandle& handle, const MesherRosOptions& options)
    : handle_(handle),
      options_(options),
      diagnostics_(handle, ros::NodeHandle("~")),
      publisher_(handle, options.map_frame_id),
      metres_per_map_unit_(KnownScale(options.metres_per_map_unit)),
      service_spinner_(1, &service_queue_),
      worker_(static_cast<std::size_t>(options.max_queue), [this](const Work& work) { Do(work); }) {
  look_.palette = *PaletteFromString(options.palette);
  look_.gaps = options.gaps;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    BeginAnew();
  }
  delta_publisher_ = handle_.advertise<plumbline::MeshDelta>("mesh_delta", kDeltaQueue);
  gaps_publisher_ = handle_.advertise<plumbline::Gaps>("gaps", 1, /*latch=*/true);
  get_map_ = handle_.serviceClient<plumbline::GetMap>("get_map");
  subscribers_ = {handle_.subscribe("session_camera", 1, &MesherRos::OnCamera, this),
                  handle_.subscribe("metres_per_map_unit", 1, &MesherRos::OnScale, this),
                  handle_.subscribe("photo_verdict", kDeltaQueue, &MesherRos::OnVerdict, this),
                  handle_.subscribe("stored_photos", 1, &MesherRos::OnStoredPhotos, this),
                  handle_.subscribe("map_delta", kDeltaQueue, &MesherRos::OnMapDelta, this)};
  diagnostics_.setHardwareID("mesher");
  diagnostics_.add("mesher", this, &MesherRos::Diagnose);
  timer_ = handle_.createWallTimer(ros::WallDuration(options_.display_period_s),
                                   [this](const auto&) { OnTimer(); });
  ros::NodeHandle service_handle(handle_);
  service_handle.setCallbackQueue(&service_queue_);
  servers_ = {service_handle.advertiseService("get_mesh", &MesherRos::OnGetMesh, this),
              service_handle.advertiseService("set_mesh_display", &MesherRos::OnSetDisplay, this)};
  service_spinner_.start();
}

MesherRos::~MesherRos() { service_spinner_.stop(); }

void MesherRos::OnMapDelta(const plumbline::MapDelta& msg) {
  std::optional<MapDelta> delta = FromMapDeltaMsg(msg);
  if (!delta) {
    ROS_ERROR_THROTTLE(
        kComplainEvery_s,
        "map delta %u makes no sense and is left out: arrays of unlike lengths, or a "
        "value that is not finite",
        msg.sequence);
    return;
  }
  const ros::Time stamp = msg.header.stamp;
  // One that finds no room is missed: the next one shows the gap, and it is caught up with.
  worker_.TryPush([this, delta = *std::move(delta), stamp] { Apply(delta, stamp); });
}

// A mapper that was restarted may count on from less than was heard.
void MesherRos::OnStoredPhotos(const plumbline::StoredPhotos& msg) {
  worker_.Push([this, started = msg.mapper_started] {
    if (!mapper_started_.isZero() && started != mapper_started_) has_map_ = false;
    mapper_started_ = started;
  });
}

void MesherRos::OnCamera(const sensor_msgs::CameraInfo& msg) {
  try {
    const Camera camera = FromCameraInfoMsg(msg, "camera");
    worker_.Push([this, camera] {  // Latched: it is not said again.
      camera_ = camera;
      Publish(quality_->SetCamera(camera), /*is_snapshot=*/false);
      Repaint();
    });
  } catch (const std::invalid_argument& error) {
    ROS_ERROR_THROTTLE(kComplainEvery_s, "session_camera is of no use: %s", error.what());
  }
}

void MesherRos::OnScale(const std_msgs::Float64& msg) {
  if (!IsScaleOrUnknown(msg.data)) {
    ROS_ERROR_THROTTLE(kComplainEvery_s,
                       "metres_per_map_unit: %g is left out, the scale stays as it was; send 0.001 "
                       "to 1000, or 0 if it is not known",
                       msg.data);
    return;
  }
  worker_.Push([this, scale = KnownScale(msg.data)] {
    if (scale == metres_per_map_unit_) return;
    metres_per_map_unit_ = scale;
    Repaint();
  });
}

void MesherRos::OnVerdict(const plumbline::PhotoVerdict& msg) {
  worker_.Push([this, msg] {
    const PhotoId photo{msg.sequence};
    const bool is_refused =
        msg.status == plumbline::PhotoVerdict::REFUSED && IsOfAPlace(msg.reason);
    if (!is_refused && refused_.erase(photo) == 0) return;
    if (is_refused) refused_[photo] = {msg.name, msg.reason};
    is_told_ = false;
  });
}

void MesherRos::OnTimer() {
  diagnostics_.update();
  worker_.TryPush([this] {
    if (!has_map_ && get_map_.exists()) CatchUp();
    if (publisher_.HasNewListener()) publisher_.PublishBlocks(*quality_, {}, look_);
    if (!is_told_) TellNow();
  });
}

void MesherRos::Do(const Work& work) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    work();
  } catch (const std::exception& error) {
    ROS_ERROR("the mesh is begun anew: %s", error.what());
    trouble_ = error.what();
    BeginAnew();
  }
}

void MesherRos::BeginAnew() {
  surface_ = std::make_unique<SurfaceMesher>(options_.surface);
  quality_ = std::make_unique<QualityMap>(options_.quality);
  if (camera_) quality_->SetCamera(*camera_);
  look_.measure = MakeMeasure();
  has_map_ = false;
  first_gap_.reset();
}

void MesherRos::Apply(const MapDelta& delta, const ros::Time& stamp) {
  if (!has_map_ && !delta.is_snapshot) CatchUp();
  if (!has_map_ && !delta.is_snapshot) return;  // The timer asks for the whole again.
  const bool is_old = !delta.is_snapshot && delta.sequence <= surface_->map_sequence();
  if (is_old && delta.sequence > 1) return;  // A snapshot had it.
  if (!is_old && TryApply(delta, stamp)) return;
  CatchUp();  // One was missed, or the mapper has begun another map.
  if (delta.sequence == surface_->map_sequence() + 1) TryApply(delta, stamp);
}

bool MesherRos::TryApply(const MapDelta& delta, const ros::Time& stamp) {
  const std::optional<SurfaceUpdate> surface = surface_->Apply(delta);
  if (!surface) return false;
  for (const SurfaceProblem& problem : surface->report.problems) {
    ROS_WARN_THROTTLE(kComplainEvery_s, "left out of the mesh: %s", Describe(problem).c_str());
  }
  const QualityUpdate update = quality_->Apply(delta, surface->mesh);
  const SurfaceReport& report = surface->report;
  surface_time_.Add(report.scene_s + report.tetrahedra_s + report.weights_s + report.cut_s +
                    report.mesh_s);
  quality_time_.Add(update.seconds);
  has_map_ = true;
  trouble_.clear();
  Publish(update, delta.is_snapshot);
  if (!stamp.isZero()) delay_.Add(std::max(0.0, (ros::Time::now() - stamp).toSec()));
  return true;
}

void MesherRos::CatchUp() {
  plumbline::GetMap request;
  if (!get_map_.call(request)) {
    ROS_WARN_THROTTLE(kComplainEvery_s, "the map is not to be had; asking again");
    has_map_ = false;
    return;
  }
  const std::optional<MapDelta> snapshot = FromMapDeltaMsg(request.response.snapshot);
  if (!snapshot || !snapshot->is_snapshot) {
    ROS_ERROR_THROTTLE(kComplainEvery_s, "get_map gave a map that makes no sense; asking again");
    has_map_ = false;
    return;
  }
  TryApply(*snapshot, {});
}

void MesherRos::Publish(const QualityUpdate& update, bool is_snapshot) {
  look_.measure = MakeMeasure();
  is_told_ = false;
  std::vector<BlockId> blocks = update.blocks;
  if (is_snapshot) {  // Of what was there before, nothing may stay.
    blocks.clear();
    for (const auto& [id, block] : quality_->blocks()) blocks.push_back(id);
    publisher_.Repaint(*quality_, look_);
  } else {
    publisher_.PublishBlocks(*quality_, update, look_);
  }
  if (blocks.empty() && !update.is_noise_changed && !is_snapshot) return;
  ++sequence_;
  delta_publisher_.publish(MakeMessage(blocks, is_snapshot || sequence_ == 1));
}

void MesherRos::Repaint() {
  look_.measure = MakeMeasure();
  publisher_.Repaint(*quality_, look_);
  publisher_.PublishLegends(look_);
  is_told_ = false;
}

// Not at each delta: who looks at them cannot follow faster.
void MesherRos::TellNow() {
  is_told_ = true;
  publisher_.PublishRefused(refused_, quality_->views());
  if (!quality_->camera()) return;
  std::vector<Gap> gaps =
      FindGaps(look_.gaps, quality_->blocks(), look_.measure, options_.surface.block_side);
  if (first_gap_) KeepFirst(*first_gap_, &gaps);
  first_gap_ = gaps.empty() ? std::nullopt : std::optional<Gap>(gaps.front());
  num_gaps_ = gaps.size();
  plumbline::Gaps msg = ToGapsMsg(gaps, look_.gaps, look_.measure, NewestView());
  msg.header = publisher_.HeaderNow();
  msg.map_sequence = surface_->map_sequence();
  gaps_publisher_.publish(msg);
  publisher_.PublishGaps(gaps, quality_->views());
}

plumbline::MeshDelta MesherRos::MakeMessage(const std::vector<BlockId>& blocks,
                                            bool is_snapshot) const {
  plumbline::MeshDelta msg;
  msg.header = publisher_.HeaderNow();
  msg.sequence = sequence_;
  msg.is_snapshot = static_cast<std::uint8_t>(is_snapshot);
  msg.map_sequence = surface_->map_sequence();
  msg.noise_px = quality_->noise_px();
  msg.metres_per_map_unit = metres_per_map_unit_.value_or(0.0);
  for (const BlockId& id : blocks) {
    const auto found = quality_->blocks().find(id);
    QualityBlock gone;
    gone.mesh.id = id;
    msg.blocks.push_back(ToMeshBlockMsg(found != quality_->blocks().end() ? found->second : gone));
  }
  return msg;
}

Measure MesherRos::MakeMeasure() const {
  Measure measure;
  measure.metres_per_map_unit = metres_per_map_unit_;
  measure.noise_px = quality_->noise_px();
  // Without a camera no face is seen, and no GSD is too fine to be wanted.
  const std::optional<Camera>& camera = quality_->camera();
  measure.focal_length_px = camera ? camera->MeanFocalLength() : 1e9;
  if (camera) measure.half_photo_px = 0.5 * std::min(camera->width_px(), camera->height_px());
  return measure;
}

std::optional<Rigid3> MesherRos::NewestView() const {
  if (quality_->views().empty()) return std::nullopt;
  return quality_->views().rbegin()->second;
}

bool MesherRos::OnGetMesh(plumbline::GetMesh::Request&, plumbline::GetMesh::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<BlockId> blocks;
  for (const auto& [id, block] : quality_->blocks()) blocks.push_back(id);
  response.snapshot = MakeMessage(blocks, /*is_snapshot=*/true);
  return true;
}

bool MesherRos::OnSetDisplay(plumbline::SetMeshDisplay::Request& request,
                             plumbline::SetMeshDisplay::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  MeshLook look = look_;
  std::vector<std::string> problems;
  if (!request.palette.empty()) {
    const std::optional<Palette> palette = PaletteFromString(request.palette);
    if (!palette) problems = {"palette must be paper or colour_blind, but is " + request.palette};
    look.palette = palette.value_or(look.palette);
  }
  if (request.wanted_gsd != 0.0) {
    (metres_per_map_unit_ ? look.gaps.wanted_gsd_mm : look.gaps.wanted_relative_gsd) =
        request.wanted_gsd;
    for (const std::string& problem : look.gaps.Problems()) problems.push_back(problem);
    const double finest = FinestGsd(look.gaps, MakeMeasure());
    if (request.wanted_gsd > 0.0 && request.wanted_gsd < finest) {
      problems.push_back("no finer than " + UpToTenths(finest) +
                         " from the least distance to the wall (gaps/" +
                         (metres_per_map_unit_ ? "min_distance_m)" : "min_relative_distance)"));
    }
  }
  response.success = static_cast<std::uint8_t>(problems.empty());
  for (const std::string& problem : problems) {
    response.message += (response.message.empty() ? "" : "; ") + problem;
  }
  if (!problems.empty()) return true;
  const bool is_painted_anew = look.palette != look_.palette;
  look_ = look;
  if (is_painted_anew) publisher_.Repaint(*quality_, look_);
  publisher_.PublishLegends(look_);
  is_told_ = false;
  return true;
}

void MesherRos::Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const StageCounters counters = worker_.counters();
  const std::lock_guard<std::mutex> lock(mutex_);
  status.summary(DiagnosticStatus::OK, "ok");
  if (!camera_) status.mergeSummary(DiagnosticStatus::WARN, "session_camera was not heard yet");
  if (!has_map_) status.mergeSummary(DiagnosticStatus::WARN, "no map was heard yet");
  if (!trouble_.empty()) status.mergeSummary(DiagnosticStatus::ERROR, trouble_);
  std::size_t num_faces = 0;
  for (const auto& [id, block] : quality_->blocks()) num_faces += block.mesh.faces.size();
  status.add("faces", num_faces);
  status.add("blocks", quality_->blocks().size());
  status.add("gaps", num_gaps_);
  status.add("noise [px]", quality_->noise_px());
  status.add("is metric", metres_per_map_unit_ ? "yes" : "no");
  status.add("queue", counters.queue_depth);
  status.add("dropped and caught up with", counters.dropped);
  if (surface_time_.IsEmpty()) return;
  status.add("surface median [s]", surface_time_.Quantile_s(0.5));
  status.add("quality median [s]", quality_time_.Quantile_s(0.5));
  if (delay_.IsEmpty()) return;
  status.add("map to mesh last [s]", delay_.Last_s());
  status.add("map to mesh median [s]", delay_.Quantile_s(0.5));
  status.add("map to mesh 95th percentile [s]", delay_.Quantile_s(0.95));
}

}  // namespace plumb::ros_adapter
