// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/calibration/calibration_report.h"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "calibration/wording.h"
#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, kNumLensParameters> kNames = {
    "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};

int NumParameters(const Camera& camera) {
  return camera.model() == DistortionModel::kPlumbBob ? kK3 + 1 : kNumLensParameters;
}

Json ToJson(const std::vector<CoverageBar>& bars) {
  Json list = Json::array();
  for (const CoverageBar& bar : bars) {
    list.push_back({{"label", bar.label}, {"count", bar.count}, {"wanted", bar.wanted}});
  }
  return list;
}

Json ToJson(const CalibrationCoverage& coverage) {
  return {{"image_share", coverage.image_share},
          {"num_cols", coverage.num_cols},
          {"num_rows", coverage.num_rows},
          {"centers_in_cell", coverage.centers_in_cell},
          {"is_cell_touched",
           std::vector<bool>(coverage.is_cell_touched.begin(), coverage.is_cell_touched.end())},
          {"distance_ratio", coverage.distance_ratio},
          {"distance", ToJson(coverage.distance)},
          {"tilt", ToJson(coverage.tilt)},
          {"direction", ToJson(coverage.direction)},
          {"turn", ToJson(coverage.turn)},
          {"is_tilt_estimated", coverage.is_tilt_estimated}};
}

Json ToJson(const LensEstimate& estimate) {
  Json lens = Json::object();
  Json sigma = Json::object();
  for (int i = 0; i < NumParameters(estimate.camera); ++i) {
    const auto idx = static_cast<std::size_t>(i);
    lens[kNames[idx]] = estimate.camera.lens()[idx];
    sigma[kNames[idx]] = estimate.sigma[idx];
  }
  return {{"width_px", estimate.camera.width_px()},
          {"height_px", estimate.camera.height_px()},
          {"lens", lens},
          {"sigma", sigma},
          {"focal_sigma_percent", estimate.focal_sigma_percent},
          {"principal_sigma_px", estimate.principal_sigma_px},
          {"distortion_sigma_px", estimate.distortion_sigma_px}};
}

Json PhotosJson(const CalibrationResult& result) {
  Json list = Json::array();
  for (const CalibratedPhoto& photo : result.photos) {
    Json row = {{"name", photo.name},
                {"is_used", photo.is_used},
                {"num_found", photo.num_found},
                {"num_markers", photo.num_markers},
                {"num_wrong", photo.num_wrong}};
    if (photo.is_used) {
      row["rms_px"] = photo.rms_px;
      row["tilt_deg"] = photo.tilt_deg;
      row["distance"] = photo.distance;
    }
    list.push_back(row);
  }
  return list;
}

Json MarkersJson(const CalibrationResult& result) {
  Json list = Json::array();
  for (const CalibratedMarker& marker : result.markers) {
    Json row = {{"id", marker.id},
                {"is_used", marker.is_used},
                {"num_photos", marker.num_photos},
                {"num_wrong", marker.num_wrong}};
    if (marker.is_used) {
      const Eigen::Vector3d& center = marker.center_in_plane;
      row["center_in_plane"] = {center.x(), center.y(), center.z()};
      row["height_sigma"] = marker.height_sigma;
      row["angle_rad"] = marker.angle_rad;
      row["rms_px"] = marker.rms_px;
    }
    list.push_back(row);
  }
  return list;
}

Json LeftOutJson(const CalibrationResult& result) {
  Json list = Json::array();
  for (const LeftOutMarker& marker : result.left_out) {
    list.push_back({{"id", marker.id}, {"reason", marker.reason}});
  }
  return list;
}

Json ResidualsJson(const CalibrationResult& result) {
  Json list = Json::array();
  for (const CalibrationResidual& residual : result.residuals) {
    list.push_back({{"photo", result.photos[static_cast<std::size_t>(residual.photo_idx)].name},
                    {"marker", result.markers[static_cast<std::size_t>(residual.marker_idx)].id},
                    {"pixel", {residual.pixel.x(), residual.pixel.y()}},
                    {"residual_px", {residual.residual_px.x(), residual.residual_px.y()}},
                    {"sigmas", residual.sigmas},
                    {"is_wrong", residual.is_wrong}});
  }
  return list;
}

void WriteLens(const LensEstimate& estimate, std::ostream* text) {
  *text << "\n## Lens\n| | value | standard deviation |\n|---|---|---|\n";
  for (int i = 0; i < NumParameters(estimate.camera); ++i) {
    const auto idx = static_cast<std::size_t>(i);
    const int digits = i <= kCy ? 2 : 6;
    const double sigma = estimate.sigma[idx];
    *text << "| " << kNames[idx] << (i <= kCy ? " [px]" : "") << " | "
          << Number(estimate.camera.lens()[idx], digits) << " | "
          << (sigma > 0.0 ? Number(sigma, digits) : "held") << " |\n";
  }
  *text << "\nFocal length to " << Number(estimate.focal_sigma_percent, 3)
        << " %, principal point to " << Number(estimate.principal_sigma_px, 2)
        << " px, distortion over the image to " << Number(estimate.distortion_sigma_px, 3)
        << " px (standard deviations).\n";
}

// What would be a picture or a table of Markdown in a name is shown as it stands.
std::string Escaped(const std::string& name) {
  std::string text;
  for (const char letter : name) {
    if (std::string("\\`*_{}[]<>()#|!").find(letter) != std::string::npos) text += '\\';
    text += letter;
  }
  return text;
}

void WritePhotos(const CalibrationResult& result, std::ostream* text) {
  *text << "\n## Photos\n| photo | markers found | left out | RMS px | tilt deg | distance "
        << (result.is_metric ? "m" : "marker diameters") << " |\n|---|---|---|---|---|---|\n";
  for (const CalibratedPhoto& photo : result.photos) {
    *text << "| " << Escaped(photo.name) << " | " << photo.num_found << " | ";
    if (photo.is_used) {
      const int num_counting = photo.num_markers - photo.num_wrong;
      *text << photo.num_found - num_counting << " | " << Number(photo.rms_px, 3) << " | "
            << Number(photo.tilt_deg, 0) << " | " << Number(photo.distance, 2) << " |\n";
    } else {
      *text << "not used | | | |\n";
    }
  }
}

void WriteMarkers(const CalibrationResult& result, std::ostream* text) {
  *text << "\n## Markers\n| ID | photos | left out | RMS px | height |\n|---|---|---|---|---|\n";
  for (const CalibratedMarker& marker : result.markers) {
    *text << "| " << marker.id << " | " << marker.num_photos << " | ";
    if (marker.is_used) {
      *text << marker.num_wrong << " | " << Number(marker.rms_px, 3) << " | "
            << Length(marker.center_in_plane.z(), result.is_metric) << " |\n";
    } else {
      *text << "not used | | |\n";
    }
  }
  if (result.left_out.empty()) return;
  *text << "\nFound but left out altogether:\n";
  for (const LeftOutMarker& marker : result.left_out) {
    *text << "- marker " << marker.id << ": " << Escaped(marker.reason) << '\n';
  }
}

}  // namespace

std::string ToJson(const CalibrationResult& result) {
  Json findings = Json::array();
  for (const CalibrationFinding& finding : result.findings) {
    findings.push_back({{"kind", ToString(finding.kind)},
                        {"is_serious", finding.is_serious},
                        {"text", finding.text},
                        {"marker_ids", finding.marker_ids},
                        {"photos", finding.photos}});
  }
  const Json document = {{"verdict", ToString(result.verdict)},
                         {"advice", result.advice},
                         {"findings", findings},
                         {"estimate", result.estimate ? ToJson(*result.estimate) : Json()},
                         {"rms_px", result.rms_px},
                         {"noise_factor", result.noise_factor},
                         {"is_metric", result.is_metric},
                         {"focal_search",
                          {{"focal_px", result.focal_search.focal_px},
                           {"error", result.focal_search.error},
                           {"best_focal_px", result.focal_search.best_focal_px}}},
                         {"coverage", ToJson(result.coverage)},
                         {"photos", PhotosJson(result)},
                         {"markers", MarkersJson(result)},
                         {"left_out", LeftOutJson(result)},
                         {"residuals", ResidualsJson(result)}};
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string ToMarkdown(const CalibrationResult& result) {
  std::ostringstream text;
  text << "# Camera calibration\n\n**" << Escaped(result.advice) << "**\n";
  if (!result.findings.empty()) text << "\n## What is off\n";
  for (const CalibrationFinding& finding : result.findings) {
    text << "- " << (finding.is_serious ? "**Serious.** " : "") << Escaped(finding.text) << '\n';
  }
  if (result.estimate) {
    WriteLens(*result.estimate, &text);
    text << "\nRMS of the residuals: " << Number(result.rms_px, 3) << " px, "
         << Number(result.noise_factor, 2) << " times what the markers' edges promise.\n";
  }
  text << "\n![Error over the focal length](focal_search.svg)\n\n![Residuals](residuals.svg)\n\n"
          "![Coverage](coverage.svg)\n\n![Markers](markers.svg)\n";
  WritePhotos(result, &text);
  WriteMarkers(result, &text);
  return text.str();
}

void WriteCalibrationReport(const CalibrationResult& result, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder + ": cannot be made a folder: " + error.message() +
                             "; choose another one");
  }
  WriteFileAtomically(folder + "/report.md", ToMarkdown(result));
  WriteFileAtomically(folder + "/report.json", ToJson(result));
  WriteFileAtomically(folder + "/focal_search.svg", DrawFocalSearch(result));
  WriteFileAtomically(folder + "/residuals.svg", DrawResiduals(result));
  WriteFileAtomically(folder + "/coverage.svg", DrawCoverage(result));
  WriteFileAtomically(folder + "/markers.svg", DrawMarkers(result));
  if (!result.estimate) return;
  WriteFileAtomically(folder + "/camera.yaml", ToCameraYaml(result.estimate->camera));
}

}  // namespace plumb
