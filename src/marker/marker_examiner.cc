// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/marker_examiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "marker/circle_edge.h"
#include "marker/code_reader.h"
#include "marker/face_fit.h"
#include "marker/face_samples.h"
#include "marker/local_lens.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

// A lens without a calibration is taken to have a focal length of half the photo's width or more.
constexpr double kMinFocalPerWidth = 0.5;
constexpr double kMinEdgeShare = 0.15;  // Of the contrast that an edge rises by within a pixel.
constexpr double kFineReachPx = 2.0;
constexpr double kMinSemiMinor = 0.45;  // Of the least diameter of a marker.
constexpr double kMinDiscPx = 4.0;

// Of the blur's sigma over the outer circle's shorter semi-axis. A cell is 0.22 long: beyond this
// no code is read right any more, but dark spots of photos pass for blurred markers. Of rendered
// markers of 12 to 40 px that were read right none had more than 0.18; of what was seen in photos
// without markers, none had less than 0.22.
constexpr double kMaxBlurRadii = 0.19;

// What the quick look at a candidate's rim asks for: enough contrast across it, and a rise of a
// share of that in most directions. Lenient: a candidate's ellipse is off by half a pixel of its
// level.
constexpr double kLookIn = 0.1;  // Radii: the middle of the black ring, short of the code.
constexpr double kLookOutPerReduction = 0.6;
constexpr int kNumLooks = 16;
constexpr int kMinLooks = 9;
constexpr double kMinLookRise = 0.1;
constexpr double kMinLookContrast = 0.3;  // Of the least of a marker; blur takes the rest.

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

// Whether it is darker inside than outside most of its rim; spares the closer look at most texture.
bool HasDarkInside(const GraySampler& gray, const MarkerCandidate& candidate, double min_contrast) {
  const Ellipse& ellipse = candidate.ellipse;
  const double in_px = kLookIn * ellipse.semi_minor_px;
  const double out_px = std::max(kLookOutPerReduction * candidate.reduction, in_px);
  if (!gray.ContainsSquare(ellipse.center_px, ellipse.semi_major_px + out_px)) return false;
  const Eigen::Matrix2d pixel_from_circle = ellipse.PixelFromCircle();
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2.0 * M_PI / kNumLooks).toRotationMatrix();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  std::array<double, kNumLooks> rises;
  for (double& rise : rises) {
    const Eigen::Vector2d ray = pixel_from_circle * direction;
    const Eigen::Vector2d outward = ray.normalized();
    rise = gray.At(ellipse.center_px + ray + out_px * outward) -
           gray.At(ellipse.center_px + ray - in_px * outward);
    direction = turn * direction;
  }
  const double mean = std::accumulate(rises.begin(), rises.end(), 0.0) / kNumLooks;
  const auto num_rises = std::count_if(
      rises.begin(), rises.end(), [mean](double rise) { return rise > kMinLookRise * mean; });
  return mean >= kMinLookContrast * min_contrast && num_rises >= kMinLooks;
}

}  // namespace

std::optional<Ellipse> MarkerExaminer::FindOuterEllipse(const MarkerCandidate& candidate) const {
  const double min_semi_minor_px = kMinSemiMinor * options_.min_diameter_px;
  EdgeSearch search;
  search.reach_px = std::max(1.5 * candidate.reduction, 0.12 * candidate.ellipse.semi_minor_px);
  // Most specks of texture are too small for an edge within reach to be a marker's.
  if (candidate.ellipse.semi_minor_px + search.reach_px < min_semi_minor_px ||
      !HasDarkInside(gray_, candidate, options_.min_contrast)) {
    return std::nullopt;
  }
  search.min_step = kMinEdgeShare * options_.min_contrast;
  const std::optional<Ellipse> found = RefineEllipse(gray_, candidate.ellipse, search);
  if (!found || found->semi_minor_px < min_semi_minor_px ||
      found->semi_minor_px < options_.min_axis_ratio * found->semi_major_px) {
    return std::nullopt;
  }
  search.reach_px = kFineReachPx;
  return RefineEllipse(gray_, *found, search);
}

// Where the disc is large enough to be told from its blur.
std::optional<Ellipse> MarkerExaminer::FindDisc(const Ellipse& outer) const {
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

std::optional<MarkerDetection> MarkerExaminer::Examine(const Ellipse& outer) const {
  const Eigen::Matrix3d pixel_from_circle = HomographyOfCircles(outer, FindDisc(outer));
  const std::optional<CodeReading> reading = ReadCode(options_, gray_, pixel_from_circle, {});
  if (!reading) return std::nullopt;
  MarkerDetection detection;
  detection.id = reading->id;
  detection.ellipse = outer;
  Eigen::Matrix3d circle_from_marker = Eigen::Matrix3d::Identity();
  circle_from_marker.topLeftCorner<2, 2>() =
      Eigen::Rotation2Dd(reading->angle_rad).toRotationMatrix();
  const std::optional<Laid> laid = LayFace(pixel_from_circle * circle_from_marker, &detection);
  if (!laid) return std::nullopt;
  // With the fitted face the cells lie better: the code must read the same, upright.
  const std::optional<CodeReading> again =
      ReadCode(options_, gray_, laid->raw_from_marker, {true, laid->blur_px});
  if (!again || again->id != detection.id || again->rotation != 0) return std::nullopt;
  detection.probability = again->probability;
  detection.num_corrected_bits = again->num_wrong_cells;
  return detection;
}

// Lays the face over the photo from a start in raw pixels. Gives the homography to raw pixels,
// exact but for how the distortion changes over the marker, and fills in what is measured.
std::optional<MarkerExaminer::Laid> MarkerExaminer::LayFace(
    const Eigen::Matrix3d& pixel_from_marker, MarkerDetection* detection) const {
  const Eigen::Vector2d origin_px = detection->ellipse.center_px;
  const std::optional<LocalLens> lens = LocalLens::At(camera_, origin_px);
  if (!lens) return std::nullopt;
  Eigen::Matrix3d flat_from_pixel = Eigen::Matrix3d::Identity();  // Relative to the origin.
  flat_from_pixel.topLeftCorner<2, 2>() = lens->flat_by_raw();
  flat_from_pixel.topRightCorner<2, 1>() = -lens->flat_by_raw() * origin_px;
  const double focal_px =
      camera_ != nullptr ? camera_->MeanFocalLength() : kMinFocalPerWidth * gray_.gray().cols;
  const std::optional<FaceFit> fit =
      FitFace(SampleFace(gray_, *lens, *detection, pixel_from_marker),
              MarkerCodebook::Get().Word(detection->id),
              flat_from_pixel * pixel_from_marker,
              detection->ellipse.semi_major_px / focal_px);
  if (!fit || fit->explained < options_.min_explained || fit->contrast < options_.min_contrast ||
      fit->blur_px > kMaxBlurRadii * detection->ellipse.semi_minor_px) {
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

}  // namespace plumb
