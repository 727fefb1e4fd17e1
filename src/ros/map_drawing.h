// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nav_msgs/Path.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <optional>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map_replica.h"

namespace plumb::ros_adapter {

// The landmarks seen in at least `min_views` photos, with their colours: float32 x, y, z in
// the frame of `header` and rgb, as RViz reads it.
sensor_msgs::PointCloud2 DrawPoints(const MapReplica& map,
                                    int min_views,
                                    const std_msgs::Header& header);

// The pyramid of sight of each located photo, that of the last located one highlighted; their
// depth is a fixed part of the distance between neighbouring cameras, as the map has no scale.
visualization_msgs::MarkerArray DrawFrusta(const MapReplica& map,
                                           const Camera& camera,
                                           const std_msgs::Header& header);

// The camera centres in order of the photos, with the camera's orientation.
nav_msgs::Path DrawPath(const MapReplica& map, const std_msgs::Header& header);

// How a viewer looks at the map: from azimuth `yaw_rad` and height `pitch_rad` (as in RViz's Orbit)
// at a point `distance` away, with a half angle of view to each side, up and down.
struct Overview {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  double distance = 0.0;  // [map units]
  double half_angle_rad = 0.0;
};

// The point in the map to look at so that all cameras and all but the outermost points are in
// view: the middle of them, moved along the line of sight until they fit. Nothing if there are no
// points.
std::optional<Eigen::Vector3d> FindFocus(const MapReplica& map,
                                         int min_views,
                                         const Overview& overview);

}  // namespace plumb::ros_adapter
