// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"
#include "plumbline/marker/marker_sheet.h"

namespace plumb {
namespace {

constexpr double kMarginMm = 12.0;  // Which no office printer leaves out.
constexpr double kCellStepMm = 5.0;
// Of a cell; beside the quiet zone (0.9 of it) there is room for the cut and the number.
constexpr double kDiameterPerCell = 0.72;
constexpr double kTargetFooterMm = 14.0;
constexpr double kMinTargetMm = 10.0;
constexpr double kMaxTargetMm = 5000.0;

void CheckIds(int first, int count) {
  const int size = MarkerCodebook::Get().size();
  if (first >= 0 && first + count <= size) return;
  const std::string ids = "marker IDs are 0 to " + std::to_string(size - 1);
  if (count == 1) throw std::invalid_argument(ids + ", there is no " + std::to_string(first));
  throw std::invalid_argument(ids + ": " + std::to_string(count) + " of them cannot begin at " +
                              std::to_string(first) + "; the last beginning is " +
                              std::to_string(size - count));
}

std::string Millimetres(double length_mm) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g mm", length_mm);
  return text;
}

// The longest of 10, 20, 50, 100, … that fits.
double ScaleBar(double width_mm) {
  double best_mm = 5.0;
  for (double decade_mm = 10.0; decade_mm <= 1000.0; decade_mm *= 10.0) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor * decade_mm <= width_mm) best_mm = factor * decade_mm;
    }
  }
  return best_mm;
}

}  // namespace

MarkerSheet LayOutGrid(Paper paper, Arrangement arrangement, int first_id) {
  const int num_markers = kGridSide * kGridSide;
  CheckIds(first_id, num_markers);
  const int per_side = arrangement == Arrangement::kFixed ? kGridSide : kGridSide / 2;
  MarkerSheet sheet;
  sheet.page_mm =
      paper == Paper::kA4 ? Eigen::Vector2d(210.0, 297.0) : Eigen::Vector2d(297.0, 420.0);
  sheet.cell_mm =
      kCellStepMm * std::floor((sheet.page_mm.x() - 2.0 * kMarginMm) / (per_side * kCellStepMm));
  sheet.diameter_mm = std::floor(kDiameterPerCell * sheet.cell_mm);
  sheet.has_cut_lines = arrangement == Arrangement::kLoose;
  sheet.num_pages = num_markers / (per_side * per_side);
  const Eigen::Vector2d first_center =
      0.5 * (sheet.page_mm - Eigen::Vector2d::Constant((per_side - 1) * sheet.cell_mm));
  for (int i = 0; i < num_markers; ++i) {
    const int on_page = i % (per_side * per_side);
    const Eigen::Vector2d cell(on_page % per_side, on_page / per_side);
    sheet.markers.push_back(
        {first_id + i, i / (per_side * per_side), first_center + sheet.cell_mm * cell});
  }
  sheet.title = "Plumbline calibration markers " + std::to_string(first_id) + " to " +
                std::to_string(first_id + num_markers - 1) + ": diameter " +
                Millimetres(sheet.diameter_mm);
  if (arrangement == Arrangement::kFixed) {
    sheet.title += ", from centre to centre " + Millimetres(sheet.cell_mm);
  }
  return sheet;
}

MarkerSheet LayOutTarget(int id, double diameter_mm) {
  CheckIds(id, 1);
  if (!(diameter_mm >= kMinTargetMm && diameter_mm <= kMaxTargetMm)) {
    throw std::invalid_argument("a target's diameter must be 10 to 5000 mm, but is " +
                                Millimetres(diameter_mm));
  }
  MarkerSheet sheet;
  sheet.diameter_mm = diameter_mm;
  sheet.cell_mm = kSidePerDiameter * diameter_mm;
  sheet.page_mm = {sheet.cell_mm, sheet.cell_mm + kTargetFooterMm};
  sheet.scale_bar_mm = ScaleBar(0.8 * sheet.cell_mm);
  sheet.markers.push_back({id, 0, Eigen::Vector2d::Constant(0.5 * sheet.cell_mm)});
  sheet.title = "Plumbline marker " + std::to_string(id) + ": diameter " + Millimetres(diameter_mm);
  return sheet;
}

}  // namespace plumb
