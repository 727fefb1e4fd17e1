// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/experiment_flight.h"

namespace plumb::tools {

// A figure over the seeds.
struct MeanSpread {
  int count = 0;
  double mean = 0.0;
  double spread = 0.0;  // Standard deviation of one seed; 0 of a single one.
};

// Of numbers; nothing if there are none.
std::optional<MeanSpread> Summarise(const std::vector<double>& values);

// One line of the tables: some rows' photos after one kind of bundle, over the seeds.
struct ExperimentLine {
  std::string rows;
  double distance_m = 0.0;  // 0: several.
  std::string bundle;       // One of kBundles.
  int num_photos = 0;
  std::optional<MeanSpread> located;
  std::optional<MeanSpread> control_mm;
  std::optional<MeanSpread> check_mm;
  std::optional<MeanSpread> true_check_mm;
  std::optional<MeanSpread> bend_mm;
  std::optional<MeanSpread> within_2_sigma;
  std::optional<MeanSpread> within_2_ray_sigma;
  std::optional<MeanSpread> laser_median_mm;
  std::optional<MeanSpread> laser_p90_mm;
  std::optional<MeanSpread> cpu_s;  // Reconstruction and bundle.
  std::optional<MeanSpread> focal_px;
};

std::vector<ExperimentLine> SummariseCells(const ExperimentFlight& flight,
                                           const std::vector<std::string>& rows,
                                           const std::vector<nlohmann::ordered_json>& cells);

// Tables I and II with the paper's figures beside them.
std::string ToMarkdown(const ExperimentFlight& flight, const std::vector<ExperimentLine>& lines);

// All figures, a line each.
std::string ToCsv(const std::vector<ExperimentLine>& lines);
nlohmann::ordered_json ToJson(const std::vector<ExperimentLine>& lines);

// Writes tables.md, results.csv, results.json, errors.svg, bend.svg and, where there is a scan,
// laser.svg into `folder`; gives lines for a person, tables included.
std::vector<std::string> WriteExperimentReport(const ExperimentFlight& flight,
                                               const std::vector<std::string>& rows,
                                               const std::vector<nlohmann::ordered_json>& cells,
                                               const std::string& folder);

}  // namespace plumb::tools
