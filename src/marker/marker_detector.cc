// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/marker_detector.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

#include "image/parallel_for.h"
#include "marker/candidate_search.h"
#include "marker/circle_edge.h"
#include "marker/code_reader.h"
#include "marker/face_fit.h"
#include "marker/gray_sampler.h"
#include "marker/local_lens.h"
#include "plumbline/common/options.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

// How far out the face is laid over the photo: into the quiet zone, short of its edge.
constexpr double kFitRadius = 1.15;
constexpr double kMaxExaminedPixels = 20000.0;
constexpr std::size_t kMaxFitSamples = 4000;
constexpr double kEdgeReachPx = 2.5;
constexpr int kSparseStep = 3;
// A lens without a calibration is taken to have a focal length of half the photo's width or more.
constexpr double kMinFocalPerWidth = 0.5;
constexpr double kMinEdgeShare = 0.15;  // Of the contrast that an edge rises by within a pixel.
constexpr double kFineReachPx = 2.0;
constexpr double kMinDiscPx = 4.0;
constexpr double kSamePx = 0.1;
constexpr int kItemsPerPart = 4;

// Homography from the canonical circle, without a rotation, by the outer ellipse and the seen
// centre of the circle. A homography [A c; v 1] maps the centre of a circle of radius r to c, and
// its dual conic diag(r^2, r^2, -1) to one whose centre is (c - r^2 A v) / (1 - r^2 v^2) (Hartley &
// Zisserman, Multiple View Geometry, 2nd ed., section 8.2: the dual conic maps as H C* H^T, and
// an ellipse's centre is the pole of the line at infinity). To first order in v the
// centres of two concentric circles tell A v and c.
Eigen::Matrix3d HomographyOfCircles(const Ellipse& outer, const std::optional<Ellipse>& disc) {
  Eigen::Matrix3d homography = Eigen::Matrix3d::Identity();
  const Eigen::Matrix2d affine = outer.PixelFromCircle();
  homography.topLeftCorner<2, 2>() = affine;
  homography.topRightCorner<2, 1>() = outer.center_px;
  if (!disc) return homography;
  constexpr double kShare = kDiscRadius * kDiscRadius;
  const Eigen::Vector2d shift = (disc->center_px - outer.center_px) / (1.0 - kShare);
  const Eigen::Vector2d v = affine.inverse() * shift;
  const Eigen::Vector2d center = disc->center_px + kShare * shift;
  homography.topLeftCorner<2, 2>() += center * v.transpose();
  homography.topRightCorner<2, 1>() = center;
  homography.bottomLeftCorner<1, 2>() = v.transpose();
  return homography;
}

// Evenly.
std::vector<FaceSample> Thinned(const std::vector<FaceSample>& samples) {
  const std::size_t step = samples.size() / kMaxFitSamples + 1;
  std::vector<FaceSample> thinned;
  for (std::size_t i = 0; i < samples.size(); i += step) thinned.push_back(samples[i]);
  return thinned;
}

class Detector {
 public:
  Detector(const MarkerDetectorOptions& options, const cv::Mat& gray, const Camera* camera)
      : options_(options), gray_(gray), camera_(camera) {}

  // The outer circle of a candidate, to a fraction of a pixel.
  std::optional<Ellipse> FindOuterEllipse(const MarkerCandidate& candidate) const;

  // The marker that has this outer circle.
  std::optional<MarkerDetection> Examine(const Ellipse& outer) const;

 private:
  std::optional<Ellipse> FindDisc(const Ellipse& outer) const;
  struct Laid {
    Eigen::Matrix3d raw_from_marker;
    double blur_px = 0.0;
  };
  std::optional<Laid> LayFace(const Eigen::Matrix3d& pixel_from_marker,
                              MarkerDetection* detection) const;
  std::vector<FaceSample> Samples(const Eigen::Matrix3d& pixel_from_marker,
                                  const MarkerDetection& detection,
                                  const LocalLens& lens) const;

  MarkerDetectorOptions options_;
  GraySampler gray_;
  const Camera* camera_;
};

std::optional<Ellipse> Detector::FindOuterEllipse(const MarkerCandidate& candidate) const {
  EdgeSearch search;
  search.reach_px = std::max(1.5 * candidate.reduction, 0.12 * candidate.ellipse.semi_minor_px);
  search.min_step = kMinEdgeShare * options_.min_contrast;
  const std::optional<Ellipse> found = RefineEllipse(gray_, candidate.ellipse, search);
  if (!found || found->semi_minor_px < 0.45 * options_.min_diameter_px ||
      found->semi_minor_px < options_.min_axis_ratio * found->semi_major_px) {
    return std::nullopt;
  }
  search.reach_px = kFineReachPx;
  return RefineEllipse(gray_, *found, search);
}

// Where the disc is large enough to be told from its blur.
std::optional<Ellipse> Detector::FindDisc(const Ellipse& outer) const {
  Ellipse disc = outer;
  disc.semi_major_px *= kDiscRadius;
  disc.semi_minor_px *= kDiscRadius;
  if (disc.semi_minor_px < kMinDiscPx) return std::nullopt;
  EdgeSearch search;
  search.is_dark_inside = false;
  search.min_step = kMinEdgeShare * options_.min_contrast;
  search.reach_px = 0.9 * disc.semi_minor_px;
  return RefineEllipse(gray_, disc, search);
}

std::optional<MarkerDetection> Detector::Examine(const Ellipse& outer) const {
  const Eigen::Matrix3d pixel_from_circle = HomographyOfCircles(outer, FindDisc(outer));
  const std::optional<CodeReading> reading = ReadCode(options_, gray_, pixel_from_circle, {});
  if (!reading) return std::nullopt;
  MarkerDetection detection;
  detection.id = reading->match.id;
  detection.ellipse = outer;
  Eigen::Matrix3d circle_from_marker = Eigen::Matrix3d::Identity();
  circle_from_marker.topLeftCorner<2, 2>() =
      Eigen::Rotation2Dd(reading->angle_rad).toRotationMatrix();
  const std::optional<Laid> laid = LayFace(pixel_from_circle * circle_from_marker, &detection);
  if (!laid) return std::nullopt;
  // With the fitted face the cells lie better: the code must read the same, upright.
  const std::optional<CodeReading> again =
      ReadCode(options_, gray_, laid->raw_from_marker, {true, laid->blur_px});
  if (!again || again->match.id != detection.id || again->match.rotation != 0) return std::nullopt;
  detection.probability = again->probability;
  detection.num_corrected_bits = again->match.num_errors;
  return detection;
}

// Whether the face changes within reach of a pixel.
bool IsNearEdge(std::uint32_t word,
                const Eigen::Matrix3d& marker_from_pixel,
                const Eigen::Vector2d& pixel) {
  const auto is_white_at = [&](double x, double y) {
    const Eigen::Vector2d beside = pixel + kEdgeReachPx * Eigen::Vector2d(x, y);
    return IsWhite(word, (marker_from_pixel * beside.homogeneous()).hnormalized());
  };
  const bool is_white = is_white_at(-1.0, 0.0);
  return is_white != is_white_at(1.0, 0.0) || is_white != is_white_at(0.0, -1.0) ||
         is_white != is_white_at(0.0, 1.0);
}

// Grey values of the face, at flat pixels relative to the lens's origin: those about its edges, and
// some of the others, for they tell black and white.
std::vector<FaceSample> Detector::Samples(const Eigen::Matrix3d& pixel_from_marker,
                                          const MarkerDetection& detection,
                                          const LocalLens& lens) const {
  const Eigen::Matrix3d marker_from_pixel = pixel_from_marker.inverse();
  const std::uint32_t word = MarkerCodebook::Get().Word(detection.id);
  const Ellipse& ellipse = detection.ellipse;
  const double reach_px = 1.3 * kFitRadius * ellipse.semi_major_px;
  const cv::Mat& gray = gray_.gray();
  const int x_begin = std::max(0, static_cast<int>(ellipse.center_px.x() - reach_px));
  const int y_begin = std::max(0, static_cast<int>(ellipse.center_px.y() - reach_px));
  const int x_end = std::min(gray.cols, static_cast<int>(ellipse.center_px.x() + reach_px) + 2);
  const int y_end = std::min(gray.rows, static_cast<int>(ellipse.center_px.y() + reach_px) + 2);
  const double area_px2 = M_PI * ellipse.semi_major_px * ellipse.semi_minor_px;
  const int stride = std::max(1, static_cast<int>(std::sqrt(area_px2 / kMaxExaminedPixels)));
  std::vector<FaceSample> samples;
  for (int y = y_begin; y < y_end; y += stride) {
    const std::uint8_t* row = gray.ptr<std::uint8_t>(y);
    for (int x = x_begin; x < x_end; x += stride) {
      const Eigen::Vector2d pixel(x, y);
      const double radius = (marker_from_pixel * pixel.homogeneous()).hnormalized().norm();
      if (radius > kFitRadius || radius < kCrossRadius) continue;
      const bool is_sparse = x % kSparseStep == 0 && y % kSparseStep == 0;
      if (!is_sparse && !IsNearEdge(word, marker_from_pixel, pixel)) continue;
      const std::optional<Eigen::Vector2d> flat_px = lens.FlatFromRaw(pixel);
      if (!flat_px) continue;
      samples.push_back({*flat_px - lens.flat_origin_px(), static_cast<double>(row[x])});
    }
  }
  return Thinned(samples);
}

// Lays the face over the photo from a start in raw pixels. Gives the homography to raw pixels,
// exact but for how the distortion changes over the marker, and fills in what is measured.
std::optional<Detector::Laid> Detector::LayFace(const Eigen::Matrix3d& pixel_from_marker,
                                                MarkerDetection* detection) const {
  const Eigen::Vector2d origin_px = detection->ellipse.center_px;
  const std::optional<LocalLens> lens = LocalLens::At(camera_, origin_px);
  if (!lens) return std::nullopt;
  Eigen::Matrix3d flat_from_pixel = Eigen::Matrix3d::Identity();  // Relative to the origin.
  flat_from_pixel.topLeftCorner<2, 2>() = lens->flat_by_raw();
  flat_from_pixel.topRightCorner<2, 1>() = -lens->flat_by_raw() * origin_px;
  const double focal_px =
      camera_ != nullptr ? camera_->MeanFocalLength() : kMinFocalPerWidth * gray_.gray().cols;
  const std::optional<FaceFit> fit = FitFace(Samples(pixel_from_marker, *detection, *lens),
                                             MarkerCodebook::Get().Word(detection->id),
                                             flat_from_pixel * pixel_from_marker,
                                             detection->ellipse.semi_major_px / focal_px);
  if (!fit || fit->explained < options_.min_explained || fit->contrast < options_.min_contrast) {
    return std::nullopt;
  }
  Eigen::Matrix3d flat_from_origin = Eigen::Matrix3d::Identity();
  flat_from_origin.topRightCorner<2, 1>() = lens->flat_origin_px();
  detection->pixel_from_marker = flat_from_origin * fit->pixel_from_marker;
  const std::optional<Eigen::Vector2d> center_px =
      lens->RawFromFlat(detection->pixel_from_marker.col(2).hnormalized());
  if (!center_px) return std::nullopt;
  const Eigen::Matrix2d raw_by_flat = lens->flat_by_raw().inverse();
  detection->center_px = *center_px;
  detection->center_covariance_px2 =
      raw_by_flat * fit->center_covariance_px2 * raw_by_flat.transpose();
  detection->explained = fit->explained;
  return Laid{flat_from_pixel.inverse() * fit->pixel_from_marker, fit->blur_px};
}

void CheckInput(const MarkerDetectorOptions& options, const cv::Mat& gray, const Camera* camera) {
  ThrowIfProblems("marker detector", options.Problems());
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("markers are sought in grey photos of 8 bits (CV_8UC1) only");
  }
  if (camera != nullptr && (camera->width_px() != gray.cols || camera->height_px() != gray.rows)) {
    throw std::invalid_argument(
        "the photo has " + std::to_string(gray.cols) + " x " + std::to_string(gray.rows) +
        " pixels, but the camera's have " + std::to_string(camera->width_px()) + " x " +
        std::to_string(camera->height_px()) + "; use the camera's originals");
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
  const Detector detector(options, gray, camera);
  const std::vector<Ellipse> ellipses = ExamineAll<Ellipse>(
      FindCandidates(options, gray), options.num_threads, [&](const MarkerCandidate& candidate) {
        return detector.FindOuterEllipse(candidate);
      });
  return WithoutOverlaps(ExamineAll<MarkerDetection>(
      WithoutRepeats(ellipses), options.num_threads, [&](const Ellipse& outer) {
        return detector.Examine(outer);
      }));
}

}  // namespace plumb
