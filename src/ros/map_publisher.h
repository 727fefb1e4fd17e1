// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/GetMap.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <mutex>
#include <optional>

#include "plumbline/common/stage.h"
#include "plumbline/map/map_replica.h"
#include "ros/annotated_photo.h"
#include "ros/live_mapper.h"
#include "ros/mapper_ros_options.h"

namespace plumb::ros_adapter {

// Tells the outside what the map is: `map_delta`, the service get_map and `session_camera`, the
// camera of all its photos as calibrated; and for the eye `points`,
// `cameras`, `camera_path`, `annotated_photo` and tf. Works in its own threads; the mapper hands
// over and goes on. Thread-safe.
class MapPublisher {
 public:
  MapPublisher(const ros::NodeHandle& handle,
               const MapperRosOptions& options,
               const Camera& camera);
  ~MapPublisher();

  void OnMapDelta(const MapDelta& delta);

  // Offers get_map from now on, with the deltas handed over so far: who asks while a stored map is
  // still being read would take it for an empty one.
  void ServeMap();

  // `bytes` is the photo; the picture of the newest one is drawn.
  void OnVerdict(const PhotoVerdict& verdict, const PhotoBytes& bytes, const PhotoCounts& counts);

 private:
  struct Annotation {
    PhotoVerdict verdict;
    PhotoBytes bytes;
    PhotoCounts counts;
  };
  struct Wake {};

  void PublishDelta(const MapDelta& delta);
  void AdvertiseMap();
  void Draw();
  void DrawAnnotation(const Annotation& annotation);
  void DrawMap();
  void BroadcastFrames();
  void Broadcast(const Rigid3& map_from_child, const std::string& child_frame_id);
  bool GetMap(plumbline::GetMap::Request& request, plumbline::GetMap::Response& response);

  MapperRosOptions options_;
  Camera camera_;
  ros::Publisher delta_publisher_;
  ros::Publisher camera_publisher_;
  ros::Publisher points_publisher_;
  ros::Publisher cameras_publisher_;
  ros::Publisher path_publisher_;
  ros::Publisher annotated_publisher_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;

  std::mutex mutex_;  // Of what follows.
  MapReplica map_;
  bool is_drawn_ = true;  // The drawing shows map_.
  ros::SteadyTime last_drawn_;
  std::optional<Eigen::Vector3d> focus_in_map_;
  std::optional<Annotation> annotation_;

  ros::NodeHandle service_handle_;
  ros::CallbackQueue service_queue_;
  ros::ServiceServer get_map_server_;
  ros::AsyncSpinner service_spinner_;
  ros::WallTimer draw_timer_;
  ros::WallTimer tf_timer_;

  Stage<Wake> drawing_;
  Stage<std::optional<MapDelta>> publishing_;  // Nothing: AdvertiseMap.
};

}  // namespace plumb::ros_adapter
