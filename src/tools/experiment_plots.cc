// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment_plots.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "calibration/svg_canvas.h"
#include "tools/experiment_cell.h"

namespace plumb::tools {
namespace {

using Eigen::Vector2d;
using Json = nlohmann::ordered_json;

constexpr double kFontSize = 11.0;
constexpr Color kGrey = {0.75, 0.75, 0.75};
// Told apart by any colour vision (Okabe & Ito, 2008), in the order of kBundles.
constexpr Color kColors[] = {
    {0.6, 0.6, 0.6}, {0.9, 0.62, 0.0}, {0.0, 0.45, 0.7}, {0.0, 0.62, 0.45}};

std::string Number(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

// 1, 2 or 5 times a power of ten, so that about five of them make `range`.
double StepFor(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (range / (factor * power) <= 6.0) return factor * power;
  }
  return 10.0 * power;
}

// A rectangle of the canvas in the units of its data.
struct Panel {
  Vector2d corner;  // Top left, on the canvas.
  Vector2d size;
  Vector2d least;  // Of the data.
  Vector2d most;

  Vector2d At(double x, double y) const {
    return {corner.x() + size.x() * (x - least.x()) / (most.x() - least.x()),
            corner.y() + size.y() * (most.y() - y) / (most.y() - least.y())};
  }
};

void DrawValues(const Panel& panel, SvgCanvas* canvas) {
  const double step = StepFor(panel.most.y() - panel.least.y());
  const int digits = step < 0.01 ? 3 : step < 0.1 ? 2 : step < 1.0 ? 1 : 0;
  for (double y = step * std::ceil(panel.least.y() / step); y <= panel.most.y(); y += step) {
    canvas->Line(panel.At(panel.least.x(), y), panel.At(panel.most.x(), y), kGrey, 0.5);
    canvas->Text(panel.At(panel.least.x(), y) + Vector2d(-6, 4), Number(y, digits), kFontSize, 1);
  }
  canvas->Frame(panel.corner, panel.size);
}

void DrawLegend(const Vector2d& at, SvgCanvas* canvas) {
  Vector2d corner = at;
  for (std::size_t i = 0; i < std::size(kBundles); ++i) {
    canvas->Rectangle(corner, {10, 10}, kColors[i]);
    canvas->Text(corner + Vector2d(15, 9), kBundles[i], kFontSize);
    corner.x() += 110;
  }
}

std::size_t BundleIndex(const std::string& bundle) {
  std::size_t idx = 0;
  while (idx + 1 < std::size(kBundles) && bundle != kBundles[idx]) ++idx;
  return idx;
}

const Json* FirstCellOf(const std::vector<Json>& cells, const std::string& rows) {
  for (const Json& cell : cells) {
    if (cell.at("rows") == rows) return &cell;
  }
  return nullptr;
}

using Profile = std::vector<Vector2d>;  // Place along the wall [m], bend [mm].

Profile ProfileOf(const Json& bundle) {
  Profile profile;
  if (!bundle.is_object()) return profile;
  for (const Json& column : bundle.at("bend_profile")) {
    profile.emplace_back(column.at("u_m").get<double>(), column.at("bend_mm").get<double>());
  }
  return profile;
}

// The least range that shows all profiles, zero in its middle.
void FitTo(const std::vector<Profile>& profiles, Panel* panel) {
  double largest_mm = 1.0;
  panel->least.x() = 1e9;
  panel->most.x() = -1e9;
  for (const Profile& profile : profiles) {
    for (const Vector2d& point : profile) {
      largest_mm = std::max(largest_mm, 1.1 * std::abs(point.y()));
      panel->least.x() = std::min(panel->least.x(), point.x());
      panel->most.x() = std::max(panel->most.x(), point.x());
    }
  }
  panel->least.y() = -largest_mm;
  panel->most.y() = largest_mm;
}

std::vector<Profile> ProfilesOf(const Json& cell) {
  std::vector<Profile> profiles;
  for (const char* bundle : kBundles) profiles.push_back(ProfileOf(cell.at("bundles").at(bundle)));
  return profiles;
}

// No wall, or one column of it, is no line.
bool HasBend(const Json& cell) {
  const std::vector<Profile> profiles = ProfilesOf(cell);
  return std::any_of(
      profiles.begin(), profiles.end(), [](const Profile& profile) { return profile.size() > 1; });
}

void DrawProfiles(const Json& cell, Panel panel, SvgCanvas* canvas) {
  const std::vector<Profile> profiles = ProfilesOf(cell);
  FitTo(profiles, &panel);
  DrawValues(panel, canvas);
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    std::vector<Vector2d> line;
    for (const Vector2d& point : profiles[i]) line.push_back(panel.At(point.x(), point.y()));
    if (line.size() > 1) canvas->Polyline(line, kColors[i], 1.5);
  }
  canvas->Text(
      panel.corner + Vector2d(6, 14), "rows: " + cell.at("rows").get<std::string>(), kFontSize);
  const Vector2d bottom = panel.corner + Vector2d(0, panel.size.y() + 14);
  canvas->Text(bottom, Number(panel.least.x(), 0) + " m", kFontSize);
  canvas->Text(
      bottom + Vector2d(panel.size.x(), 0), Number(panel.most.x(), 0) + " m", kFontSize, 1);
}

}  // namespace

std::string DrawErrors(const std::vector<ExperimentLine>& lines) {
  double largest_mm = 0.0;
  std::vector<std::string> groups;
  for (const ExperimentLine& line : lines) {
    if (groups.empty() || groups.back() != line.rows) groups.push_back(line.rows);
    if (line.check_mm)
      largest_mm = std::max(largest_mm, line.check_mm->mean + line.check_mm->spread);
  }
  if (largest_mm == 0.0) return {};
  SvgCanvas canvas(560, 330);
  const auto num_groups = static_cast<double>(groups.size());
  const Panel panel = {{60, 40}, {480, 240}, {0.0, 0.0}, {num_groups, 1.1 * largest_mm}};
  canvas.Text({60, 20}, "Mean error of the check points, mm (line: spread over the seeds)", 13);
  DrawValues(panel, &canvas);
  for (const ExperimentLine& line : lines) {
    const auto group = std::find(groups.begin(), groups.end(), line.rows) - groups.begin();
    const std::size_t idx = BundleIndex(line.bundle);
    if (!line.check_mm) continue;
    const double x = static_cast<double>(group) + 0.1 + 0.2 * static_cast<double>(idx);
    const Vector2d top = panel.At(x, line.check_mm->mean);
    const Vector2d foot = panel.At(x + 0.18, 0.0);
    canvas.Rectangle(top, foot - top, kColors[idx]);
    canvas.Line(panel.At(x + 0.09, line.check_mm->mean - line.check_mm->spread),
                panel.At(x + 0.09, line.check_mm->mean + line.check_mm->spread),
                {0, 0, 0});
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    canvas.Text(
        panel.At(static_cast<double>(i) + 0.5, 0.0) + Vector2d(0, 16), groups[i], kFontSize, 0);
  }
  DrawLegend({60, 308}, &canvas);
  return canvas.Finish();
}

std::string DrawBend(const std::vector<std::string>& rows, const std::vector<Json>& cells) {
  constexpr double kPanelHeight = 130.0;
  std::vector<const Json*> drawn;
  for (const std::string& row : rows) {
    const Json* cell = FirstCellOf(cells, row);
    if (cell != nullptr && HasBend(*cell)) drawn.push_back(cell);
  }
  if (drawn.empty()) return {};
  SvgCanvas canvas(620, 60.0 + static_cast<double>(drawn.size()) * (kPanelHeight + 30.0));
  canvas.Text({60, 20}, "Bend of the flat wall along its length, mm (mean of each 2 m)", 13);
  double top = 35.0;
  for (const Json* cell : drawn) {
    DrawProfiles(*cell, {{60, top}, {540, kPanelHeight}, {0, 0}, {0, 0}}, &canvas);
    top += kPanelHeight + 30.0;
  }
  DrawLegend({60, top}, &canvas);
  return canvas.Finish();
}

std::string DrawLaserHistogram(const std::vector<Json>& cells) {
  const Json* cell = FirstCellOf(cells, kAllRows);
  if (cell == nullptr && !cells.empty()) cell = &cells[0];
  if (cell == nullptr) return {};
  const Json& bundle = cell->at("bundles").at("multi_scale");
  if (!bundle.is_object() || !bundle.at("laser_mm").is_object()) return {};
  const auto shares = bundle.at("laser_mm").at("histogram").get<std::vector<double>>();
  const double largest = *std::max_element(shares.begin(), shares.end());
  SvgCanvas canvas(560, 320);
  const Panel panel = {
      {60, 40}, {480, 230}, {0.0, 0.0}, {kHistogramStep_mm * kHistogramBins, 110.0 * largest}};
  canvas.Text(
      {60, 20}, "Points of the map by their distance from the laser scan, % each 0.25 mm", 13);
  DrawValues(panel, &canvas);
  double outside = 1.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    outside -= shares[i];
    const double x = kHistogramStep_mm * static_cast<double>(i);
    const Vector2d corner = panel.At(x, 100.0 * shares[i]);
    canvas.Rectangle(corner, panel.At(x + 0.9 * kHistogramStep_mm, 0.0) - corner, kColors[2]);
  }
  for (int mm = 0; mm <= 10; mm += 2) {
    canvas.Text(panel.At(mm, 0.0) + Vector2d(0, 16), std::to_string(mm) + " mm", kFontSize, 0);
  }
  canvas.Text({60, 308},
              "median " + Number(bundle.at("laser_mm").at("median").get<double>(), 2) +
                  " mm, 90 % within " + Number(bundle.at("laser_mm").at("p90").get<double>(), 2) +
                  " mm; beyond 10 mm: " + Number(100.0 * outside, 1) + " %; rows " +
                  cell->at("rows").get<std::string>(),
              kFontSize);
  return canvas.Finish();
}

}  // namespace plumb::tools
