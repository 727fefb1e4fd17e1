// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/georeferencer_ros.h"

#include <algorithm>
#include <exception>
#include <iomanip>
#include <sstream>
#include <utility>

#include "plumbline/common/options.h"
#include "ros/absolute_path.h"
#include "ros/camera_conversion.h"
#include "ros/constraints_conversion.h"
#include "ros/georeference_conversion.h"
#include "ros/position_conversion.h"

namespace plumb::ros_adapter {
namespace {

// What came within this time is computed in one go.
constexpr double kTimerPeriod_s = 0.1;

constexpr double kTfPeriod_s = 0.5;

// The mapper wants them for its next background bundle, which photos of many seconds make due.
constexpr double kControlPointsPeriod_s = 2.0;

constexpr double kComplainEvery_s = 60.0;

using plumbline::GeoreferenceFinding;

std::string Describe(const Survey& survey) {
  const auto num_check = std::count_if(survey.targets.begin(),
                                       survey.targets.end(),
                                       [](const auto& target) { return target.is_check; });
  std::ostringstream text;
  text << survey.source << ": " << survey.targets.size() - static_cast<std::size_t>(num_check)
       << " control and " << num_check << " check points, " << survey.crs << ", heights "
       << ToString(survey.heights);
  return text.str();
}

// "by targets: 5 control points, mean 1.0 mm" and the like.
std::string Describe(const plumbline::Georeference& georeference) {
  if (georeference.source == plumbline::Georeference::NONE) return "not placed yet";
  if (georeference.source == plumbline::Georeference::GPS) return "placed by GPS alone: coarse";
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "placed by targets: " << georeference.num_control
       << " control points, mean " << georeference.control_mean_mm << " mm";
  if (georeference.num_check > 0) {
    text << "; " << georeference.num_check << " check points, mean " << georeference.check_mean_mm
         << " mm";
  }
  return text.str();
}

// Every flight begins with too few targets in sight.
bool IsOfTheBeginning(const GeoreferenceFinding& finding) {
  return finding.code == "too_few_targets";
}

void LogFinding(const GeoreferenceFinding& finding) {
  if (finding.severity == GeoreferenceFinding::NOTE || IsOfTheBeginning(finding)) {
    ROS_INFO("%s", finding.text.c_str());
  } else if (finding.severity == GeoreferenceFinding::WARNING) {
    ROS_WARN("%s", finding.text.c_str());
  } else {
    ROS_ERROR("%s", finding.text.c_str());
  }
}

}  // namespace

GeoreferencerRos::GeoreferencerRos(const ros::NodeHandle& handle,
                                   const GeoreferencerRosOptions& options)
    : handle_(handle),
      private_handle_("~"),
      options_(options),
      publisher_(handle, options),
      diagnostics_(handle, private_handle_) {
  if (!options_.survey_file.empty()) {
    survey_trouble_ =
        LoadSurveyFile(options_.survey_file, {options_.survey_crs, options_.survey_heights});
  }
  positions_subscriber_ =
      handle_.subscribe("photo_positions", 1, &GeoreferencerRos::OnPhotoPositions, this);
  load_survey_server_ =
      handle_.advertiseService("load_survey", &GeoreferencerRos::OnLoadSurvey, this);
  diagnostics_.setHardwareID("georeferencer");
  diagnostics_.add("georeference", this, &GeoreferencerRos::Diagnose);
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s),
                                   [this](const auto&) { OnTimer(); });
}

void GeoreferencerRos::OnPhotoPositions(const plumbline::PhotoPositions& msg) {
  const std::optional<PhotoPositions> positions = FromPhotoPositionsMsg(msg);
  if (!positions) {
    ROS_ERROR_THROTTLE(kComplainEvery_s,
                       "message on `photo_positions` dropped: its numbers make no sense");
    return;
  }
  if (positions->camera) {
    if (!camera_) StartWith(*positions->camera);
    if (!IsSameCamera(*positions->camera, *camera_)) {
      ROS_ERROR_THROTTLE(kComplainEvery_s,
                         "message on `photo_positions` dropped: it has another camera than the "
                         "photos before; a session has one");
      return;
    }
  }
  if (!georeferencer_) return;
  for (const auto& [photo, position] : positions->position_of_photo) {
    georeferencer_->SetPosition(photo, position);
  }
  has_news_ = true;
}

void GeoreferencerRos::StartWith(const Camera& camera) {
  camera_ = camera;
  georeferencer_ = std::make_unique<Georeferencer>(options_.georeferencer, camera);
  if (survey_) georeferencer_->SetSurvey(*survey_);
  map_follower_ = std::make_unique<MapFollower>(handle_, [this](const MapDelta& delta) {
    if (!georeferencer_->Apply(delta)) return false;
    has_news_ = true;
    return true;
  });
  detections_follower_ = std::make_unique<DetectionsFollower>(
      handle_, [this](PhotoId photo, std::vector<MarkerDetection> markers) {
        georeferencer_->SetMarkers(photo, std::move(markers));
        has_news_ = true;
      });
}

bool GeoreferencerRos::OnLoadSurvey(plumbline::LoadSurvey::Request& request,
                                    plumbline::LoadSurvey::Response& response) {
  ProblemList problems;
  RequireAbsolute("path", request.path, &problems);
  const std::vector<std::string> problem = problems.Take();
  std::string trouble = problem.empty() ? "" : problem[0];
  if (request.path.empty()) {
    UnloadSurvey();
  } else if (trouble.empty()) {
    trouble = LoadSurveyFile(request.path, {request.crs, request.heights});
  }
  response.success = static_cast<std::uint8_t>(trouble.empty());
  if (!trouble.empty()) {
    response.message = trouble + (survey_ ? "; " + survey_->source + " stays in use" : "");
    ROS_ERROR("%s", response.message.c_str());
    return true;
  }
  response.message = survey_ ? Describe(*survey_) : "no survey";
  // For this node, should it be started again.
  private_handle_.setParam("survey_file", request.path);
  private_handle_.setParam("survey_crs", request.crs);
  private_handle_.setParam("survey_heights", request.heights);
  return true;
}

// Empty if it was loaded; else the file, what is wrong and the cure, and all is as before.
std::string GeoreferencerRos::LoadSurveyFile(const std::string& path,
                                             const SurveyReading& reading) {
  try {
    const Survey survey = ReadSurvey(path, reading);
    const GeoFrame frame = GeoFrame::Around(survey);  // Throws where it cannot be placed.
    if (georeferencer_) {
      const std::optional<Finding> elsewhere = georeferencer_->FindElsewhere(survey, frame);
      if (elsewhere) return elsewhere->text;
      const std::string trouble = TryPlacing(survey);
      if (!trouble.empty()) return trouble;
    }
    survey_ = survey;
  } catch (const std::exception& error) {
    return error.what();
  }
  ROS_INFO("%s", Describe(*survey_).c_str());
  survey_trouble_.clear();
  num_logged_.clear();
  has_news_ = true;
  return {};
}

// Hands the survey on, unless it does not place the map and the one before does: then why not.
std::string GeoreferencerRos::TryPlacing(const Survey& survey) {
  const bool was_placed = survey_ && georeference_.source == plumbline::Georeference::TARGETS;
  georeferencer_->SetSurvey(survey);
  if (!was_placed) return {};
  const Georeference& placed = georeferencer_->Update();
  if (placed.source == GeoreferenceSource::kTargets) return {};
  const auto reason =
      std::find_if(placed.findings.begin(), placed.findings.end(), [](const Finding& finding) {
        return finding.code != "gps_only";
      });
  const std::string text =
      reason != placed.findings.end() ? reason->text : survey.source + ": does not place the map";
  georeferencer_->SetSurvey(*survey_);
  has_news_ = true;
  return text + " (to use it all the same, load an empty path before)";
}

void GeoreferencerRos::UnloadSurvey() {
  survey_.reset();
  survey_trouble_.clear();
  num_logged_.clear();
  if (georeferencer_) georeferencer_->ClearSurvey();
  has_news_ = true;
}

void GeoreferencerRos::OnTimer() {
  if (map_follower_) map_follower_->Poll();
  if (detections_follower_) detections_follower_->Poll();
  if (std::exchange(has_news_, false)) Update();
  if (owes_points_) SendControlPoints();
  const ros::SteadyTime now = ros::SteadyTime::now();
  if ((now - last_tf_).toSec() >= kTfPeriod_s) {
    last_tf_ = now;
    publisher_.BroadcastMap();
  }
  diagnostics_.update();
}

void GeoreferencerRos::Update() {
  std_msgs::Header header;
  header.frame_id = options_.map_frame_id;
  header.stamp = ros::Time::now();
  const Georeference georeference = georeferencer_ ? georeferencer_->Update() : Georeference();
  georeference_ = ToGeoreferenceMsg(georeference, survey_ ? &*survey_ : nullptr, header);
  if (!survey_trouble_.empty()) {
    GeoreferenceFinding finding;
    finding.severity = GeoreferenceFinding::ERROR;
    finding.code = "bad_survey";
    finding.text = survey_trouble_;
    georeference_.findings.insert(georeference_.findings.begin(), finding);
  }
  publisher_.Publish(georeference_);
  owes_points_ = georeferencer_ && options_.sends_control_points;
  Log(georeference_);
}

void GeoreferencerRos::SendControlPoints() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if ((now - last_points_).toSec() < kControlPointsPeriod_s) return;
  last_points_ = now;
  owes_points_ = false;
  publisher_.Publish(ToControlPointsMsg(
      georeferencer_->Constraints(), georeference_.map_sequence, georeference_.header));
}

// What was found is said once, not at every photo, nor whenever it comes and goes.
void GeoreferencerRos::Log(const plumbline::Georeference& georeference) {
  std::map<std::string, int> num_findings;
  for (const GeoreferenceFinding& finding : georeference.findings) ++num_findings[finding.code];
  for (const GeoreferenceFinding& finding : georeference.findings) {
    if (num_findings[finding.code] > num_logged_[finding.code]) LogFinding(finding);
  }
  for (const auto& [code, number] : num_findings) {
    num_logged_[code] = std::max(num_logged_[code], number);
  }
  std::ostringstream state;
  state << georeference.source << georeference.num_control << '/' << georeference.num_check;
  if (state.str() == logged_state_) return;
  logged_state_ = state.str();
  ROS_INFO("%s", Describe(georeference).c_str());
}

void GeoreferencerRos::Diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, camera_ ? Describe(georeference_) : "no photo yet");
  for (const GeoreferenceFinding& finding : georeference_.findings) {
    if (finding.severity == GeoreferenceFinding::NOTE || IsOfTheBeginning(finding)) continue;
    const bool is_error = finding.severity == GeoreferenceFinding::ERROR;
    status.mergeSummary(is_error ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN, finding.text);
  }
  status.add("survey", georeference_.survey);
  status.add("source", georeference_.source);
  status.add("metres a map unit", georeference_.metres_per_map_unit);
  status.add("control points", georeference_.num_control);
  status.add("control points mean [mm]", georeference_.control_mean_mm);
  status.add("check points", georeference_.num_check);
  status.add("check points mean [mm]", georeference_.check_mean_mm);
}

}  // namespace plumb::ros_adapter
