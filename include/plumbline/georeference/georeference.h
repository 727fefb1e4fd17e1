// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/geometry/similarity3.h"
#include "plumbline/georeference/geo_frame.h"

namespace plumb {

enum class GeoreferenceSource {
  kNone,
  kGps,     // From the photos' positions: coarse, metres off.
  kTargets  // From surveyed targets.
};

// Lower-case names for reports and messages: "none", "gps", "targets".
const char* ToString(GeoreferenceSource source);

enum class TargetState {
  kUnseen,      // In fewer than two located photos, or none of them agree.
  kDouble,      // Two markers have this id; neither is used.
  kUnsurveyed,  // Seen, but the survey has no such id.
  kWaiting,     // Seen and surveyed, but there is no similarity by targets yet.
  kGood,
  kWrong  // Misread, mistyped, exchanged or moved; left out.
};

const char* ToString(TargetState state);

// What is known of one target.
struct TargetReport {
  int id = -1;
  std::string name;  // In the survey.
  bool is_check = false;
  TargetState state = TargetState::kUnseen;
  int num_photos = 0;  // Located ones that show it.
  int num_used = 0;    // Of them, those that agree on its place.
  double rms_error_px = 0.0;

  // Where the photos see it; only if the state is kWaiting, kGood, kWrong or kUnsurveyed.
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_in_map = Eigen::Matrix3d::Zero();

  // Model less survey, east, north, up; only if kGood or kWrong.
  Eigen::Vector3d residual_m = Eigen::Vector3d::Zero();
  // Expected length of the residual: survey, photos, and for what was not adjusted to also the
  // similarity; without the map's bend.
  double sigma_m = 0.0;
};

// Of the lengths of residuals.
struct ResidualSummary {
  int count = 0;  // All else is 0 if there is none.
  double mean_mm = 0.0;
  double median_mm = 0.0;
  double max_mm = 0.0;
  double rms_mm = 0.0;
};

// Something a person must hear.
struct Finding {
  enum class Severity {
    kNote,
    kWarning,  // The georeference stands, with less than full trust.
    kError     // The targets cannot be used as they are.
  };

  Severity severity = Severity::kNote;
  std::string code;  // One lower-case word, e.g. "wrong_target", for programs.
  std::string text;  // What is wrong, and the cure.
};

const char* ToString(Finding::Severity severity);

// The photos' positions against the targets, or alone.
struct GpsComparison {
  int num_photos = 0;
  // Target scale over GPS scale; only if there is a similarity by both.
  std::optional<double> scale_ratio;
  double scale_ratio_sigma = 0.0;
  // Median over the photos of the position by targets less that by GPS, east, north, up; only if
  // the survey's CRS says where on earth it is.
  std::optional<Eigen::Vector3d> offset_m;
};

// Where the map is, in the unit of metres, and how sure that is.
struct Georeference {
  GeoreferenceSource source = GeoreferenceSource::kNone;
  std::uint32_t map_sequence = 0;  // Of the map it was computed for.

  // Only if the source is not kNone.
  Similarity3 enu_from_map;  // Its scale is metres a map unit.
  std::optional<GeoFrame> frame;
  std::optional<Similarity3> earth_from_map;  // If the frame is not local.

  std::vector<TargetReport> targets;        // By id.
  ResidualSummary control;                  // Of good control points.
  ResidualSummary check;                    // Of good check points.
  double bend_sigma_m = 0.0;                // RobustSimilarity::bend_sigma.
  std::optional<double> marker_diameter_m;  // As the georeferenced photos show it; median.
  std::optional<GpsComparison> gps;
  std::vector<Finding> findings;  // Errors first.
};

}  // namespace plumb
