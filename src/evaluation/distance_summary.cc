// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/distance_summary.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <thread>

namespace plumb {
namespace {

constexpr double kMmPerM = 1000.0;

double Median(const std::vector<double>& sorted) {
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

}  // namespace

std::vector<double> EvaluateAtPoints(
    const std::vector<Eigen::Vector3d>& points,
    const std::function<double(const Eigen::Vector3d&)>& function) {
  std::vector<double> values(points.size());
  const std::size_t num_threads = std::max(1u, std::thread::hardware_concurrency());
  const auto measure = [&](std::size_t thread_idx) {
    for (std::size_t i = thread_idx; i < points.size(); i += num_threads) {
      values[i] = function(points[i]);
    }
  };
  std::vector<std::future<void>> workers;
  for (std::size_t i = 0; i < num_threads; ++i) {
    workers.push_back(std::async(std::launch::async, measure, i));
  }
  for (std::future<void>& worker : workers) worker.get();
  return values;
}

DistanceSummary SummariseDistances(std::vector<double> distances_m) {
  DistanceSummary summary;
  summary.num_points = distances_m.size();
  if (distances_m.empty()) return summary;
  std::sort(distances_m.begin(), distances_m.end());
  const auto count = static_cast<double>(distances_m.size());
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double distance_m : distances_m) {
    sum += distance_m;
    sum_of_squares += distance_m * distance_m;
  }
  summary.mean_mm = kMmPerM * sum / count;
  summary.median_mm = kMmPerM * Median(distances_m);
  summary.rms_mm = kMmPerM * std::sqrt(sum_of_squares / count);
  // The least distance that nine tenths do not exceed; integers, for 0.9 is not exact.
  summary.p90_mm = kMmPerM * distances_m[(9 * distances_m.size() + 9) / 10 - 1];
  summary.max_mm = kMmPerM * distances_m.back();
  for (std::size_t i = 0; i < kDistanceBoundsMm.size(); ++i) {
    const auto beyond =
        std::upper_bound(distances_m.begin(), distances_m.end(), kDistanceBoundsMm[i] / kMmPerM);
    summary.share_within[i] = static_cast<double>(beyond - distances_m.begin()) / count;
  }
  return summary;
}

SharesWithin FScore(const DistanceSummary& accuracy, const DistanceSummary& completeness) {
  SharesWithin scores{};
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const double sum = accuracy.share_within[i] + completeness.share_within[i];
    if (sum > 0.0) {
      scores[i] = 2.0 * accuracy.share_within[i] * completeness.share_within[i] / sum;
    }
  }
  return scores;
}

}  // namespace plumb
