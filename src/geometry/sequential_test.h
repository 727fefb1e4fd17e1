// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace plumb {

// Wald's sequential test of a model against the matches (Matas & Chum, Randomized RANSAC with
// Sequential Probability Ratio Test, ICCV 2005): most bad models are refused after a few.
class SequentialTest {
 public:
  // One good model in so many is refused by mistake.
  static constexpr double kDecisionThreshold = 100.0;

  SequentialTest() { Update(); }

  // A good model has this ratio of inliers.
  void SetGoodRatio(double ratio) {
    good_ratio_ = ratio;
    Update();
  }
  // A refused model had so many inliers among so many matches tried.
  void AddRefused(int num_inliers, int num_tried) {
    refused_inliers_ += num_inliers;
    refused_tried_ += num_tried;
    if (++num_refused_ % 16 == 0) Update();
  }

  double log_inlier_factor() const { return log_inlier_factor_; }
  double log_outlier_factor() const { return log_outlier_factor_; }

 private:
  void Update() {
    // Starts as if 1000 matches had been tried with 1 % inliers by chance.
    bad_ratio_ = std::min((10.0 + refused_inliers_) / (1000.0 + refused_tried_), 0.5 * good_ratio_);
    log_inlier_factor_ = std::log(bad_ratio_ / good_ratio_);
    log_outlier_factor_ = std::log((1.0 - bad_ratio_) / (1.0 - good_ratio_));
  }

  double good_ratio_ = 0.1;  // Until a model is found: the hardest case worth its time.
  double bad_ratio_ = 0.0;
  double refused_inliers_ = 0.0;
  double refused_tried_ = 0.0;
  int num_refused_ = 0;
  double log_inlier_factor_ = 0.0;
  double log_outlier_factor_ = 0.0;
};

}  // namespace plumb
