// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <plumbline/ControlPoints.h>
#include <plumbline/Georeference.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <optional>

#include "ros/georeferencer_ros_options.h"

namespace plumb::ros_adapter {

// Tells the outside where the map is: latched `georeference`, `metres_per_map_unit`, `targets` for
// the eye and `control_points` for the mapper, each only when it has changed, and tf. Call from one
// thread.
class GeoreferencePublisher {
 public:
  GeoreferencePublisher(const ros::NodeHandle& handle, const GeoreferencerRosOptions& options);

  void Publish(const plumbline::Georeference& georeference);
  void Publish(const plumbline::ControlPoints& points);

  // The rigid part of enu_from_map, and earth_from_enu if there is one, said again and again so
  // that a listener that came late hears it; nothing while the map has no place: on tf, silence
  // means unknown. Nothing of it is static: another survey may be on no earth, and tf_static takes
  // nothing back.
  void BroadcastMap();

 private:
  geometry_msgs::TransformStamped Transform(
      const std::string& parent,
      const std::string& child,
      const geometry_msgs::Transform& parent_from_child) const;

  GeoreferencerRosOptions options_;
  ros::Publisher georeference_publisher_;
  ros::Publisher scale_publisher_;
  ros::Publisher targets_publisher_;
  ros::Publisher points_publisher_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;

  std::optional<plumbline::Georeference> published_;
  std::optional<plumbline::ControlPoints> published_points_;
  visualization_msgs::MarkerArray published_targets_;
};

}  // namespace plumb::ros_adapter
