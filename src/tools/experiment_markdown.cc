// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "tools/experiment_report.h"

namespace plumb::tools {
namespace {

// Daftry et al., Building with Drones, ICRA 2015, tables I and II: mean error of the control
// points [mm]; all 17 of them, of which none was kept to check with.
struct PaperRow {
  double distance_m;
  const char* error_mm;
};
constexpr PaperRow kPaperRows[] = {{10.0, "5.7"}, {6.0, "23.1"}, {4.0, "45.2"}};
constexpr double kSameDistance = 0.1;  // Share of it.

const std::map<std::string, const char*>& PaperBundles() {
  static const std::map<std::string, const char*> bundles = {{"standard", "23.1"},
                                                             {"multi_scale", "9.1"}};
  return bundles;
}

std::string PaperOf(const ExperimentLine& line) {
  if (line.rows == kAllRows) {
    const auto found = PaperBundles().find(line.bundle);
    return found == PaperBundles().end() ? "" : found->second;
  }
  if (line.bundle != "standard") return "";
  for (const PaperRow& row : kPaperRows) {
    if (std::abs(line.distance_m / row.distance_m - 1.0) < kSameDistance) return row.error_mm;
  }
  return "";
}

std::string Text(const std::optional<MeanSpread>& value, int digits) {
  if (!value) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value->mean;
  if (value->count > 1) text << " ± " << value->spread;
  return text.str();
}

std::string PercentText(const std::optional<MeanSpread>& value) {
  if (!value) return "-";
  return Text(MeanSpread{value->count, 100.0 * value->mean, 100.0 * value->spread}, 1);
}

void AddTable(const std::vector<ExperimentLine>& lines, bool is_all, std::ostream* text) {
  *text << "| rows | photos | bundle | control, mm | check, mm | check to truth, mm | bend, mm | "
           "within 2 sigma, % | CPU s | paper, mm |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const ExperimentLine& line : lines) {
    if ((line.rows == kAllRows) != is_all) continue;
    *text << "| " << line.rows << " | " << Text(line.located, 0) << " of " << line.num_photos
          << " | " << line.bundle << " | " << Text(line.control_mm, 2) << " | "
          << Text(line.check_mm, 2) << " | " << Text(line.true_check_mm, 2) << " | "
          << Text(line.bend_mm, 2) << " | " << PercentText(line.within_2_sigma) << " | "
          << Text(line.cpu_s, 0) << " | " << PaperOf(line) << " |\n";
  }
}

}  // namespace

std::string ToMarkdown(const ExperimentFlight& flight, const std::vector<ExperimentLine>& lines) {
  std::ostringstream text;
  int num_seeds = 0;
  for (const ExperimentLine& line : lines) {
    if (line.located) num_seeds = std::max(num_seeds, line.located->count);
  }
  text
      << "# Multi-scale experiment\n\nFaulty calibrations: " << num_seeds
      << " (mean ± standard deviation of one). Photos, with their noise and blur, are the same for "
         "all.\n";
  if (flight.has_split_survey) {
    text << "The survey has no check points: every third point by id, from the second, was made "
            "one.\n";
  }
  text << "Bundles: `held` keeps the faulty lens; `standard` refines it; `multi_scale` weighs "
          "photos by distance as well; `constrained` has markers and control points in it too. "
          "Errors are means of the points' lengths after the similarity by the control points; the "
          "paper's are of control points. CPU seconds: reconstruction in the mapper's thread and "
          "the last bundle, features not included.\n";
  bool has_rows = false;
  bool has_all = false;
  for (const ExperimentLine& line : lines) (line.rows == kAllRows ? has_all : has_rows) = true;
  if (has_rows) {
    text << "\n## Table I: each row alone\n\n";
    AddTable(lines, /*is_all=*/false, &text);
  }
  if (has_all) {
    text << "\n## Table II: all rows together\n\n";
    AddTable(lines, /*is_all=*/true, &text);
    text << "\nThe paper took 880 s for 500 photos, features on the GPU included.\n";
  }
  return text.str();
}

}  // namespace plumb::tools
