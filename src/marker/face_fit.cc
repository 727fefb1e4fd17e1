// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/face_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "common/median.h"
#include "marker/face_model.h"

namespace plumb {
namespace {

// The homography [a00 a01 x; a10 a11 y; v0 v1 1], then blur, growth of white, black, contrast,
// light's gradient.
enum Parameter {
  kA00,
  kA01,
  kA10,
  kA11,
  kCenterX,
  kCenterY,
  kV0,
  kV1,
  kBlur,
  kGrowth,
  kBlack,
  kContrast,
  kLightX,
  kLightY,
  kNumParameters
};
using Parameters = Eigen::Matrix<double, kNumParameters, 1>;
using Normal = Eigen::Matrix<double, kNumParameters, kNumParameters>;

constexpr int kMaxIterations = 15;
constexpr double kMinBlurPx = 0.3;  // A pixel's own area has 0.29.
constexpr double kMaxBlurPx = 10.0;
// Standard deviation expected of the growth [px]. A camera's tone curve lets white grow by half of
// the blur; where the code leaves more black on one side, the centre would move with it.
constexpr double kGrowthSigmaPx = 0.4;
constexpr double kConvergedPx = 2e-4;
constexpr double kHuberWidth = 2.0;  // Standard deviations of the residuals.
constexpr double kMinNoise = 0.5;    // Grey levels: what rounding and JPEG leave.
// What the model's straight edges cost: to second order in the blur, so that the centre's standard
// deviation [px] grows with blur^2 / radius by this. Measured on rendered markers of 24 to 250 px
// under blurs of 0.8 to 3 px.
constexpr double kModelSigma = 0.16;

Eigen::Matrix3d HomographyOf(const Parameters& p) {
  Eigen::Matrix3d homography;
  homography << p(kA00), p(kA01), p(kCenterX), p(kA10), p(kA11), p(kCenterY), p(kV0), p(kV1), 1.0;
  return homography;
}

// Prediction and derivatives at one sample.
struct Prediction {
  double gray = 0.0;
  double white = 0.0;
  Parameters jacobian;
};

Prediction Predict(std::uint32_t word,
                   const Parameters& p,
                   const Eigen::Matrix3d& marker_from_pixel,
                   const Eigen::Vector2d& place_px) {
  const Eigen::Vector2d m = (marker_from_pixel * place_px.homogeneous()).hnormalized();
  const Eigen::Vector2d v(p(kV0), p(kV1));
  const double depth = 1.0 + v.dot(m);
  Eigen::Matrix2d affine;
  affine << p(kA00), p(kA01), p(kA10), p(kA11);
  // place = (affine m + center) / depth, so that its derivative by m is this.
  const Eigen::Matrix2d pixel_by_marker = (affine - place_px * v.transpose()) / depth;
  const Eigen::Matrix2d marker_by_pixel = pixel_by_marker.inverse();
  const Whiteness face = BlurredFace(word, m, marker_by_pixel, {p(kBlur), p(kGrowth)});
  // By how the pixel of a fixed point of the marker moves, at a fixed pixel.
  const double light = p(kContrast) + p(kLightX) * m.x() + p(kLightY) * m.y();
  const Eigen::RowVector2d by_place = -light * face.by_point.transpose() * marker_by_pixel / depth;
  Prediction prediction;
  prediction.white = face.value;
  prediction.gray = p(kBlack) + light * face.value;
  Parameters& j = prediction.jacobian;
  j(kA00) = by_place.x() * m.x();
  j(kA01) = by_place.x() * m.y();
  j(kA10) = by_place.y() * m.x();
  j(kA11) = by_place.y() * m.y();
  j(kCenterX) = by_place.x();
  j(kCenterY) = by_place.y();
  const double along_place = -by_place.dot(place_px);
  j(kV0) = along_place * m.x();
  j(kV1) = along_place * m.y();
  j(kBlur) = light * face.by_blur;
  j(kGrowth) = light * face.by_growth;
  j(kBlack) = 1.0;
  j(kContrast) = face.value;
  j(kLightX) = face.value * m.x();
  j(kLightY) = face.value * m.y();
  return prediction;
}

class Solver {
 public:
  Solver(const std::vector<FaceSample>& samples, std::uint32_t word, double perspective_sigma)
      : samples_(samples), word_(word), perspective_sigma_(perspective_sigma) {}

  // Accumulates the normal equations at `p`.
  void Linearize(const Parameters& p) {
    const Eigen::Matrix3d marker_from_pixel = HomographyOf(p).inverse();
    std::vector<Prediction> predictions;
    std::vector<double> sizes;
    predictions.reserve(samples_.size());
    for (const FaceSample& sample : samples_) {
      predictions.push_back(Predict(word_, p, marker_from_pixel, sample.place_px));
      sizes.push_back(std::abs(sample.gray - predictions.back().gray));
    }
    noise_ = std::max(kMinNoise, 1.4826 * MedianOf(sizes));  // Sigma of a Gaussian.
    normal_.setZero();
    right_.setZero();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const double residual = samples_[i].gray - predictions[i].gray;
      const double bound = kHuberWidth * noise_;
      const double weight = sizes[i] <= bound ? 1.0 : bound / sizes[i];
      const Parameters& j = predictions[i].jacobian;
      normal_.selfadjointView<Eigen::Lower>().rankUpdate(j, weight);
      right_ += weight * residual * j;
    }
    normal_ = normal_.selfadjointView<Eigen::Lower>();
    ExpectZero(kV0, perspective_sigma_, p);
    ExpectZero(kV1, perspective_sigma_, p);
    ExpectZero(kGrowth, kGrowthSigmaPx, p);
  }

  std::optional<Parameters> Step() const {
    Normal damped = normal_;
    damped.diagonal() *= 1.0 + 1e-4;
    const Eigen::LDLT<Normal> solver(damped);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return std::nullopt;
    const Parameters step = solver.solve(right_);
    if (!step.allFinite()) return std::nullopt;
    return step;
  }

  Eigen::Matrix2d CenterCovariance(const Parameters& p) const {
    const Normal covariance = normal_.ldlt().solve(Normal::Identity());
    const double radius_px = std::sqrt(std::abs(p(kA00) * p(kA11) - p(kA01) * p(kA10)));
    const double model_sigma_px = kModelSigma * p(kBlur) * p(kBlur) / radius_px;
    return noise_ * noise_ * covariance.block<2, 2>(kCenterX, kCenterX) +
           model_sigma_px * model_sigma_px * Eigen::Matrix2d::Identity();
  }

  double Explained(const Parameters& p) const {
    const Eigen::Matrix3d marker_from_pixel = HomographyOf(p).inverse();
    double mean = 0.0;
    for (const FaceSample& sample : samples_) {
      mean += sample.gray / static_cast<double>(samples_.size());
    }
    double total = 0.0;
    double left = 0.0;
    for (const FaceSample& sample : samples_) {
      const double predicted = Predict(word_, p, marker_from_pixel, sample.place_px).gray;
      total += (sample.gray - mean) * (sample.gray - mean);
      left += (sample.gray - predicted) * (sample.gray - predicted);
    }
    return total > 0.0 ? 1.0 - left / total : 0.0;
  }

 private:
  void ExpectZero(Parameter parameter, double sigma, const Parameters& p) {
    const double prior = noise_ * noise_ / (sigma * sigma);
    normal_(parameter, parameter) += prior;
    right_(parameter) -= prior * p(parameter);
  }

  const std::vector<FaceSample>& samples_;
  std::uint32_t word_;
  double perspective_sigma_;
  double noise_ = kMinNoise;
  Normal normal_;
  Parameters right_;
};

Parameters Start(const std::vector<FaceSample>& samples, const Eigen::Matrix3d& homography) {
  std::vector<double> grays;
  grays.reserve(samples.size());
  for (const FaceSample& sample : samples) grays.push_back(sample.gray);
  std::sort(grays.begin(), grays.end());
  const double black = grays[grays.size() / 10];
  const double white = grays[grays.size() - 1 - grays.size() / 10];
  const Eigen::Matrix3d h = homography / homography(2, 2);
  Parameters p;
  p << h(0, 0), h(0, 1), h(1, 0), h(1, 1), h(0, 2), h(1, 2), h(2, 0), h(2, 1), 0.9, 0.0, black,
      white - black, 0.0, 0.0;
  return p;
}

// Where nothing sensible is described any more.
bool IsAstray(const Parameters& p, const Eigen::Matrix3d& start) {
  const double radius_px = std::sqrt(std::abs(start.topLeftCorner<2, 2>().determinant()));
  const Eigen::Vector2d shift =
      Eigen::Vector2d(p(kCenterX), p(kCenterY)) - start.col(2).hnormalized();
  const double area = p(kA00) * p(kA11) - p(kA01) * p(kA10);
  const double ratio = area / (radius_px * radius_px);
  return !(shift.norm() < 0.4 * radius_px) || !(ratio > 0.5 && ratio < 2.0) ||
         !(std::hypot(p(kV0), p(kV1)) < 0.5) || !(p(kContrast) > 0.0);
}

}  // namespace

std::optional<FaceFit> FitFace(const std::vector<FaceSample>& samples,
                               std::uint32_t word,
                               const Eigen::Matrix3d& pixel_from_marker,
                               double perspective_sigma) {
  if (samples.size() < 2 * kNumParameters) return std::nullopt;
  Solver solver(samples, word, perspective_sigma);
  Parameters p = Start(samples, pixel_from_marker);
  bool has_converged = false;
  for (int i = 0; i < kMaxIterations && !has_converged; ++i) {
    solver.Linearize(p);
    const std::optional<Parameters> step = solver.Step();
    if (!step) return std::nullopt;
    p += *step;
    p(kBlur) = std::clamp(p(kBlur), kMinBlurPx, kMaxBlurPx);
    if (IsAstray(p, pixel_from_marker)) return std::nullopt;
    has_converged = std::hypot((*step)(kCenterX), (*step)(kCenterY)) < kConvergedPx;
  }
  FaceFit fit;
  fit.pixel_from_marker = HomographyOf(p);
  fit.center_covariance_px2 = solver.CenterCovariance(p);
  fit.contrast = p(kContrast);
  fit.blur_px = p(kBlur);
  fit.explained = solver.Explained(p);
  return fit;
}

}  // namespace plumb
