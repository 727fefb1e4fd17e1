// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <plumbline/LoadSurvey.h>
#include <plumbline/PhotoPositions.h>
#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "plumbline/georeference/georeferencer.h"
#include "ros/detections_follower.h"
#include "ros/georeference_publisher.h"
#include "ros/georeferencer_ros_options.h"
#include "ros/map_follower.h"

namespace plumb::ros_adapter {

// Follows the map, the markers and the photos' positions, and says where on earth the map is. The
// survey comes by parameter or by the service load_survey; a bad one stops nothing. The camera is
// that of the photos. Call from one thread.
class GeoreferencerRos {
 public:
  GeoreferencerRos(const ros::NodeHandle& handle, const GeoreferencerRosOptions& options);

 private:
  void OnPhotoPositions(const plumbline::PhotoPositions& msg);
  void StartWith(const Camera& camera);
  bool OnLoadSurvey(plumbline::LoadSurvey::Request& request,
                    plumbline::LoadSurvey::Response& response);
  std::string LoadSurveyFile(const std::string& path, const SurveyReading& reading);
  std::string TryPlacing(const Survey& survey);
  void UnloadSurvey();
  void OnTimer();
  void Update();
  void SendControlPoints();
  void Log(const plumbline::Georeference& georeference);
  void Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  GeoreferencerRosOptions options_;
  GeoreferencePublisher publisher_;
  std::optional<Survey> survey_;
  std::string survey_trouble_;  // Why there is none though one was named.

  // Of the camera; none while that is not known.
  std::optional<Camera> camera_;
  std::unique_ptr<Georeferencer> georeferencer_;
  std::unique_ptr<MapFollower> map_follower_;
  std::unique_ptr<DetectionsFollower> detections_follower_;

  bool has_news_ = true;      // Since the last update.
  bool owes_points_ = false;  // The control points have changed since they were sent.
  ros::SteadyTime last_points_;
  ros::SteadyTime last_tf_;
  plumbline::Georeference georeference_;
  std::map<std::string, int> num_logged_;  // Findings by code, at most at once, with this survey.
  std::string logged_state_;

  ros::Subscriber positions_subscriber_;
  ros::ServiceServer load_survey_server_;
  ros::WallTimer timer_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace plumb::ros_adapter
