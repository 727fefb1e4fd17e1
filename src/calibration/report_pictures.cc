// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibration/svg_canvas.h"
#include "calibration/wording.h"
#include "common/median.h"
#include "plumbline/calibration/calibration_report.h"

namespace plumb {
namespace {

constexpr double kWidth = 640.0;
constexpr double kMargin = 56.0;
constexpr double kSmallText = 11.0;
constexpr double kTitleText = 14.0;
constexpr Color kInk{0.1, 0.3, 0.6};
constexpr Color kWrong{0.85, 0.25, 0.1};
constexpr Color kGrid{0.88, 0.88, 0.88};
constexpr Color kText{0.15, 0.15, 0.15};
constexpr Color kPaper{1.0, 1.0, 1.0};
constexpr Color kNotNeeded{0.75, 0.75, 0.75};  // Of a bar that is not full, where all is good.
constexpr double kManyCenters = 5.0;           // In a cell of the darkest colour.

// 1, 2 or 5 times a power of ten, not above `value`.
double RoundBelow(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= value) return factor * decade;
  }
  return decade;
}

// As few digits as show a tick of RoundBelow.
std::string TickText(double value) {
  const double digits = value > 0.0 ? std::max(0.0, -std::floor(std::log10(value) + 1e-9)) : 0.0;
  return Number(value, static_cast<int>(digits));
}

// The photo's frame in a picture, below a title.
struct PhotoFrame {
  PhotoFrame(int width_px, int height_px)
      : scale((kWidth - 2.0 * kMargin) / std::max(1, width_px)),
        corner(kMargin, kMargin),
        size(scale * width_px, scale * height_px) {}

  Eigen::Vector2d At(const Eigen::Vector2d& pixel) const {
    return corner + scale * (pixel + Eigen::Vector2d::Constant(0.5));
  }

  double scale;
  Eigen::Vector2d corner;
  Eigen::Vector2d size;
};

// Returns the lower end.
double DrawBars(const std::string& title,
                const std::vector<CoverageBar>& bars,
                bool is_good,
                double x,
                double y,
                SvgCanvas* canvas) {
  canvas->Text({x, y}, title, kSmallText + 1.0);
  for (const CoverageBar& bar : bars) {
    y += 18.0;
    const bool is_full = bar.count >= bar.wanted;
    const double unit = 12.0;
    canvas->Text({x, y}, bar.label, kSmallText);
    const double left = x + 150.0;
    const double length = unit * std::min(bar.count, 8);
    const Color color = is_full ? HeatColor(0.75) : is_good ? kNotNeeded : HeatColor(0.4);
    canvas->Rectangle({left, y - 9.0}, {length, 11.0}, color);
    if (bar.wanted > 0) canvas->Frame({left, y - 9.0}, {unit * bar.wanted, 11.0});
    canvas->Text({left + std::max(length, unit * bar.wanted) + 6.0, y},
                 std::to_string(bar.count),
                 kSmallText);
  }
  return y + 26.0;
}

// How many marker centres lie in each cell; pale where only faces reach.
void DrawCells(const CalibrationCoverage& coverage, const PhotoFrame& frame, SvgCanvas* canvas) {
  const Eigen::Vector2d cell(frame.size.x() / coverage.num_cols,
                             frame.size.y() / coverage.num_rows);
  for (int row = 0; row < coverage.num_rows; ++row) {
    for (int col = 0; col < coverage.num_cols; ++col) {
      if (!coverage.IsCellTouched(col, row)) continue;
      const int count = coverage.CentersInCell(col, row);
      const Eigen::Vector2d corner = frame.corner + Eigen::Vector2d(col * cell.x(), row * cell.y());
      const double share = count > 0 ? count / kManyCenters : 0.5 / kManyCenters;
      canvas->Rectangle(corner, cell, HeatColor(share));
      if (count == 0) continue;
      canvas->Text(corner + 0.5 * cell + Eigen::Vector2d(0.0, 4.0),
                   std::to_string(count),
                   kSmallText - 1.0,
                   0,
                   share > 0.75 ? kPaper : kText);
    }
  }
}

}  // namespace

std::string DrawFocalSearch(const CalibrationResult& result) {
  constexpr double kHeight = 400.0;
  SvgCanvas canvas(kWidth, kHeight);
  canvas.Text({kMargin, 28.0}, "Error over the focal length", kTitleText);
  const FocalSearch& search = result.focal_search;
  if (search.error.empty()) {
    canvas.Text({kMargin, 60.0}, "No focal length gives a reconstruction.", kSmallText);
    return canvas.Finish();
  }
  const Eigen::Vector2d corner(kMargin, 44.0);
  const Eigen::Vector2d size(kWidth - 2.0 * kMargin, kHeight - 44.0 - kMargin);
  const double low = std::log(search.focal_px.front());
  const double high = std::max(low + 1e-3, std::log(search.focal_px.back()));
  const double most = 1.08 * *std::max_element(search.error.begin(), search.error.end());
  const auto at = [&](double focal_px, double error) {
    return Eigen::Vector2d(corner.x() + size.x() * (std::log(focal_px) - low) / (high - low),
                           corner.y() + size.y() * (1.0 - error / most));
  };
  const double step = RoundBelow(0.25 * most);
  for (double error = 0.0; error < most; error += step) {
    const Eigen::Vector2d left = at(search.focal_px.front(), error);
    canvas.Line(left, at(search.focal_px.back(), error), kGrid);
    canvas.Text(left - Eigen::Vector2d(6.0, -4.0), TickText(error), kSmallText, 1);
  }
  const double decade = std::pow(10.0, std::floor(std::log10(search.focal_px.front())));
  for (const double focal_px : {decade,
                                2.0 * decade,
                                5.0 * decade,
                                10.0 * decade,
                                20.0 * decade,
                                50.0 * decade,
                                100.0 * decade}) {
    if (focal_px < search.focal_px.front() || focal_px > search.focal_px.back()) continue;
    canvas.Line(at(focal_px, 0.0), at(focal_px, most), kGrid);
    canvas.Text(at(focal_px, 0.0) + Eigen::Vector2d(0.0, 16.0), TickText(focal_px), kSmallText, 0);
  }
  canvas.Frame(corner, size);
  std::vector<Eigen::Vector2d> curve;
  for (std::size_t i = 0; i < search.error.size(); ++i) {
    curve.push_back(at(search.focal_px[i], search.error[i]));
    canvas.Circle(curve.back(), 2.0, kInk, true);
  }
  canvas.Polyline(curve, kInk);
  if (result.estimate) {
    const double focal_px = result.estimate->camera.lens()[kFx];
    if (focal_px > search.focal_px.front() && focal_px < search.focal_px.back()) {
      canvas.Line(at(focal_px, 0.0), at(focal_px, most), kWrong);
      canvas.Text(at(focal_px, 0.96 * most) + Eigen::Vector2d(6.0, 6.0),
                  Number(focal_px, 1) + " px",
                  kSmallText);
    }
  }
  canvas.Text({0.5 * kWidth, kHeight - 16.0}, "focal length [px]", kSmallText, 0);
  canvas.Text({kWidth - kMargin, 28.0}, "robust RMS [standard deviations]", kSmallText, 1);
  return canvas.Finish();
}

std::string DrawResiduals(const CalibrationResult& result) {
  const PhotoFrame frame(result.coverage.width_px, result.coverage.height_px);
  SvgCanvas canvas(kWidth, frame.corner.y() + frame.size.y() + kMargin);
  std::vector<double> lengths;
  for (const CalibrationResidual& residual : result.residuals) {
    if (!residual.is_wrong) lengths.push_back(residual.residual_px.norm());
  }
  canvas.Frame(frame.corner, frame.size);
  if (lengths.empty()) {
    canvas.Text({kMargin, 36.0}, "No residuals", kTitleText);
    return canvas.Finish();
  }
  // The median one is drawn 14 points long.
  const double magnified = 14.0 / std::max(1e-6, MedianOf(lengths));
  canvas.Text({kMargin, 36.0}, "Residuals: seen less projected", kTitleText);
  for (const CalibrationResidual& residual : result.residuals) {
    const Eigen::Vector2d from = frame.At(residual.pixel);
    Eigen::Vector2d along = magnified * residual.residual_px;
    if (along.norm() > 60.0) along *= 60.0 / along.norm();
    const Color& color = residual.is_wrong ? kWrong : kInk;
    canvas.Circle(from, 1.5, color, true);
    canvas.Line(from, from + along, color);
  }
  const double bar_px = RoundBelow(80.0 / magnified);
  const Eigen::Vector2d bar(kMargin, frame.corner.y() + frame.size.y() + 24.0);
  canvas.Line(bar, bar + Eigen::Vector2d(bar_px * magnified, 0.0), kInk, 2.0);
  canvas.Text(bar + Eigen::Vector2d(bar_px * magnified + 8.0, 4.0),
              TickText(bar_px) + " px; orange: does not count, shortened",
              kSmallText);
  return canvas.Finish();
}

std::string DrawCoverage(const CalibrationResult& result) {
  const CalibrationCoverage& coverage = result.coverage;
  const PhotoFrame frame(coverage.width_px, coverage.height_px);
  const double grid_end = frame.corner.y() + frame.size.y();
  const double below = grid_end + 56.0;
  SvgCanvas canvas(kWidth, below + 232.0);
  canvas.Text(
      {kMargin, 36.0},
      "Markers touch " + Number(100.0 * coverage.image_share, 0) + " % of the image's cells",
      kTitleText);
  if (coverage.num_photos > 0) DrawCells(coverage, frame, &canvas);
  canvas.Frame(frame.corner, frame.size);
  canvas.Text({kMargin, grid_end + 20.0},
              "Numbers: marker centres. Pale, without a number: touched by a marker. White: not.",
              kSmallText);
  const bool is_good = result.verdict == CalibrationVerdict::kGood;
  const double right = 0.5 * kWidth + 14.0;
  const std::string rough = coverage.is_tilt_estimated ? "" : " (rough)";
  const double next = DrawBars("Tilt" + rough, coverage.tilt, is_good, kMargin, below, &canvas);
  DrawBars("Turn", coverage.turn, is_good, kMargin, next, &canvas);
  const double next_right =
      DrawBars("Slant" + rough, coverage.direction, is_good, right, below, &canvas);
  const double end = DrawBars("Distance", coverage.distance, is_good, right, next_right, &canvas);
  if (is_good && !IsEveryBarFull(coverage))
    canvas.Text({kMargin, end}, kNotFullButGood, kSmallText);
  return canvas.Finish();
}

std::string DrawMarkers(const CalibrationResult& result) {
  SvgCanvas canvas(kWidth, kWidth);
  const std::string unit = result.is_metric ? "mm" : "marker diameters";
  canvas.Text(
      {kMargin, 36.0}, "Markers from above, heights over the plane [" + unit + "]", kTitleText);
  Eigen::AlignedBox2d box;
  for (const CalibratedMarker& marker : result.markers) {
    if (marker.is_used) box.extend(Eigen::Vector2d(marker.center_in_plane.head<2>()));
  }
  if (!result.left_out.empty()) {
    std::vector<int> ids;
    for (const LeftOutMarker& marker : result.left_out) ids.push_back(marker.id);
    canvas.Text({kMargin, kWidth - 14.0},
                "Not drawn (the report says why): " + NameMarkers(ids),
                kSmallText);
  }
  if (box.isEmpty()) return canvas.Finish();
  const double scale = (kWidth - 3.2 * kMargin) / std::max(1e-9, box.sizes().maxCoeff());
  for (const CalibratedMarker& marker : result.markers) {
    if (!marker.is_used) continue;
    const Eigen::Vector2d off = marker.center_in_plane.head<2>() - box.center();
    const Eigen::Vector2d at(0.5 * kWidth + scale * off.x(), 0.52 * kWidth - scale * off.y());
    const Color color = marker.num_wrong > 0 ? kWrong : kInk;
    canvas.Circle(at, 16.0, color, false);
    const double c = std::cos(marker.angle_rad);
    const double s = std::sin(marker.angle_rad);
    canvas.Line(at, at + 16.0 * Eigen::Vector2d(c, -s), color);
    canvas.Text(at + Eigen::Vector2d(18.0, -6.0), std::to_string(marker.id), kSmallText);
    canvas.Text(at + Eigen::Vector2d(0.0, 30.0),
                result.is_metric ? Number(1000.0 * marker.center_in_plane.z(), 1)
                                 : Number(marker.center_in_plane.z(), 3),
                kSmallText - 2.0,
                0);
  }
  return canvas.Finish();
}

}  // namespace plumb
