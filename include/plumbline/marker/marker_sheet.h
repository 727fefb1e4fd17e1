// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumb {

enum class Paper { kA4, kA3 };

// Fixed: all markers of the 4 x 4 grid on one page, whose distances can be relied on. Loose: four
// larger ones a page, to be cut out along the dashed lines and strewn.
enum class Arrangement { kFixed, kLoose };

constexpr int kGridSide = 4;

struct PrintedMarker {
  int id = 0;
  int page = 0;
  Eigen::Vector2d center_mm = Eigen::Vector2d::Zero();  // From the page's upper left corner.
};

// Pages with markers, all of one size and upright. Lengths in mm, x right, y down.
struct MarkerSheet {
  std::string title;
  Eigen::Vector2d page_mm = Eigen::Vector2d::Zero();
  int num_pages = 1;
  double diameter_mm = 0.0;
  double cell_mm = 0.0;  // Side of the square that each marker has for itself.
  double scale_bar_mm = 100.0;
  bool has_cut_lines = false;
  std::vector<PrintedMarker> markers;
};

// The calibration grid of the IDs from `first_id`, row by row. Throws std::invalid_argument if the
// codebook does not hold that many.
MarkerSheet LayOutGrid(Paper paper, Arrangement arrangement, int first_id);

// One marker on a page of its own size. Throws std::invalid_argument if there is no such ID
// or the diameter is not in 10 .. 5000 mm.
MarkerSheet LayOutTarget(int id, double diameter_mm);

// Writes a sheet true to scale as vectors, with IDs and a scale bar: all pages to `path` if it ends
// in .pdf; a file a page if it ends in .svg, named name_1.svg, name_2.svg, … if there are several.
// Gives the files' names. Throws std::runtime_error for another ending or what the disk says.
std::vector<std::string> WriteMarkerSheet(const MarkerSheet& sheet, const std::string& path);

}  // namespace plumb
