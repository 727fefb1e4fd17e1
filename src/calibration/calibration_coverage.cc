// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/calibration/calibration_coverage.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "calibration/photo_size.h"
#include "calibration/view_slant.h"
#include "common/median.h"

namespace plumb {
namespace {

constexpr int kNumCols = 12;
constexpr double kNearFactor = 1.15;  // Nearer or farther than the usual distance by this.

double DiameterOf(const CalibrationPhoto& photo) {
  std::vector<double> diameters;
  for (const MarkerDetection& marker : photo.markers) {
    diameters.push_back(2.0 * marker.ellipse.semi_major_px);
  }
  return MedianOf(diameters);
}

// Direction of a marker's x axis in the image.
double AngleOf(const MarkerDetection& marker) {
  return std::atan2(marker.pixel_from_marker(1, 0), marker.pixel_from_marker(0, 0));
}

// Whether markers seen before are turned by about a quarter; nothing if none was seen before.
std::optional<bool> IsTurned(const CalibrationPhoto& photo, const std::map<int, double>& angles) {
  double sine = 0.0;
  double cosine = 0.0;
  for (const MarkerDetection& marker : photo.markers) {
    const auto before = angles.find(marker.id);
    if (before == angles.end()) continue;
    sine += std::sin(AngleOf(marker) - before->second);
    cosine += std::cos(AngleOf(marker) - before->second);
  }
  if (sine == 0.0 && cosine == 0.0) return std::nullopt;
  return std::abs(sine) > std::abs(cosine);
}

class Measurer {
 public:
  explicit Measurer(const std::vector<CalibrationPhoto>& photos) {
    const auto [width_px, height_px] = UsualSize(photos);
    coverage_.width_px = width_px;
    coverage_.height_px = height_px;
    coverage_.num_cols = kNumCols;
    coverage_.num_rows =
        width_px > 0 ? std::clamp(static_cast<int>(std::lround(
                                      kNumCols * static_cast<double>(height_px) / width_px)),
                                  1,
                                  4 * kNumCols)
                     : kNumCols;
    const auto num_cells = static_cast<std::size_t>(coverage_.num_cols * coverage_.num_rows);
    coverage_.centers_in_cell.assign(num_cells, 0);
    coverage_.is_cell_touched.assign(num_cells, 0);
    coverage_.distance = {{"nearer", 0, 2}, {"usual distance", 0, 2}, {"farther", 0, 2}};
    coverage_.turn = {{"upright or upside down", 0, 3}, {"turned by a quarter", 0, 2}};
    for (const CalibrationPhoto& photo : photos) {
      const bool is_usual = photo.width_px == width_px && photo.height_px == height_px;
      if (is_usual && !photo.markers.empty()) Add(photo);
    }
    Finish();
  }

  const CalibrationCoverage& coverage() const { return coverage_; }

 private:
  void Add(const CalibrationPhoto& photo) {
    ++coverage_.num_photos;
    for (const MarkerDetection& marker : photo.markers) AddToCells(marker);
    diameters_.push_back(DiameterOf(photo));
    slants_.push_back(GuessSlant(photo));
    const bool is_turned = IsTurned(photo, angles_).value_or(false);
    ++coverage_.turn[is_turned ? 1 : 0].count;
    for (const MarkerDetection& marker : photo.markers) {
      // As the first photo would have shown it.
      angles_.emplace(marker.id, AngleOf(marker) - (is_turned ? 0.5 * M_PI : 0.0));
    }
  }

  void AddToCells(const MarkerDetection& marker) {
    const Eigen::Vector2d cell_px(static_cast<double>(coverage_.width_px) / coverage_.num_cols,
                                  static_cast<double>(coverage_.height_px) / coverage_.num_rows);
    const Eigen::Matrix2d circle_from_pixel = marker.ellipse.PixelFromCircle().inverse();
    for (int row = 0; row < coverage_.num_rows; ++row) {
      for (int col = 0; col < coverage_.num_cols; ++col) {
        const Eigen::Vector2d low(col * cell_px.x() - 0.5, row * cell_px.y() - 0.5);
        const Eigen::Vector2d high = low + cell_px;
        const Eigen::Vector2d& center = marker.center_px;
        const Eigen::Vector2d nearest = center.cwiseMax(low).cwiseMin(high);
        const auto cell = static_cast<std::size_t>(row * coverage_.num_cols + col);
        if (nearest == center) ++coverage_.centers_in_cell[cell];
        if ((circle_from_pixel * (nearest - center)).squaredNorm() <= 1.0) {
          coverage_.is_cell_touched[cell] = 1;
        }
      }
    }
  }

  void Finish() {
    const std::vector<char>& is_touched = coverage_.is_cell_touched;
    coverage_.image_share =
        static_cast<double>(std::count(is_touched.begin(), is_touched.end(), 1)) /
        static_cast<double>(is_touched.size());
    CountSlants(slants_, &coverage_);
    if (diameters_.empty()) return;
    const double usual_px = MedianOf(diameters_);
    for (const double diameter_px : diameters_) {
      const bool is_near = diameter_px > kNearFactor * usual_px;
      const bool is_far = diameter_px < usual_px / kNearFactor;
      ++coverage_.distance[is_near ? 0 : is_far ? 2 : 1].count;
    }
    const auto [smallest, largest] = std::minmax_element(diameters_.begin(), diameters_.end());
    coverage_.distance_ratio = *largest / *smallest;
  }

  CalibrationCoverage coverage_;
  std::vector<double> diameters_;  // Of each photo, in pixels.
  std::vector<ViewSlant> slants_;  // Likewise.
  std::map<int, double> angles_;   // Of the markers seen so far.
};

}  // namespace

bool IsEveryBarFull(const CalibrationCoverage& coverage) {
  for (const auto* bars :
       {&coverage.distance, &coverage.tilt, &coverage.direction, &coverage.turn}) {
    for (const CoverageBar& bar : *bars) {
      if (bar.count < bar.wanted) return false;
    }
  }
  return true;
}

CalibrationCoverage MeasureCoverage(const std::vector<CalibrationPhoto>& photos) {
  return Measurer(photos).coverage();
}

}  // namespace plumb
