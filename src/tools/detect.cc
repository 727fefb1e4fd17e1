// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/detect.h"

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/image/gray_photo.h"
#include "plumbline/map/run_report.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

// As RFC 4180 has it.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + '"';
}

Json ToJson(const MarkerDetection& marker) {
  const Eigen::Matrix2d& covariance = marker.center_covariance_px2;
  const Eigen::Matrix3d& h = marker.pixel_from_marker;
  return {{"id", marker.id},
          {"center_px", {marker.center_px.x(), marker.center_px.y()}},
          {"center_covariance_px2",
           {{covariance(0, 0), covariance(0, 1)}, {covariance(1, 0), covariance(1, 1)}}},
          {"ellipse",
           {{"center_px", {marker.ellipse.center_px.x(), marker.ellipse.center_px.y()}},
            {"semi_major_px", marker.ellipse.semi_major_px},
            {"semi_minor_px", marker.ellipse.semi_minor_px},
            {"angle_rad", marker.ellipse.angle_rad}}},
          {"pixel_from_marker",
           {{h(0, 0), h(0, 1), h(0, 2)}, {h(1, 0), h(1, 1), h(1, 2)}, {h(2, 0), h(2, 1), h(2, 2)}}},
          {"probability", marker.probability},
          {"explained", marker.explained},
          {"num_corrected_bits", marker.num_corrected_bits}};
}

Json ToJson(const DetectedPhoto& photo) {
  Json markers = Json::array();
  for (const MarkerDetection& marker : photo.markers) markers.push_back(ToJson(marker));
  return {{"name", photo.name},
          {"problem", photo.problem},
          {"width_px", photo.width_px},
          {"height_px", photo.height_px},
          {"wall_s", photo.wall_s},
          {"decode_cpu_s", photo.decode_cpu_s},
          {"detect_cpu_s", photo.detect_cpu_s},
          {"markers", markers}};
}

}  // namespace

DetectedPhoto DetectInPhoto(const MarkerDetectorOptions& options,
                            const std::optional<Camera>& camera,
                            const std::string& folder,
                            const std::string& name) {
  DetectedPhoto photo;
  photo.name = name;
  const Stopwatch stopwatch;
  const double cpu_at_start_s = CurrentProcessUsage().cpu_s;
  GrayPhoto decoded;
  try {
    decoded = DecodeGrayPhoto(ReadFileBytes(folder + '/' + name), options.num_threads);
  } catch (const std::runtime_error& error) {
    decoded.problem = error.what();
  }
  const double cpu_decoded_s = CurrentProcessUsage().cpu_s;
  photo.decode_cpu_s = cpu_decoded_s - cpu_at_start_s;
  photo.width_px = decoded.gray.cols;
  photo.height_px = decoded.gray.rows;
  photo.problem = decoded.problem;
  if (photo.problem.empty()) {
    try {
      photo.markers = DetectMarkers(options, decoded.gray, camera ? &*camera : nullptr);
    } catch (const std::invalid_argument& error) {
      photo.problem = error.what();
    }
  }
  photo.detect_cpu_s = CurrentProcessUsage().cpu_s - cpu_decoded_s;
  photo.wall_s = stopwatch.Seconds();
  return photo;
}

std::string ToCsv(const std::vector<DetectedPhoto>& photos) {
  std::ostringstream text;
  text << "photo,id,x_px,y_px,variance_xx_px2,variance_xy_px2,variance_yy_px2,ellipse_x_px,"
          "ellipse_y_px,semi_major_px,semi_minor_px,angle_rad,probability,explained,"
          "num_corrected_bits\n"
       << std::setprecision(9);
  for (const DetectedPhoto& photo : photos) {
    for (const MarkerDetection& marker : photo.markers) {
      const Eigen::Matrix2d& covariance = marker.center_covariance_px2;
      const Ellipse& ellipse = marker.ellipse;
      text << Quoted(photo.name) << ',' << marker.id << ',' << marker.center_px.x() << ','
           << marker.center_px.y() << ',' << covariance(0, 0) << ',' << covariance(0, 1) << ','
           << covariance(1, 1) << ',' << ellipse.center_px.x() << ',' << ellipse.center_px.y()
           << ',' << ellipse.semi_major_px << ',' << ellipse.semi_minor_px << ','
           << ellipse.angle_rad << ',' << marker.probability << ',' << marker.explained << ','
           << marker.num_corrected_bits << '\n';
    }
  }
  return text.str();
}

std::string ToJson(const std::vector<DetectedPhoto>& photos) {
  Json list = Json::array();
  for (const DetectedPhoto& photo : photos) list.push_back(ToJson(photo));
  const Json document = {{"photos", list}};
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace plumb::tools
