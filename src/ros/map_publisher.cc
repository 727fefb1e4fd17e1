// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/map_publisher.h"

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/TransformStamped.h>
#include <plumbline/MapDelta.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <utility>

#include "ros/camera_conversion.h"
#include "ros/geometry_conversion.h"
#include "ros/map_conversion.h"
#include "ros/map_drawing.h"

namespace plumb::ros_adapter {
namespace {

// Deltas are never dropped: beyond these the mapper waits, after its verdict.
constexpr std::size_t kMaxDeltaQueue = 256;

constexpr double kTfPeriod_s = 0.5;

double Radians(double degrees) { return degrees * M_PI / 180.0; }

std_msgs::Header HeaderNow(const std::string& frame_id) {
  std_msgs::Header header;
  header.frame_id = frame_id;
  header.stamp = ros::Time::now();
  return header;
}

}  // namespace

MapPublisher::MapPublisher(const ros::NodeHandle& handle,
                           const MapperRosOptions& options,
                           const Camera& camera)
    : options_(options),
      camera_(camera),
      service_handle_(handle),
      service_spinner_(1, &service_queue_),
      drawing_(1, [this](Wake) { Draw(); }),
      publishing_(kMaxDeltaQueue, [this](const std::optional<MapDelta>& delta) {
        delta ? PublishDelta(*delta) : AdvertiseMap();
      }) {
  ros::NodeHandle own(handle);
  delta_publisher_ = own.advertise<plumbline::MapDelta>("map_delta", 1000);
  camera_publisher_ = own.advertise<sensor_msgs::CameraInfo>("session_camera", 1, /*latch=*/true);
  sensor_msgs::CameraInfo camera_info = ToCameraInfoMsg(camera);
  camera_info.header = HeaderNow(options.camera_frame_id);
  camera_publisher_.publish(camera_info);
  points_publisher_ = own.advertise<sensor_msgs::PointCloud2>("points", 1, /*latch=*/true);
  cameras_publisher_ = own.advertise<visualization_msgs::MarkerArray>("cameras", 1, /*latch=*/true);
  path_publisher_ = own.advertise<nav_msgs::Path>("camera_path", 1, /*latch=*/true);
  annotated_publisher_ = own.advertise<sensor_msgs::Image>("annotated_photo", 1, /*latch=*/true);
  draw_timer_ = own.createWallTimer(ros::WallDuration(0.5 * options.display_period_s),
                                    [this](const auto&) { drawing_.TryPush({}); });
  tf_timer_ = own.createWallTimer(ros::WallDuration(kTfPeriod_s),
                                  [this](const auto&) { BroadcastFrames(); });
  service_handle_.setCallbackQueue(&service_queue_);
  service_spinner_.start();
}

MapPublisher::~MapPublisher() { service_spinner_.stop(); }

void MapPublisher::OnMapDelta(const MapDelta& delta) { publishing_.Push(delta); }

void MapPublisher::ServeMap() { publishing_.Push(std::nullopt); }

void MapPublisher::AdvertiseMap() {
  get_map_server_ = service_handle_.advertiseService("get_map", &MapPublisher::GetMap, this);
}

void MapPublisher::OnVerdict(const PhotoVerdict& verdict,
                             const PhotoBytes& bytes,
                             const PhotoCounts& counts) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    annotation_ = Annotation{verdict, bytes, counts};
  }
  drawing_.TryPush({});
}

void MapPublisher::PublishDelta(const MapDelta& delta) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!map_.Apply(delta)) ROS_ERROR("delta %u does not follow the last one", delta.sequence);
    is_drawn_ = false;
  }
  delta_publisher_.publish(ToMapDeltaMsg(delta, options_.map_frame_id, ros::Time::now()));
  if (!delta.views_set.empty()) BroadcastFrames();
}

void MapPublisher::Draw() {
  std::optional<Annotation> annotation;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    annotation = std::exchange(annotation_, std::nullopt);
  }
  if (annotation) DrawAnnotation(*annotation);
  DrawMap();
}

void MapPublisher::DrawAnnotation(const Annotation& annotation) {
  const cv::Mat picture = DrawAnnotatedPhoto(*annotation.bytes,
                                             annotation.verdict,
                                             annotation.counts,
                                             camera_.width_px(),
                                             camera_.height_px(),
                                             options_.annotated_width_px);
  const cv_bridge::CvImage image(
      HeaderNow(options_.camera_frame_id), sensor_msgs::image_encodings::BGR8, picture);
  annotated_publisher_.publish(image.toImageMsg());
}

void MapPublisher::DrawMap() {
  const std_msgs::Header header = HeaderNow(options_.map_frame_id);
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (is_drawn_ || (now - last_drawn_).toSec() < options_.display_period_s) return;
  is_drawn_ = true;
  last_drawn_ = now;
  points_publisher_.publish(DrawPoints(map_, options_.min_drawn_views, header));
  cameras_publisher_.publish(DrawFrusta(map_, camera_, header));
  path_publisher_.publish(DrawPath(map_, header));
  const Overview overview{Radians(options_.overview_yaw_deg),
                          Radians(options_.overview_pitch_deg),
                          options_.overview_distance,
                          Radians(options_.overview_half_angle_deg)};
  focus_in_map_ = FindFocus(map_, options_.min_drawn_views, overview);
}

// Said again and again, so that a listener that came late hears it.
void MapPublisher::BroadcastFrames() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (map_.views().empty()) return;  // On tf, silence means unknown.
  const Rigid3& cam_from_map = map_.views().rbegin()->second.cam_from_map;
  Broadcast(cam_from_map.Inverse(), options_.camera_frame_id);
  if (focus_in_map_) {
    Broadcast({Eigen::Quaterniond::Identity(), *focus_in_map_}, options_.overview_frame_id);
  }
}

void MapPublisher::Broadcast(const Rigid3& map_from_child, const std::string& child_frame_id) {
  geometry_msgs::TransformStamped msg;
  msg.header = HeaderNow(options_.map_frame_id);
  msg.child_frame_id = child_frame_id;
  msg.transform = ToTransformMsg(map_from_child);
  tf_broadcaster_.sendTransform(msg);
}

bool MapPublisher::GetMap(plumbline::GetMap::Request&, plumbline::GetMap::Response& response) {
  MapDelta snapshot;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    snapshot = map_.Snapshot();
  }
  response.snapshot = ToMapDeltaMsg(snapshot, options_.map_frame_id, ros::Time::now());
  return true;
}

}  // namespace plumb::ros_adapter
