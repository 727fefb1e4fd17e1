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

// A pose beyond either bound is wrong, not merely inaccurate.
struct PoseTolerance {
  double max_center_error_m = 0.1;
  double max_rotation_error_deg = 1.0;
};

struct PoseEvaluation {
  int num_truth = 0;                       // Photos with a true pose.
  int num_registered = 0;                  // Those of them that the map has located.
  std::vector<std::string> missed;         // The others.
  std::vector<std::string> without_truth;  // Located, but not in the truth: measured by nothing.
  std::vector<std::string> wrong;          // Registered, but beyond the tolerance.
  Similarity3 world_from_map;              // Its scale is metres a map unit.
  ErrorSummary center_error_mm;
  ErrorSummary rotation_error_deg;
  std::vector<PhotoError> photos;  // In the order of the truth.
};

// Aligns the map with the truth by the similarity that fits the camera centres best, and measures
// what is left. If that leaves centres beyond the tolerance, the similarity is that of the largest
// set of centres within it, if it is more than half of them: one wrong pose then does not
// spoil the others'. If no centre is farther than the tolerance from one line, they do not tell the
// turn about it: it is taken from the cameras' rotations. Photos are paired by name. Deterministic.
// Throws std::runtime_error if fewer than three photos are in both or their centres lie on a line,
// for the alignment is then not determined.
PoseEvaluation EvaluatePoses(const std::vector<ViewState>& views,
                             const std::vector<TruePose>& truth,
                             const PoseTolerance& tolerance = {});

}  // namespace plumb
