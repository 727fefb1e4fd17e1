// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/marker/marker_detector.h"
#include "ros/view_choice_options.h"

namespace plumb::ros_adapter {

// What was seen in one image of a video.
struct VideoView {
  double stamp_s = 0.0;
  int width_px = 0;
  int height_px = 0;
  std::vector<MarkerDetection> markers;
  std::optional<double> blur_px;  // EdgeBlur_px.
};

// Picks the sharp images of new views out of a video. Not thread-safe.
class ViewChoice {
 public:
  // Throws std::invalid_argument if options.Problems() is not empty.
  explicit ViewChoice(const ViewChoiceOptions& options);

  // Empty if the view is taken; else why not, and what to do, in a few words. Views come in the
  // order of time; one with an earlier stamp begins a new video, as a bag played again.
  std::string Judge(const VideoView& view);

  void Clear();

 private:
  using Centers = std::map<int, Eigen::Vector2d>;  // Of the markers that are there once, by ID.

  struct Seen {
    double stamp_s = 0.0;
    int width_px = 0;
    int height_px = 0;
    Centers centers;
  };

  static Centers CentersOf(const VideoView& view);
  bool IsMoving(const Seen& seen) const;
  bool IsNew(const Seen& seen) const;
  bool Differs(const Seen& seen, const Seen& taken) const;

  const ViewChoiceOptions options_;
  std::optional<Seen> previous_;  // Image, taken or not.
  std::vector<Seen> taken_;
};

}  // namespace plumb::ros_adapter
