// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "plumbline/common/ids.h"

namespace plumb {

enum class VerdictStatus {
  kAccepted,  // Located in the map.
  kWaiting,   // Nothing wrong with it; there is no map yet to locate it in.
  kRefused    // Not located, for a reason; tried again by itself where that can help.
};

enum class RefusalReason {
  kNone,
  kUndecodable,
  kWrongSize,
  kDuplicate,
  kTooBlurred,
  kTooFewFeatures,
  kNoOverlap,
  kTooFewInliers,
  kAmbiguous,
  kNoParallax
};

// Lower-case names for reports, messages and the database, e.g. "accepted", "no_overlap".
const char* ToString(VerdictStatus status);
const char* ToString(RefusalReason reason);

// The inverse; throws std::invalid_argument naming an unknown word.
VerdictStatus VerdictStatusFromString(const std::string& word);
RefusalReason RefusalReasonFromString(const std::string& word);

// Wall-clock seconds by stage.
struct StageSeconds {
  double decode_s = 0.0;
  double features_s = 0.0;
  double retrieval_s = 0.0;
  double matching_s = 0.0;
  double pose_s = 0.0;
  double verdict_s =
      0.0;                // From the photo's first byte to the verdict, waiting in queues included.
  double expand_s = 0.0;  // After the verdict.
  double bundle_s = 0.0;  // Local bundle, after the verdict.
};

// What the pilot hears about one photo. A photo has one verdict at a time; a new
// one (greater `attempt`) replaces the one before.
struct PhotoVerdict {
  PhotoId photo;
  std::string name;
  int attempt = 1;
  VerdictStatus status = VerdictStatus::kWaiting;
  RefusalReason reason = RefusalReason::kNone;
  std::string hint;     // What the pilot can do, one sentence; empty if accepted.
  int num_matches = 0;  // 2D-3D matches tried.
  int num_inliers = 0;  // Once accepted with those only the pose led to: may pass num_matches.
  double median_error_px = 0.0;  // Reprojection error of the inliers; 0 without any.
  StageSeconds seconds;
  std::vector<Eigen::Vector2f> inlier_pixels;  // Raw pixels, for the annotated photo.
  std::vector<Eigen::Vector2f> outlier_pixels;
};

}  // namespace plumb
