// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plumbline/evaluation/nearest.h"
#include "plumbline/evaluation/triangle_mesh.h"
#include "plumbline/marker/marker_detector.h"
#include "plumbline/sfm/mapper.h"
#include "tools/experiment_flight.h"
#include "tools/experiment_options.h"

namespace plumb::tools {

// The kinds of last bundle, in the order of the tables.
constexpr const char* kBundles[] = {"held", "standard", "multi_scale", "constrained"};

// A photo as every reconstruction takes it: what is found in it does not depend on the calibration.
struct PreparedPhoto {
  FlightPhoto photo;
  PhotoAnalysis analysis;
  std::vector<MarkerDetection> markers;
};

// What all cells share; read only.
struct ExperimentData {
  ExperimentFlight flight;
  ExperimentOptions options;
  std::vector<PreparedPhoto> photos;
  TriangleMesh surface;
  std::unique_ptr<MeshIndex> surface_index;
  std::unique_ptr<CloudIndex> laser_index;  // Null without a scan.
};

struct CellKey {
  std::string rows;  // A row's name, or kAllRows.
  std::uint32_t seed = 1;
};

// Reconstructs the cell's photos with its faulty calibration, bundles the map in each of the ways
// and measures what comes out:
//   { "rows", "seed", "photos", "located", "faulty_lens": { "focal_px", "k1" },
//     "reconstruct_cpu_s", "bundles": { "held": { "control_mm": { "count", "mean", "max" },
//     "check_mm", "true_control_mm", "true_check_mm": the same, "bend_mm", "bend_rms_mm",
//     "bend_profile": [ { "u_m", "bend_mm" } ], "focal_px", "k1", "points", "within_2_sigma",
//     "within_2_ray_sigma", "surface_mm": { "median", "p90" }, "laser_mm": { "median", "p90",
//     "within_2_mm", "histogram": shares of kHistogramStep_mm each }, "cpu_s" }, … } }
// where what could not be measured is null. Deterministic but for the seconds; thread-safe.
nlohmann::ordered_json RunCell(const ExperimentData& data, const CellKey& key);

constexpr double kHistogramStep_mm = 0.25;
constexpr int kHistogramBins = 40;

}  // namespace plumb::tools
