// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace plumb {

constexpr std::array<double, 5> kDistanceBoundsMm = {1.0, 2.0, 5.0, 10.0, 20.0};

using SharesWithin = std::array<double, kDistanceBoundsMm.size()>;  // 0..1, per bound.

// The one-way distances from each of a set of points to the other side.
struct DistanceSummary {
  std::size_t num_points = 0;  // All else is 0 if there is none.
  double mean_mm = 0.0;
  double median_mm = 0.0;
  double rms_mm = 0.0;
  double p90_mm = 0.0;  // 90 % are no farther: the partial one-way Hausdorff distance.
  double max_mm = 0.0;  // The one-way Hausdorff distance, which a single wrong point decides.
  SharesWithin share_within{};
};

// function(point) of each point, in their order, on all cores. `function` must be thread-safe, as
// those of MeshIndex and CloudIndex are.
std::vector<double> EvaluateAtPoints(const std::vector<Eigen::Vector3d>& points,
                                     const std::function<double(const Eigen::Vector3d&)>& function);

DistanceSummary SummariseDistances(std::vector<double> distances_m);

// Harmonic mean of the shares of both ways at each bound; 0 where both are 0 (Knapitsch et
// al., Tanks and Temples, ACM TOG 36(4), 2017, eq. 5).
SharesWithin FScore(const DistanceSummary& accuracy, const DistanceSummary& completeness);

}  // namespace plumb
