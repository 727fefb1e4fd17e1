// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/georeference/survey.h"

namespace plumb::tools {

// The word for the photos of all rows together.
constexpr char kAllRows[] = "all";

struct FlightPhoto {
  std::string name;
  std::string row;
};

struct FlightRow {
  std::string name;
  double distance_m = 0.0;  // Mean over its photos.
  int num_photos = 0;
};

// What the experiment needs of a simulated flight.
struct ExperimentFlight {
  std::string folder;
  Camera camera;                    // The true one.
  Survey survey;                    // With check points.
  bool has_split_survey = false;    // It had none: some control points were made check points.
  std::vector<FlightPhoto> photos;  // As they were taken.
  std::vector<FlightRow> rows;      // Farthest first.
  std::map<int, Eigen::Vector3d>
      true_targets;  // Centres of the markers [m], in the survey's frame.

  std::string PhotoPath(const std::string& name) const { return folder + "/photos/" + name; }
  std::string SurfacePath() const { return folder + "/ground_truth/surface.ply"; }
  std::string LaserPath() const { return folder + "/ground_truth/laser.ply"; }
};

// Throws std::runtime_error naming the file that is missing or unusable, and the cure: no survey,
// fewer than three control points, photos of one row only, no ground truth.
ExperimentFlight ReadExperimentFlight(const std::string& folder);

// Of a survey that has control points only, every third by id, from the second on, becomes a check
// point, as long as three control points are left. True if that was done.
bool SplitSurvey(Survey* survey);

// The calibration that a careful person may have: focal length off by 0.1 to 0.3 %, k1 so far off
// that the photo's corners are wrong by 2 to 4 px, each to either side. The same for a seed
// everywhere.
Camera MakeFaultyCamera(const Camera& camera, std::uint32_t seed);

}  // namespace plumb::tools
