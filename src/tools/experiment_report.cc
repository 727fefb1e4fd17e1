// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment_report.h"

#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

#include "plumbline/common/atomic_file.h"
#include "tools/experiment_cell.h"
#include "tools/experiment_plots.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

// A number below `path` in a cell's bundle, if it was measured.
std::optional<double> NumberAt(const Json& bundle, const std::vector<const char*>& path) {
  const Json* json = &bundle;
  for (const char* key : path) {
    if (!json->is_object() || !json->contains(key)) return std::nullopt;
    json = &json->at(key);
  }
  if (!json->is_number()) return std::nullopt;
  return json->get<double>();
}

std::optional<MeanSpread> OverSeeds(const std::vector<const Json*>& bundles,
                                    const std::vector<const char*>& path) {
  std::vector<double> values;
  for (const Json* bundle : bundles) {
    if (const auto value = NumberAt(*bundle, path)) values.push_back(*value);
  }
  return Summarise(values);
}

ExperimentLine LineOf(const std::string& rows, const char* bundle, const std::vector<Json>& cells) {
  ExperimentLine line;
  line.rows = rows;
  line.bundle = bundle;
  std::vector<const Json*> bundles;
  std::vector<double> located;
  std::vector<double> cpu_s;
  for (const Json& cell : cells) {
    if (cell.at("rows") != rows) continue;
    line.num_photos = cell.at("photos").get<int>();
    located.push_back(cell.at("located").get<double>());
    const Json& of_bundle = cell.at("bundles").at(bundle);
    bundles.push_back(&of_bundle);
    if (const auto seconds = NumberAt(of_bundle, {"cpu_s"})) {
      cpu_s.push_back(*seconds + cell.at("reconstruct_cpu_s").get<double>());
    }
  }
  line.located = Summarise(located);
  line.cpu_s = Summarise(cpu_s);
  line.control_mm = OverSeeds(bundles, {"control_mm", "mean"});
  line.check_mm = OverSeeds(bundles, {"check_mm", "mean"});
  line.true_check_mm = OverSeeds(bundles, {"true_check_mm", "mean"});
  line.bend_mm = OverSeeds(bundles, {"bend_mm"});
  line.within_2_sigma = OverSeeds(bundles, {"within_2_sigma"});
  line.within_2_ray_sigma = OverSeeds(bundles, {"within_2_ray_sigma"});
  line.laser_median_mm = OverSeeds(bundles, {"laser_mm", "median"});
  line.laser_p90_mm = OverSeeds(bundles, {"laser_mm", "p90"});
  line.focal_px = OverSeeds(bundles, {"focal_px"});
  return line;
}

using Field = std::pair<const char*, std::optional<MeanSpread> ExperimentLine::*>;

const std::vector<Field>& Fields() {
  static const std::vector<Field> fields = {
      {"located", &ExperimentLine::located},
      {"control_mm", &ExperimentLine::control_mm},
      {"check_mm", &ExperimentLine::check_mm},
      {"true_check_mm", &ExperimentLine::true_check_mm},
      {"bend_mm", &ExperimentLine::bend_mm},
      {"within_2_sigma", &ExperimentLine::within_2_sigma},
      {"within_2_ray_sigma", &ExperimentLine::within_2_ray_sigma},
      {"laser_median_mm", &ExperimentLine::laser_median_mm},
      {"laser_p90_mm", &ExperimentLine::laser_p90_mm},
      {"cpu_s", &ExperimentLine::cpu_s},
      {"focal_px", &ExperimentLine::focal_px}};
  return fields;
}

}  // namespace

std::optional<MeanSpread> Summarise(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  MeanSpread summary;
  summary.count = static_cast<int>(values.size());
  for (const double value : values) summary.mean += value / static_cast<double>(values.size());
  if (values.size() < 2) return summary;
  double squares = 0.0;
  for (const double value : values) squares += std::pow(value - summary.mean, 2);
  summary.spread = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return summary;
}

std::vector<ExperimentLine> SummariseCells(const ExperimentFlight& flight,
                                           const std::vector<std::string>& rows,
                                           const std::vector<Json>& cells) {
  std::vector<ExperimentLine> lines;
  for (const std::string& row : rows) {
    for (const char* bundle : kBundles) {
      lines.push_back(LineOf(row, bundle, cells));
      for (const FlightRow& of_flight : flight.rows) {
        if (of_flight.name == row) lines.back().distance_m = of_flight.distance_m;
      }
    }
  }
  return lines;
}

std::string ToCsv(const std::vector<ExperimentLine>& lines) {
  std::ostringstream text;
  text.precision(6);
  text << "rows,distance_m,bundle,photos";
  for (const Field& field : Fields()) text << ',' << field.first << ',' << field.first << "_spread";
  text << ",seeds\n";
  for (const ExperimentLine& line : lines) {
    text << line.rows << ',' << line.distance_m << ',' << line.bundle << ',' << line.num_photos;
    for (const Field& field : Fields()) {
      const auto& value = line.*field.second;
      if (value) {
        text << ',' << value->mean << ',' << value->spread;
      } else {
        text << ",,";
      }
    }
    text << ',' << (line.located ? line.located->count : 0) << '\n';
  }
  return text.str();
}

Json ToJson(const std::vector<ExperimentLine>& lines) {
  Json json = Json::array();
  for (const ExperimentLine& line : lines) {
    Json of_line = {{"rows", line.rows},
                    {"distance_m", line.distance_m},
                    {"bundle", line.bundle},
                    {"photos", line.num_photos}};
    for (const Field& field : Fields()) {
      const auto& value = line.*field.second;
      of_line[field.first] =
          value ? Json{{"mean", value->mean}, {"spread", value->spread}, {"seeds", value->count}}
                : Json(nullptr);
    }
    json.push_back(of_line);
  }
  return json;
}

std::vector<std::string> WriteExperimentReport(const ExperimentFlight& flight,
                                               const std::vector<std::string>& rows,
                                               const std::vector<Json>& cells,
                                               const std::string& folder) {
  const std::vector<ExperimentLine> lines = SummariseCells(flight, rows, cells);
  const std::string markdown = ToMarkdown(flight, lines);
  std::vector<std::string> said;
  std::istringstream markdown_lines(markdown);
  for (std::string line; std::getline(markdown_lines, line);) said.push_back(line);
  const auto write = [&](const char* name, const std::string& content) {
    if (content.empty()) return;
    WriteFileAtomically(folder + '/' + name, content);
    said.push_back("wrote " + folder + '/' + name);
  };
  write("tables.md", markdown);
  write("results.csv", ToCsv(lines));
  write("results.json", ToJson(lines).dump(1) + '\n');
  write("errors.svg", DrawErrors(lines));
  write("bend.svg", DrawBend(rows, cells));
  write("laser.svg", DrawLaserHistogram(cells));
  return said;
}

}  // namespace plumb::tools
