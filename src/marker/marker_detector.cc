// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/marker_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

#include "image/parallel_for.h"
#include "marker/candidate_search.h"
#include "marker/marker_examiner.h"
#include "plumbline/common/options.h"

namespace plumb {
namespace {

constexpr double kSamePx = 0.1;
constexpr int kItemsPerPart = 4;

void CheckInput(const MarkerDetectorOptions& options, const cv::Mat& gray, const Camera* camera) {
  ThrowIfProblems("marker detector", options.Problems());
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("markers are sought in grey photos of 8 bits (CV_8UC1) only");
  }
  if (camera != nullptr && (camera->width_px() != gray.cols || camera->height_px() != gray.rows)) {
    throw std::invalid_argument(
        "the photo has " + std::to_string(gray.cols) + " x " + std::to_string(gray.rows) +
        " pixels, but the camera's have " + std::to_string(camera->width_px()) + " x " +
        std::to_string(camera->height_px()) +
        "; use the camera's originals, and the camera file of photos of this size");
  }
}

// Runs `examine` on all items in parallel and keeps what it found, in order.
template <typename Result, typename Item, typename Examine>
std::vector<Result> ExamineAll(const std::vector<Item>& items, int num_threads, Examine examine) {
  std::vector<std::optional<Result>> results(items.size());
  ParallelFor(num_threads, static_cast<int>(items.size()), kItemsPerPart, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const std::size_t idx = static_cast<std::size_t>(i);
      results[idx] = examine(items[idx]);
    }
  });
  std::vector<Result> found;
  for (const std::optional<Result>& result : results) {
    if (result) found.push_back(*result);
  }
  return found;
}

// Several levels and both borders of a ring show the same outer circle.
std::vector<Ellipse> WithoutRepeats(const std::vector<Ellipse>& ellipses) {
  std::vector<Ellipse> kept;
  for (const Ellipse& ellipse : ellipses) {
    const bool is_repeat = std::any_of(kept.begin(), kept.end(), [&](const Ellipse& other) {
      return (other.center_px - ellipse.center_px).norm() < kSamePx &&
             std::abs(other.semi_major_px - ellipse.semi_major_px) < kSamePx &&
             std::abs(other.semi_minor_px - ellipse.semi_minor_px) < kSamePx;
    });
    if (!is_repeat) kept.push_back(ellipse);
  }
  return kept;
}

// Where two readings overlap, the one that explains the photo better is right.
std::vector<MarkerDetection> WithoutOverlaps(std::vector<MarkerDetection> detections) {
  const auto rank = [](const MarkerDetection& detection) {
    return std::make_tuple(-detection.explained, detection.center_px.x(), detection.center_px.y());
  };
  std::sort(detections.begin(),
            detections.end(),
            [&](const MarkerDetection& a, const MarkerDetection& b) { return rank(a) < rank(b); });
  std::vector<MarkerDetection> kept;
  for (const MarkerDetection& detection : detections) {
    const bool overlaps = std::any_of(kept.begin(), kept.end(), [&](const MarkerDetection& other) {
      return (other.center_px - detection.center_px).norm() <
             std::max(other.ellipse.semi_minor_px, detection.ellipse.semi_minor_px);
    });
    if (!overlaps) kept.push_back(detection);
  }
  std::sort(kept.begin(), kept.end(), [](const MarkerDetection& a, const MarkerDetection& b) {
    return std::make_tuple(a.id, a.center_px.x(), a.center_px.y()) <
           std::make_tuple(b.id, b.center_px.x(), b.center_px.y());
  });
  return kept;
}

}  // namespace

std::vector<MarkerDetection> DetectMarkers(const MarkerDetectorOptions& options,
                                           const cv::Mat& gray,
                                           const Camera* camera) {
  CheckInput(options, gray, camera);
  const MarkerExaminer examiner(options, gray, camera);
  const std::vector<Ellipse> ellipses = ExamineAll<Ellipse>(
      FindCandidates(options, gray), options.num_threads, [&](const MarkerCandidate& candidate) {
        return examiner.FindOuterEllipse(candidate);
      });
  return WithoutOverlaps(ExamineAll<MarkerDetection>(
      WithoutRepeats(ellipses), options.num_threads, [&](const Ellipse& outer) {
        return examiner.Examine(outer);
      }));
}

}  // namespace plumb
