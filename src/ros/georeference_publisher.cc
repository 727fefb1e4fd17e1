// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/georeference_publisher.h"

#include <std_msgs/Float64.h>

#include <utility>

#include "ros/mesh_drawing.h"
#include "ros/target_drawing.h"

namespace plumb::ros_adapter {
namespace {

TargetDrawingOptions DrawingOptions(const GeoreferencerRosOptions& options) {
  TargetDrawingOptions drawing;
  drawing.map_frame_id = options.map_frame_id;
  // 0 says that it is not known.
  if (options.georeferencer.marker_diameter_m > 0.0) {
    drawing.marker_diameter_m = options.georeferencer.marker_diameter_m;
  }
  drawing.magnification = options.residual_magnification;
  return drawing;
}

bool IsPlaced(const plumbline::Georeference& georeference) {
  return georeference.source != plumbline::Georeference::NONE;
}

}  // namespace

GeoreferencePublisher::GeoreferencePublisher(const ros::NodeHandle& handle,
                                             const GeoreferencerRosOptions& options)
    : options_(options) {
  ros::NodeHandle own(handle);
  georeference_publisher_ =
      own.advertise<plumbline::Georeference>("georeference", 1, /*latch=*/true);
  scale_publisher_ = own.advertise<std_msgs::Float64>("metres_per_map_unit", 1, /*latch=*/true);
  targets_publisher_ = own.advertise<visualization_msgs::MarkerArray>("targets", 1, /*latch=*/true);
  points_publisher_ = own.advertise<plumbline::ControlPoints>("control_points", 1, /*latch=*/true);
}

void GeoreferencePublisher::Publish(const plumbline::Georeference& georeference) {
  const double scale = georeference.metres_per_map_unit;
  if (!published_ || published_->metres_per_map_unit != scale) {
    std_msgs::Float64 msg;
    msg.data = scale;
    scale_publisher_.publish(msg);
  }
  georeference_publisher_.publish(georeference);
  published_ = georeference;
  const auto targets = DrawTargets(DrawingOptions(options_), georeference);
  if (targets.markers != published_targets_.markers) {
    published_targets_ = targets;
    visualization_msgs::MarkerArray drawing = targets;
    drawing.markers.insert(drawing.markers.begin(), DeleteAll(georeference.header));
    targets_publisher_.publish(drawing);
  }
  BroadcastMap();
}

void GeoreferencePublisher::Publish(const plumbline::ControlPoints& points) {
  if (published_points_ && published_points_->points == points.points) return;
  published_points_ = points;
  points_publisher_.publish(points);
}

void GeoreferencePublisher::BroadcastMap() {
  if (!published_ || !IsPlaced(*published_)) return;
  tf_broadcaster_.sendTransform(
      Transform(options_.enu_frame_id, options_.map_frame_id, published_->enu_from_map));
  if (published_->is_on_earth == 0) return;
  tf_broadcaster_.sendTransform(
      Transform(options_.earth_frame_id, options_.enu_frame_id, published_->earth_from_enu));
}

geometry_msgs::TransformStamped GeoreferencePublisher::Transform(
    const std::string& parent,
    const std::string& child,
    const geometry_msgs::Transform& parent_from_child) const {
  geometry_msgs::TransformStamped msg;
  msg.header.frame_id = parent;
  msg.header.stamp = ros::Time::now();
  msg.child_frame_id = child;
  msg.transform = parent_from_child;
  return msg;
}

}  // namespace plumb::ros_adapter
