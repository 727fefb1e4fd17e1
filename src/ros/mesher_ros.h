// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <plumbline/GetMesh.h>
#include <plumbline/MapDelta.h>
#include <plumbline/MeshDelta.h>
#include <plumbline/PhotoVerdict.h>
#include <plumbline/SetMeshDisplay.h>
#include <plumbline/StoredPhotos.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Float64.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "plumbline/common/stage.h"
#include "plumbline/quality/quality_map.h"
#include "plumbline/surface/surface_mesher.h"
#include "ros/latency.h"
#include "ros/mesh_publisher.h"
#include "ros/mesher_ros_options.h"

namespace plumb::ros_adapter {

// Makes the surface and its quality from the map's deltas and publishes what changed: `mesh_delta`,
// `gaps`, the service get_mesh, and what MeshPublisher shows. Catches up by get_map when it starts
// late or misses a delta. What goes wrong is said, and the mesh begun anew from the map.
class MesherRos {
 public:
  MesherRos(const ros::NodeHandle& handle, const MesherRosOptions& options);
  ~MesherRos();

 private:
  using Work = std::function<void()>;

  void OnMapDelta(const plumbline::MapDelta& msg);
  void OnStoredPhotos(const plumbline::StoredPhotos& msg);
  void OnCamera(const sensor_msgs::CameraInfo& msg);
  void OnScale(const std_msgs::Float64& msg);
  void OnVerdict(const plumbline::PhotoVerdict& msg);
  void OnTimer();
  bool OnGetMesh(plumbline::GetMesh::Request& request, plumbline::GetMesh::Response& response);
  bool OnSetDisplay(plumbline::SetMeshDisplay::Request& request,
                    plumbline::SetMeshDisplay::Response& response);

  // These run in the worker's thread, with the mutex held.
  void Do(const Work& work);
  void Apply(const MapDelta& delta, const ros::Time& stamp);
  bool TryApply(const MapDelta& delta, const ros::Time& stamp);
  void CatchUp();
  void BeginAnew();
  void Publish(const QualityUpdate& update, bool is_snapshot);
  void Repaint();
  void TellNow();
  plumbline::MeshDelta MakeMessage(const std::vector<BlockId>& blocks, bool is_snapshot) const;
  Measure MakeMeasure() const;
  std::optional<Rigid3> NewestView() const;

  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_;
  MesherRosOptions options_;
  ros::Publisher delta_publisher_;
  ros::Publisher gaps_publisher_;
  ros::ServiceClient get_map_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  diagnostic_updater::Updater diagnostics_;

  std::mutex mutex_;  // Of what follows.
  MeshPublisher publisher_;
  MeshLook look_;
  std::optional<double> metres_per_map_unit_;
  std::unique_ptr<SurfaceMesher> surface_;
  std::unique_ptr<QualityMap> quality_;
  std::optional<Camera> camera_;
  std::map<PhotoId, RefusedPhoto> refused_;
  std::uint32_t sequence_ = 0;
  ros::Time mapper_started_;
  bool has_map_ = false;  // That of the mapper as it runs now.
  bool is_told_ = false;  // Gaps and refused photos show what there is.
  std::size_t num_gaps_ = 0;
  std::optional<Gap> first_gap_;  // As last told.
  Latency surface_time_;
  Latency quality_time_;
  Latency delay_;
  std::string trouble_;

  ros::CallbackQueue service_queue_;
  std::vector<ros::ServiceServer> servers_;
  ros::AsyncSpinner service_spinner_;
  Stage<Work> worker_;
};

}  // namespace plumb::ros_adapter
