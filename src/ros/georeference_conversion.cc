// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/georeference_conversion.h"

#include <algorithm>
#include <limits>
#include <map>

#include "ros/geometry_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr double kMmPerM = 1000.0;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

template <typename Array>
void ToArray(const Eigen::Vector3d& vector, Array* array) {
  std::copy(vector.data(), vector.data() + 3, array->begin());
}

Eigen::Vector3d UnknownVector() { return Eigen::Vector3d::Constant(kUnknown); }

// Of the surveyed targets by id, in the map; empty while the survey and the map have no frame in
// common: GPS says nothing of where a local survey lies.
std::map<int, Eigen::Vector3d> SurveyInMap(const Georeference& georeference, const Survey* survey) {
  std::map<int, Eigen::Vector3d> points;
  const bool is_placed = survey != nullptr && georeference.frame &&
                         (georeference.source == GeoreferenceSource::kTargets ||
                          georeference.frame->crs() == survey->crs);
  if (!is_placed) return points;
  const Similarity3 map_from_enu = georeference.enu_from_map.Inverse();
  for (const SurveyTarget& target : survey->targets) {
    points[target.id] = map_from_enu * georeference.frame->ToEnu(target.point_in_crs);
  }
  return points;
}

plumbline::TargetResidual ToTargetMsg(const TargetReport& target,
                                      const std::map<int, Eigen::Vector3d>& survey_in_map) {
  const bool is_seen = target.state != TargetState::kUnseen && target.state != TargetState::kDouble;
  const bool is_compared =
      target.state == TargetState::kGood || target.state == TargetState::kWrong;
  const auto surveyed = survey_in_map.find(target.id);
  plumbline::TargetResidual msg;
  msg.id = target.id;
  msg.name = target.name;
  msg.role =
      target.is_check ? plumbline::TargetResidual::CHECK : plumbline::TargetResidual::CONTROL;
  msg.state = ToString(target.state);
  msg.num_photos = static_cast<std::uint32_t>(target.num_photos);
  msg.num_used = static_cast<std::uint32_t>(target.num_used);
  msg.rms_error_px = target.rms_error_px;
  ToArray(is_seen ? target.point_in_map : UnknownVector(), &msg.point_in_map);
  ToArray(surveyed != survey_in_map.end() ? surveyed->second : UnknownVector(), &msg.survey_in_map);
  ToArray(is_compared ? kMmPerM * target.residual_m : UnknownVector(), &msg.residual_mm);
  msg.error_mm = is_compared ? kMmPerM * target.residual_m.norm() : kUnknown;
  msg.sigma_mm = is_compared ? kMmPerM * target.sigma_m : kUnknown;
  return msg;
}

void FillInPlace(const Georeference& georeference, plumbline::Georeference* msg) {
  msg->map_sequence = georeference.map_sequence;
  msg->source = ToString(georeference.source);
  msg->is_coarse = static_cast<std::uint8_t>(georeference.source != GeoreferenceSource::kTargets);
  if (georeference.source == GeoreferenceSource::kNone) return;
  const Similarity3& enu_from_map = georeference.enu_from_map;
  msg->metres_per_map_unit = enu_from_map.scale;
  msg->enu_from_map = ToTransformMsg({enu_from_map.rotation, enu_from_map.translation});
  const GeoFrame& frame = *georeference.frame;
  msg->crs = frame.crs();
  msg->heights = ToString(frame.heights());
  ToArray(frame.origin_in_crs(), &msg->origin_in_crs);
  const std::optional<Rigid3> earth_from_enu = frame.EarthFromEnu();
  msg->is_on_earth = static_cast<std::uint8_t>(earth_from_enu.has_value());
  if (earth_from_enu) msg->earth_from_enu = ToTransformMsg(*earth_from_enu);
}

void FillInSummaries(const Georeference& georeference, plumbline::Georeference* msg) {
  msg->num_control = static_cast<std::uint32_t>(georeference.control.count);
  msg->control_mean_mm = georeference.control.mean_mm;
  msg->control_max_mm = georeference.control.max_mm;
  msg->control_rms_mm = georeference.control.rms_mm;
  msg->num_check = static_cast<std::uint32_t>(georeference.check.count);
  msg->check_mean_mm = georeference.check.mean_mm;
  msg->check_max_mm = georeference.check.max_mm;
  msg->check_rms_mm = georeference.check.rms_mm;
  msg->bend_sigma_mm = kMmPerM * georeference.bend_sigma_m;
}

void FillInGps(const std::optional<GpsComparison>& gps, plumbline::Georeference* msg) {
  msg->num_gps_photos = gps ? static_cast<std::uint32_t>(gps->num_photos) : 0U;
  const bool has_scale = gps && gps->scale_ratio;
  msg->gps_scale_ratio = has_scale ? *gps->scale_ratio : kUnknown;
  msg->gps_scale_ratio_sigma = has_scale ? gps->scale_ratio_sigma : kUnknown;
  ToArray(gps && gps->offset_m ? *gps->offset_m : UnknownVector(), &msg->gps_offset_m);
}

}  // namespace

plumbline::Georeference ToGeoreferenceMsg(const Georeference& georeference,
                                          const Survey* survey,
                                          const std_msgs::Header& header) {
  plumbline::Georeference msg;
  msg.header = header;
  FillInPlace(georeference, &msg);
  if (survey != nullptr) msg.survey = survey->source;
  const std::map<int, Eigen::Vector3d> survey_in_map = SurveyInMap(georeference, survey);
  for (const TargetReport& target : georeference.targets) {
    msg.targets.push_back(ToTargetMsg(target, survey_in_map));
  }
  FillInSummaries(georeference, &msg);
  FillInGps(georeference.gps, &msg);
  for (const Finding& finding : georeference.findings) {
    plumbline::GeoreferenceFinding finding_msg;
    finding_msg.severity = ToString(finding.severity);
    finding_msg.code = finding.code;
    finding_msg.text = finding.text;
    msg.findings.push_back(finding_msg);
  }
  return msg;
}

}  // namespace plumb::ros_adapter
