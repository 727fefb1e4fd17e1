// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/view_choice.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "plumbline/common/options.h"

namespace plumb::ros_adapter {
namespace {

// Places of the markers that two images share, in the same order.
using Pairs = std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>;

Pairs SharedPlaces(const std::map<int, Eigen::Vector2d>& a,
                   const std::map<int, Eigen::Vector2d>& b) {
  Pairs pairs;
  for (const auto& [id, place] : a) {
    const auto other = b.find(id);
    if (other != b.end()) pairs.emplace_back(place, other->second);
  }
  return pairs;
}

std::pair<Eigen::Vector2d, Eigen::Vector2d> MeansOf(const Pairs& pairs) {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Vector2d second = Eigen::Vector2d::Zero();
  for (const auto& [a, b] : pairs) {
    first += a;
    second += b;
  }
  const double count = static_cast<double>(pairs.size());
  return {first / count, second / count};
}

}  // namespace

std::vector<std::string> ViewChoiceOptions::Problems() const {
  ProblemList problems;
  problems.Require(min_markers >= 4, "min_markers", "at least 4", min_markers);
  problems.Require(max_blur_px > 0.0, "max_blur_px", "positive", max_blur_px);
  problems.Require(max_speed_widths_s > 0.0, "max_speed_widths_s", "positive", max_speed_widths_s);
  problems.Require(max_video_gap_s > 0.0, "max_video_gap_s", "positive", max_video_gap_s);
  problems.Require(min_shift_widths > 0.0, "min_shift_widths", "positive", min_shift_widths);
  problems.Require(min_shape_change > 0.0, "min_shape_change", "positive", min_shape_change);
  problems.Require(max_views >= 3, "max_views", "at least 3", max_views);
  return problems.Take();
}

ViewChoice::ViewChoice(const ViewChoiceOptions& options) : options_(options) {
  ThrowIfProblems("choice of views", options.Problems());
}

void ViewChoice::Clear() {
  previous_.reset();
  taken_.clear();
}

std::string ViewChoice::Judge(const VideoView& view) {
  Seen seen{view.stamp_s, view.width_px, view.height_px, CentersOf(view)};
  const bool is_moving = IsMoving(seen);
  previous_ = seen;
  const int num_markers = static_cast<int>(seen.centers.size());
  if (num_markers == 0) return "no markers in view";
  if (num_markers < options_.min_markers) {
    return "only " + std::to_string(num_markers) + " of the " +
           std::to_string(options_.min_markers) + " markers needed";
  }
  if (static_cast<int>(taken_.size()) >= options_.max_views) {
    return std::to_string(options_.max_views) + " views are taken: that is enough";
  }
  if (is_moving) return "moving: hold still for a moment";
  if (view.blur_px && *view.blur_px > options_.max_blur_px) {
    return "blurred: hold still, focus, or give more light";
  }
  if (!IsNew(seen)) return "like one that was taken: move on";
  taken_.push_back(std::move(seen));
  return {};
}

ViewChoice::Centers ViewChoice::CentersOf(const VideoView& view) {
  Centers centers;
  std::set<int> twice;
  for (const MarkerDetection& marker : view.markers) {
    if (!centers.emplace(marker.id, marker.center_px).second) twice.insert(marker.id);
  }
  for (const int id : twice) centers.erase(id);
  return centers;
}

bool ViewChoice::IsMoving(const Seen& seen) const {
  if (!previous_) return false;
  const double gap_s = seen.stamp_s - previous_->stamp_s;
  if (gap_s <= 0.0 || gap_s > options_.max_video_gap_s) return false;
  const Pairs pairs = SharedPlaces(seen.centers, previous_->centers);
  if (pairs.empty()) return !seen.centers.empty();
  double sum_px = 0.0;
  for (const auto& [now, before] : pairs) sum_px += (now - before).norm();
  const double mean_px = sum_px / static_cast<double>(pairs.size());
  return mean_px / gap_s > options_.max_speed_widths_s * seen.width_px;
}

bool ViewChoice::IsNew(const Seen& seen) const {
  return std::all_of(
      taken_.begin(), taken_.end(), [&](const Seen& taken) { return Differs(seen, taken); });
}

// By the mean shift, and by what is left of the markers' shifts without it, over their spread.
bool ViewChoice::Differs(const Seen& seen, const Seen& taken) const {
  if (seen.width_px != taken.width_px || seen.height_px != taken.height_px) return true;
  const Pairs pairs = SharedPlaces(seen.centers, taken.centers);
  if (2 * pairs.size() < seen.centers.size() || pairs.size() < 2) return true;
  const auto [mean, mean_taken] = MeansOf(pairs);
  double change2 = 0.0;
  double spread2 = 0.0;
  for (const auto& [place, place_taken] : pairs) {
    change2 += (place - mean - (place_taken - mean_taken)).squaredNorm();
    spread2 += (place_taken - mean_taken).squaredNorm();
  }
  const double shift = (mean - mean_taken).norm() / (options_.min_shift_widths * seen.width_px);
  const double shape =
      spread2 > 0.0 ? std::sqrt(change2 / spread2) / options_.min_shape_change : 0.0;
  return std::hypot(shift, shape) >= 1.0;
}

}  // namespace plumb::ros_adapter
