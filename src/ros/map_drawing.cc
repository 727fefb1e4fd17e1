// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/map_drawing.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "ros/geometry_conversion.h"

namespace plumb::ros_adapter {
namespace {

// Depth of a frustum, in distances between neighbouring cameras: neighbours do not overlap.
constexpr double kFrustumDepth = 0.4;

std_msgs::ColorRGBA Color(float red, float green, float blue, float alpha) {
  std_msgs::ColorRGBA color;
  color.r = red;
  color.g = green;
  color.b = blue;
  color.a = alpha;
  return color;
}

std::vector<Rigid3> MapFromCams(const MapReplica& map) {
  std::vector<Rigid3> map_from_cams;
  for (const auto& [photo, view] : map.views()) {
    map_from_cams.push_back(view.cam_from_map.Inverse());
  }
  return map_from_cams;
}

// Median distance from a camera to its nearest neighbour; 1 with fewer than two.
double CameraSpacing(const std::vector<Rigid3>& map_from_cams) {
  if (map_from_cams.size() < 2) return 1.0;
  std::vector<double> nearest(map_from_cams.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < map_from_cams.size(); ++i) {
    for (std::size_t j = 0; j < map_from_cams.size(); ++j) {
      if (i == j) continue;
      const double distance = (map_from_cams[i].translation - map_from_cams[j].translation).norm();
      nearest[i] = std::min(nearest[i], distance);
    }
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

// The corners of the image at depth 1, in the camera frame, without distortion.
std::array<Eigen::Vector3d, 4> CornerRays(const Camera& camera) {
  const LensParameters<double>& lens = camera.lens();
  const double left = (-0.5 - lens[kCx]) / lens[kFx];
  const double right = (camera.width_px() - 0.5 - lens[kCx]) / lens[kFx];
  const double top = (-0.5 - lens[kCy]) / lens[kFy];
  const double bottom = (camera.height_px() - 0.5 - lens[kCy]) / lens[kFy];
  return {{{left, top, 1.0}, {right, top, 1.0}, {right, bottom, 1.0}, {left, bottom, 1.0}}};
}

void AppendFrustum(const Rigid3& map_from_cam,
                   const std::array<Eigen::Vector3d, 4>& corner_rays,
                   double depth,
                   std::vector<geometry_msgs::Point>* points) {
  const geometry_msgs::Point center = ToPointMsg(map_from_cam.translation);
  std::array<geometry_msgs::Point, 4> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = ToPointMsg(map_from_cam * (depth * corner_rays[i]));
  for (std::size_t i = 0; i < 4; ++i) {
    points->insert(points->end(), {center, corners[i], corners[i], corners[(i + 1) % 4]});
  }
}

visualization_msgs::Marker LineList(const std_msgs::Header& header,
                                    const char* name,
                                    double width,
                                    const std_msgs::ColorRGBA& color) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = width;
  marker.color = color;
  return marker;
}

std::vector<const LandmarkState*> DrawnLandmarks(const MapReplica& map, int min_views) {
  std::vector<const LandmarkState*> landmarks;
  for (const auto& [id, landmark] : map.landmarks()) {
    if (static_cast<int>(landmark.pixel_of_feature.size()) >= min_views) {
      landmarks.push_back(&landmark.state);
    }
  }
  return landmarks;
}

// The box of the points between the 3rd and the 97th percentile of each coordinate.
Eigen::AlignedBox3d InnerBox(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  std::vector<double> values(points.size());
  const std::size_t rank = points.size() * 3 / 100;
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [&](const Eigen::Vector3d& point) {
      return point[axis];
    });
    std::sort(values.begin(), values.end());
    box.min()[axis] = values[rank];
    box.max()[axis] = values[values.size() - 1 - rank];
  }
  return box;
}

}  // namespace

sensor_msgs::PointCloud2 DrawPoints(const MapReplica& map,
                                    int min_views,
                                    const std_msgs::Header& header) {
  const std::vector<const LandmarkState*> landmarks = DrawnLandmarks(map, min_views);
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.height = 1;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(2, "xyz", "rgb");
  modifier.resize(landmarks.size());
  sensor_msgs::PointCloud2Iterator<float> position(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> color(cloud, "rgb");  // Stored b, g, r.
  for (const LandmarkState* landmark : landmarks) {
    for (int i = 0; i < 3; ++i) position[i] = static_cast<float>(landmark->position_in_map[i]);
    for (int i = 0; i < 3; ++i) color[i] = landmark->color[static_cast<std::size_t>(2 - i)];
    ++position;
    ++color;
  }
  return cloud;
}

visualization_msgs::MarkerArray DrawFrusta(const MapReplica& map,
                                           const Camera& camera,
                                           const std_msgs::Header& header) {
  const std::vector<Rigid3> map_from_cams = MapFromCams(map);
  const double depth = kFrustumDepth * CameraSpacing(map_from_cams);
  const auto rays = CornerRays(camera);
  auto others = LineList(header, "cameras", 0.05 * depth, Color(0.05F, 0.05F, 0.05F, 1.0F));
  auto newest = LineList(header, "newest_camera", 0.12 * depth, Color(1.0F, 0.4F, 0.0F, 1.0F));
  for (std::size_t i = 0; i < map_from_cams.size(); ++i) {
    const bool is_newest = i + 1 == map_from_cams.size();
    AppendFrustum(map_from_cams[i], rays, depth, is_newest ? &newest.points : &others.points);
  }
  visualization_msgs::MarkerArray frusta;
  for (auto* marker : {&others, &newest}) {
    // RViz complains of lists without points.
    if (marker->points.empty()) marker->action = visualization_msgs::Marker::DELETE;
    frusta.markers.push_back(*marker);
  }
  return frusta;
}

nav_msgs::Path DrawPath(const MapReplica& map, const std_msgs::Header& header) {
  nav_msgs::Path path;
  path.header = header;
  for (const Rigid3& map_from_cam : MapFromCams(map)) {
    const geometry_msgs::Transform transform = ToTransformMsg(map_from_cam);
    geometry_msgs::PoseStamped pose;
    pose.header = header;
    pose.pose.position = ToPointMsg(map_from_cam.translation);
    pose.pose.orientation = transform.rotation;
    path.poses.push_back(pose);
  }
  return path;
}

std::optional<Eigen::Vector3d> FindFocus(const MapReplica& map,
                                         int min_views,
                                         const Overview& overview) {
  std::vector<Eigen::Vector3d> points;
  for (const LandmarkState* landmark : DrawnLandmarks(map, min_views)) {
    points.push_back(landmark->position_in_map);
  }
  if (points.empty()) return std::nullopt;
  Eigen::AlignedBox3d box = InnerBox(points);
  points.erase(std::remove_if(points.begin(),
                              points.end(),
                              [&](const Eigen::Vector3d& point) { return !box.contains(point); }),
               points.end());
  for (const Rigid3& map_from_cam : MapFromCams(map)) {
    points.push_back(map_from_cam.translation);
    box.extend(map_from_cam.translation);
  }
  const Eigen::Vector3d middle = box.center();
  const Eigen::Vector3d towards_eye(std::cos(overview.pitch_rad) * std::cos(overview.yaw_rad),
                                    std::cos(overview.pitch_rad) * std::sin(overview.yaw_rad),
                                    std::sin(overview.pitch_rad));
  const Eigen::Vector3d right(-std::sin(overview.yaw_rad), std::cos(overview.yaw_rad), 0.0);
  const Eigen::Vector3d up = towards_eye.cross(right);
  // A point `along` nearer to the eye and `aside` of the line of sight, to a side or upwards, is in
  // view from a distance of at least along + aside / tan(half angle).
  double needed = 0.0;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d offset = point - middle;
    const double along = offset.dot(towards_eye);
    const double aside = std::max(std::abs(offset.dot(right)), std::abs(offset.dot(up)));
    needed = std::max(needed, along + aside / std::tan(overview.half_angle_rad));
  }
  return middle + (needed - overview.distance) * towards_eye;
}

}  // namespace plumb::ros_adapter
