// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "marker/candidate_search.h"
#include "marker/gray_sampler.h"
#include "plumbline/camera/camera.h"
#include "plumbline/marker/ellipse.h"
#include "plumbline/marker/marker_detector.h"

namespace plumb {

// Looks closely at single places of a photo. Thread-safe: holds no mutable state.
class MarkerExaminer {
 public:
  // `gray` and `camera`, which may be null, must outlive this.
  MarkerExaminer(const MarkerDetectorOptions& options, const cv::Mat& gray, const Camera* camera)
      : options_(options), gray_(gray), camera_(camera) {}

  // The outer circle of a candidate, to a fraction of a pixel.
  std::optional<Ellipse> FindOuterEllipse(const MarkerCandidate& candidate) const;

  // The marker that has this outer circle.
  std::optional<MarkerDetection> Examine(const Ellipse& outer) const;

 private:
  struct Laid {
    Eigen::Matrix3d raw_from_marker;
    double blur_px = 0.0;
  };

  std::optional<Ellipse> FindDisc(const Ellipse& outer) const;
  std::optional<Laid> LayFace(const Eigen::Matrix3d& pixel_from_marker,
                              MarkerDetection* detection) const;

  MarkerDetectorOptions options_;
  GraySampler gray_;
  const Camera* camera_;
};

}  // namespace plumb
