// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/focal_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/board_bundle.h"
#include "image/parallel_for.h"

namespace plumb {
namespace {

constexpr int kMaxIterations = 12;
constexpr std::size_t kMaxCandidates = 3;
constexpr double kNearBest = 1.3;  // Of the smallest error.
// What a view counts for that the start cannot place, in standard deviations: as much as one that
// is many pixels off.
constexpr double kUnplacedSigmas = 50.0;

// Half of Cauchy's norm, as Ceres has it.
double RobustCost(double sigmas, double width) {
  return 0.5 * width * width * std::log1p(sigmas * sigmas / (width * width));
}

// Marks the views of photos and markers that the start does not place. Returns how many.
int LeaveOutUnplaced(const BoardStart& start, Board* board) {
  int count = 0;
  for (MarkerView& view : board->views) {
    if (view.is_wrong) continue;
    view.is_wrong = start.has_pose[static_cast<std::size_t>(view.photo_idx)] == 0 ||
                    start.has_center[static_cast<std::size_t>(view.marker_idx)] == 0;
    count += view.is_wrong ? 1 : 0;
  }
  return count;
}

}  // namespace

std::optional<FocalCandidate> TryFocalLength(const CalibrationOptions& options,
                                             const Board& board,
                                             double focal_px) {
  std::optional<BoardStart> start = StartBoard(board, focal_px);
  if (!start) return std::nullopt;
  Board placed = board;
  const int num_unplaced = LeaveOutUnplaced(*start, &placed);
  const auto num_views = std::count_if(placed.views.begin(),
                                       placed.views.end(),
                                       [](const MarkerView& view) { return !view.is_wrong; });
  if (num_views == 0) return std::nullopt;
  BoardBundleSettings settings;
  settings.is_free[kK1] = settings.is_free[kK2] = true;
  settings.is_flat = true;
  settings.noise_factor = kSearchNoise;
  settings.robust_width = options.robust_width;
  settings.prior_focal_px = focal_px;
  settings.max_iterations = kMaxIterations;
  const BoardBundleReport report = SolveBoard(placed, settings, &start->state);
  if (!report.is_usable) return std::nullopt;
  const double cost =
      report.cost + num_unplaced * RobustCost(kUnplacedSigmas, options.robust_width);
  const double error =
      kSearchNoise * std::sqrt(2.0 * cost / static_cast<double>(num_views + num_unplaced));
  return FocalCandidate{std::move(*start), error};
}

FocalSearchResult SearchFocalLength(const CalibrationOptions& options, const Board& board) {
  const auto count = static_cast<std::size_t>(options.num_focal_steps);
  const double range = options.max_focal_per_width / options.min_focal_per_width;
  std::vector<double> focal_px(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    focal_px[i] = board.width_px * options.min_focal_per_width * std::pow(range, share);
  }
  std::vector<std::optional<FocalCandidate>> tried(count);
  ParallelFor(options.num_threads, options.num_focal_steps, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto idx = static_cast<std::size_t>(i);
      tried[idx] = TryFocalLength(options, board, focal_px[idx]);
    }
  });
  const auto error_at = [&](std::size_t i) {
    return i < count && tried[i] ? tried[i]->error : std::numeric_limits<double>::infinity();
  };
  FocalSearchResult result;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    if (!tried[i]) continue;
    result.curve.focal_px.push_back(focal_px[i]);
    result.curve.error.push_back(tried[i]->error);
    if (tried[i]->error >= best) continue;
    best = tried[i]->error;
    result.curve.best_focal_px = focal_px[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_minimum =
        tried[i] && error_at(i) <= error_at(i + 1) && (i == 0 || error_at(i) < error_at(i - 1));
    if (is_minimum && error_at(i) <= kNearBest * best) result.candidates.push_back(*tried[i]);
  }
  std::sort(result.candidates.begin(),
            result.candidates.end(),
            [](const FocalCandidate& a, const FocalCandidate& b) { return a.error < b.error; });
  if (result.candidates.size() > kMaxCandidates) result.candidates.resize(kMaxCandidates);
  return result;
}

}  // namespace plumb
