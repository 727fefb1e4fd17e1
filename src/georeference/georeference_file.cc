// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/georeference_file.h"

#include <stdexcept>

#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMmPerM = 1000.0;

Json ToJson(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json ToJson(const Similarity3& similarity) {
  const Eigen::Quaterniond& q = similarity.rotation;
  return {{"scale", similarity.scale},
          {"rotation_wxyz", {q.w(), q.x(), q.y(), q.z()}},
          {"translation_m", ToJson(similarity.translation)}};
}

Json ToJson(const GeoFrame& frame) {
  const auto wgs84 = frame.ToWgs84(Eigen::Vector3d::Zero());
  Json origin = nullptr;
  if (wgs84) {
    origin = {{"lat_deg", wgs84->lat_deg},
              {"lon_deg", wgs84->lon_deg},
              {"alt_ellipsoid_m", *wgs84->alt_m}};
  }
  return {{"crs", frame.crs()},
          {"heights", ToString(frame.heights())},
          {"origin_in_crs", ToJson(frame.origin_in_crs())},
          {"origin_wgs84", origin}};
}

Json ToJson(const ResidualSummary& summary) {
  if (summary.count == 0) return nullptr;  // 0 mm would say that they fit.
  return {{"count", summary.count},
          {"mean_mm", summary.mean_mm},
          {"median_mm", summary.median_mm},
          {"max_mm", summary.max_mm},
          {"rms_mm", summary.rms_mm}};
}

Json ToJson(const TargetReport& target) {
  const bool is_placed =
      target.state != TargetState::kUnseen && target.state != TargetState::kDouble;
  const bool is_compared =
      target.state == TargetState::kGood || target.state == TargetState::kWrong;
  Json json = {{"id", target.id},
               {"name", target.name},
               {"role", target.is_check ? "check" : "control"},
               {"state", ToString(target.state)},
               {"photos", target.num_photos},
               {"photos_used", target.num_used},
               {"rms_error_px", target.rms_error_px},
               {"point_in_map", is_placed ? ToJson(target.point_in_map) : Json(nullptr)}};
  json["residual_mm"] = is_compared ? ToJson(kMmPerM * target.residual_m) : Json(nullptr);
  json["error_mm"] = is_compared ? Json(kMmPerM * target.residual_m.norm()) : Json(nullptr);
  json["sigma_mm"] = is_compared ? Json(kMmPerM * target.sigma_m) : Json(nullptr);
  return json;
}

Json ToJson(const GpsComparison& gps) {
  const auto& ratio = gps.scale_ratio;
  return {{"photos", gps.num_photos},
          {"scale_ratio", ratio ? Json(*ratio) : Json(nullptr)},
          {"scale_ratio_sigma", ratio ? Json(gps.scale_ratio_sigma) : Json(nullptr)},
          {"offset_m", gps.offset_m ? ToJson(*gps.offset_m) : Json(nullptr)}};
}

Eigen::Vector3d ReadVector(const Json& json) {
  if (json.size() != 3) throw std::invalid_argument("a vector has not three numbers");
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Similarity3 ReadSimilarity(const Json& json) {
  const Json& q = json.at("rotation_wxyz");
  const Eigen::Quaterniond rotation(
      q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(), q.at(3).get<double>());
  const double scale = json.at("scale").get<double>();
  if (!(scale > 0.0) || std::abs(rotation.norm() - 1.0) > 1e-6) {
    throw std::invalid_argument("enu_from_map is no similarity");
  }
  return {scale, rotation, ReadVector(json.at("translation_m"))};
}

StoredGeoreference Read(const Json& json) {
  const Json& frame = json.at("frame");
  return {json.at("coarse").get<bool>(),
          json.at("map_sequence").get<std::uint32_t>(),
          json.value("refined", false),
          ReadSimilarity(json.at("enu_from_map")),
          GeoFrame(frame.at("crs").get<std::string>(),
                   HeightReferenceFromString(frame.at("heights").get<std::string>()),
                   ReadVector(frame.at("origin_in_crs")))};
}

}  // namespace

Json ToJson(const Georeference& georeference) {
  const bool is_placed = georeference.source != GeoreferenceSource::kNone;
  const auto& earth = georeference.earth_from_map;
  const auto& diameter = georeference.marker_diameter_m;
  Json targets = Json::array();
  for (const TargetReport& target : georeference.targets) targets.push_back(ToJson(target));
  Json findings = Json::array();
  for (const Finding& finding : georeference.findings) {
    findings.push_back(
        {{"severity", ToString(finding.severity)}, {"code", finding.code}, {"text", finding.text}});
  }
  return {{"source", ToString(georeference.source)},
          {"coarse", georeference.source != GeoreferenceSource::kTargets},
          {"map_sequence", georeference.map_sequence},
          {"enu_from_map", is_placed ? ToJson(georeference.enu_from_map) : Json(nullptr)},
          {"earth_from_map", earth ? ToJson(*earth) : Json(nullptr)},
          {"frame", georeference.frame ? ToJson(*georeference.frame) : Json(nullptr)},
          {"control", ToJson(georeference.control)},
          {"check", ToJson(georeference.check)},
          {"bend_sigma_mm", kMmPerM * georeference.bend_sigma_m},
          {"targets", targets},
          {"marker_diameter_m", diameter ? Json(*diameter) : Json(nullptr)},
          {"gps", georeference.gps ? ToJson(*georeference.gps) : Json(nullptr)},
          {"findings", findings}};
}

StoredGeoreference ReadGeoreference(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  try {
    return Read(Json::parse(bytes.begin(), bytes.end()));
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": is no georeference: " + error.what() +
                             "; run plumbline georeference again, or remove it");
  }
}

}  // namespace plumb
