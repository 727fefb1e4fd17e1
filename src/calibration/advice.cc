// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/advice.h"

#include <array>

#include "calibration/wording.h"

namespace plumb {
namespace {

// With fewer, one bad photo spoils the result without being noticed.
constexpr int kMinGoodPhotos = 6;
constexpr double kFullZoneShare = 0.5;

// Ninths of the image, row by row.
constexpr std::array<const char*, 9> kZones = {"upper left corner",
                                               "upper edge",
                                               "upper right corner",
                                               "left edge",
                                               "middle",
                                               "right edge",
                                               "lower left corner",
                                               "lower edge",
                                               "lower right corner"};

// The ninth whose cells hold fewest centres, a share of those with any; nothing if all are full.
const char* EmptiestZone(const CalibrationCoverage& coverage) {
  std::array<int, 9> num_cells{};
  std::array<int, 9> num_filled{};
  for (int row = 0; row < coverage.num_rows; ++row) {
    for (int col = 0; col < coverage.num_cols; ++col) {
      const auto zone =
          static_cast<std::size_t>(3 * (3 * row / coverage.num_rows) + 3 * col / coverage.num_cols);
      ++num_cells[zone];
      num_filled[zone] += coverage.CentersInCell(col, row) > 0 ? 1 : 0;
    }
  }
  const char* emptiest = nullptr;
  double least = kFullZoneShare;
  for (std::size_t i = 0; i < kZones.size(); ++i) {
    if (num_cells[i] == 0) continue;
    const double share = static_cast<double>(num_filled[i]) / num_cells[i];
    if (share >= least) continue;
    least = share;
    emptiest = kZones[i];
  }
  return emptiest;
}

// The bar that lacks most.
const CoverageBar* EmptiestBar(const std::vector<CoverageBar>& bars) {
  const CoverageBar* emptiest = nullptr;
  for (const CoverageBar& bar : bars) {
    if (bar.count >= bar.wanted) continue;
    if (emptiest == nullptr || bar.wanted - bar.count > emptiest->wanted - emptiest->count) {
      emptiest = &bar;
    }
  }
  return emptiest;
}

}  // namespace

std::string NextPhoto(const CalibrationCoverage& coverage) {
  if (coverage.num_photos == 0) {
    return "Photograph the markers so that they fill the image.";
  }
  if (const char* zone = EmptiestZone(coverage)) {
    return std::string("Take a photo with markers in the image's ") + zone + ".";
  }
  if (const CoverageBar* bar = EmptiestBar(coverage.tilt)) {
    return "Take a photo with the camera tilted by " + bar->label + ".";
  }
  if (const CoverageBar* bar = EmptiestBar(coverage.direction)) {
    return "Take a photo from the side, with the markers " + bar->label + " of the image.";
  }
  if (const CoverageBar* bar = EmptiestBar(coverage.turn)) {
    return bar == &coverage.turn[1]
               ? "Take a photo with the camera turned by a quarter about its axis."
               : "Take a photo with the camera upright.";
  }
  if (const CoverageBar* bar = EmptiestBar(coverage.distance)) {
    return "Take a photo from " +
           std::string(bar == &coverage.distance[0]   ? "nearer"
                       : bar == &coverage.distance[2] ? "farther away"
                                                      : "the usual distance") +
           ".";
  }
  return "";
}

std::pair<CalibrationVerdict, std::string> Advise(const CalibrationOptions& options,
                                                  const CalibrationResult& result) {
  const LensEstimate& estimate = *result.estimate;
  for (const CalibrationFinding& finding : result.findings) {
    if (finding.is_serious) return {CalibrationVerdict::kMorePhotos, finding.text};
  }
  int num_used = 0;
  for (const CalibratedPhoto& photo : result.photos) num_used += photo.is_used ? 1 : 0;
  const bool is_sure = estimate.focal_sigma_percent <= options.max_focal_sigma_percent &&
                       estimate.principal_sigma_px <= options.max_principal_sigma_px &&
                       estimate.distortion_sigma_px <= options.max_distortion_sigma_px;
  const bool is_covered = result.coverage.image_share >= kWantedImageShare;
  if (is_sure && is_covered && num_used >= kMinGoodPhotos) {
    return {CalibrationVerdict::kGood,
            "Good: focal length to " + Number(estimate.focal_sigma_percent, 3) +
                " %, principal point to " + Number(estimate.principal_sigma_px, 2) +
                " px, distortion to " + Number(estimate.distortion_sigma_px, 3) + " px."};
  }
  std::string next = NextPhoto(result.coverage);
  if (next.empty()) {
    next = estimate.principal_sigma_px > options.max_principal_sigma_px
               ? "Take more photos from the side, with the camera turned by a quarter each time."
               : "Take more photos from the side, tilted by 30 to 45 degrees, from near and far.";
  }
  return {CalibrationVerdict::kMorePhotos, next};
}

}  // namespace plumb
