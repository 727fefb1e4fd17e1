// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/evaluation/true_poses.h"
#include "plumbline/geometry/similarity3.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

struct PhotoError {
  std::string photo;
  double center_error_mm = 0.0;
  double rotation_error_deg = 0.0;
};

struct ErrorSummary {
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
};

struct PoseEvaluation {
  int num_truth = 0;                // Photos with a true pose.
  int num_registered = 0;           // Those of them that the map has located.
  std::vector<std::string> missed;  // The others.
  Similarity3 world_from_map;       // Fits the camera centres best; its scale is metres a map unit.
  ErrorSummary center_error_mm;
  ErrorSummary rotation_error_deg;
  std::vector<PhotoError> photos;  // In the order of the truth.
};

// Aligns the map with the truth by the similarity that fits the camera centres best, and
// measures what is left. Photos are paired by name. Throws std::runtime_error if fewer than three
// photos are in both or their centres lie on a line, for the alignment is then not determined.
PoseEvaluation EvaluatePoses(const std::vector<ViewState>& views,
                             const std::vector<TruePose>& truth);

}  // namespace plumb
