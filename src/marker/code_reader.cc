// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/code_reader.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <vector>

#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

constexpr int kSamplesPerCell = 8;
constexpr int kNumAngles = kSamplesPerCell * kNumCodeBits;
using Unrolled = Eigen::Array<double, kNumAngles, 1>;
using Cells = Eigen::Array<double, kNumCodeBits, 1>;

constexpr double kWhiteRadius = 1.12;
constexpr double kRingRadius = 0.9;
constexpr double kInnerBlackRadius = 0.31;
constexpr double kInDiscRadius = 0.1;  // Outside the hair cross.
constexpr std::array<double, 4> kStripeRadii = {0.5, 0.57, 0.64, 0.71};

// Share of the directions that must show the outer circle; blur and a hidden part cost some.
constexpr double kMinCircleShare = 0.85;
// Rises as shares of the contrast: of the outer circle, and of the centre disc, which at a
// diameter of 12 px has a radius of 1.2 px.
constexpr double kMinCircleRise = 0.4;
constexpr double kMinDiscRise = 0.1;

// Bound on the share of the cells' variance that the code explains.
constexpr double kMinExplained = 0.75;
constexpr double kTinyVariance = 0.25;  // Half a grey level: rounding.

Eigen::Vector2d Polar(double radius, double angle_rad) {
  return radius * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
}

Eigen::Vector2d Apply(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point) {
  return (homography * point.homogeneous()).hnormalized();
}

// The grey values along a circle; nothing if it is not all in the photo.
std::optional<Unrolled> Unroll(const GraySampler& gray,
                               const Eigen::Matrix3d& pixel_from_circle,
                               double radius) {
  Unrolled values;
  for (int i = 0; i < kNumAngles; ++i) {
    const Eigen::Vector2d pixel =
        Apply(pixel_from_circle, Polar(radius, 2.0 * M_PI * i / kNumAngles));
    if (!gray.Contains(pixel)) return std::nullopt;
    values(i) = gray.At(pixel);
  }
  return values;
}

bool ShowsCircles(const MarkerDetectorOptions& options,
                  const GraySampler& gray,
                  const Eigen::Matrix3d& pixel_from_circle) {
  const std::optional<Unrolled> white = Unroll(gray, pixel_from_circle, kWhiteRadius);
  const std::optional<Unrolled> black = Unroll(gray, pixel_from_circle, kRingRadius);
  if (!white || !black) return false;
  const double contrast = white->mean() - black->mean();
  if (contrast < 0.5 * options.min_contrast) return false;  // Blur takes up to half of it.
  const auto num_rises = ((*white - *black) > kMinCircleRise * contrast).count();
  if (static_cast<double>(num_rises) < kMinCircleShare * kNumAngles) return false;
  const std::optional<Unrolled> disc = Unroll(gray, pixel_from_circle, kInDiscRadius);
  const std::optional<Unrolled> around_disc = Unroll(gray, pixel_from_circle, kInnerBlackRadius);
  return disc && around_disc && disc->mean() - around_disc->mean() > kMinDiscRise * contrast;
}

// What a cell gives to each neighbour by the blur, by Gauss's integral over the middle of the cell.
double LeakOf(const Eigen::Matrix3d& pixel_from_circle, double blur_px) {
  // The derivative at the centre.
  const Eigen::Matrix3d h = pixel_from_circle / pixel_from_circle(2, 2);
  const double area_scale =
      std::abs((h.topLeftCorner<2, 2>() - h.topRightCorner<2, 1>() * h.bottomLeftCorner<1, 2>())
                   .determinant());
  const double cell_px = 0.6 * std::sqrt(area_scale) * 2.0 * M_PI / kNumCodeBits;
  const double sigma = blur_px / cell_px;
  const auto tail = [sigma](double distance) {
    return 0.5 * std::erfc(distance / sigma / std::sqrt(2.0));
  };
  return 0.5 * (tail(0.5) + 0.5 * (tail(0.2) + tail(0.8)));
}

// Means over the middles of the cells that begin at sample `start`.
Cells BinCells(const Unrolled& stripe, int start) {
  Cells cells;
  for (int cell = 0; cell < kNumCodeBits; ++cell) {
    double sum = 0.0;
    for (int i = 1; i < kSamplesPerCell; ++i) {
      sum += stripe((start + cell * kSamplesPerCell + i) % kNumAngles);
    }
    cells(cell) = sum / (kSamplesPerCell - 1);
  }
  return cells;
}

// Moves a share of each cell to its two neighbours; back, to first order, if it is negative.
Cells Leak(const Cells& cells, double share) {
  Cells leaked;
  for (int i = 0; i < kNumCodeBits; ++i) {
    const double neighbors =
        cells((i + 1) % kNumCodeBits) + cells((i + kNumCodeBits - 1) % kNumCodeBits);
    leaked(i) = cells(i) + share * (neighbors - 2.0 * cells(i));
  }
  return leaked;
}

// Otsu's threshold: least variance within the two classes.
double Threshold(const Cells& cells) {
  Cells sorted = cells;
  std::sort(sorted.begin(), sorted.end());
  double threshold = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int num_dark = 2; num_dark <= kNumCodeBits - 2; ++num_dark) {
    const auto dark = sorted.head(num_dark);
    const auto bright = sorted.tail(kNumCodeBits - num_dark);
    const double within =
        (dark - dark.mean()).square().sum() + (bright - bright.mean()).square().sum();
    if (within >= least) continue;
    least = within;
    threshold = 0.5 * (dark.mean() + bright.mean());
  }
  return threshold;
}

// A row for each code at each rotation, ID by ID: its bits less their mean.
using CodeTable = Eigen::Matrix<double, Eigen::Dynamic, kNumCodeBits>;

CodeTable MakeCodeTable() {
  const MarkerCodebook& codebook = MarkerCodebook::Get();
  CodeTable codes(codebook.size() * kNumCodeBits, kNumCodeBits);
  for (int row = 0; row < codes.rows(); ++row) {
    const std::uint32_t word = RotateWord(codebook.Word(row / kNumCodeBits), row % kNumCodeBits);
    for (int i = 0; i < kNumCodeBits; ++i) codes(row, i) = static_cast<double>((word >> i) & 1U);
    codes.row(row).array() -= codes.row(row).mean();
  }
  return codes;
}

const CodeTable& AllCodes() {
  static const CodeTable codes = MakeCodeTable();
  return codes;
}

// How well an ID explains the cells at its best start and rotation.
struct Explanation {
  int start = 0;
  int rotation = 0;
  double residual = std::numeric_limits<double>::infinity();  // Sum of squares.
  double explained = 0.0;                                     // Share of the cells' variance.
};

// Of each ID, the sum of the squares of its code blurred by the leak; its rotations have the same.
Eigen::VectorXd SquaredLengths(int num_ids, double leak) {
  Eigen::VectorXd lengths2(num_ids);
  for (int id = 0; id < num_ids; ++id) {
    const Cells code = AllCodes().row(id * kNumCodeBits).transpose();
    lengths2(id) = Leak(code, leak).square().sum();
  }
  return lengths2;
}

// Explains the cells that begin at sample `start` by every code at every rotation, blurred by the
// leak: by least squares over the code's contrast. Blurring the cells instead of the codes gives
// the same products, for the leak is symmetric.
void ExplainAt(const Unrolled& stripe,
               int start,
               double leak,
               const Eigen::VectorXd& lengths2,
               std::vector<Explanation>* by_id) {
  const Cells cells = BinCells(stripe, start);
  const Cells from_mean = cells - cells.mean();
  const double total = from_mean.square().sum();
  const Eigen::VectorXd products = AllCodes() * Leak(from_mean, leak).matrix();
  for (std::size_t id = 0; id < by_id->size(); ++id) {
    const auto first = static_cast<Eigen::Index>(id) * kNumCodeBits;
    Eigen::Index rotation = 0;
    const double product = products.segment<kNumCodeBits>(first).maxCoeff(&rotation);
    const double residual =
        total - std::pow(std::max(0.0, product), 2) / lengths2(static_cast<Eigen::Index>(id));
    if (residual >= (*by_id)[id].residual) continue;
    (*by_id)[id] = {
        start, static_cast<int>(rotation), residual, 1.0 - residual / (total + kTinyVariance)};
  }
}

// The cells by their threshold, once the blur is undone.
std::uint32_t ThresholdedWord(const Unrolled& stripe, int start, double leak) {
  const Cells sharp = Leak(BinCells(stripe, start), -leak);
  const double threshold = Threshold(sharp);
  std::uint32_t word = 0;
  for (int i = 0; i < kNumCodeBits; ++i) {
    if (sharp(i) > threshold) word |= 1U << i;
  }
  return word;
}

// Of the best one, by the likelihoods of all under Gaussian noise of its own size.
double Probability(const std::vector<Explanation>& by_id, const Explanation& best) {
  const double variance = best.residual / (kNumCodeBits - 2) + kTinyVariance;
  double sum = 0.0;
  for (const Explanation& explanation : by_id) {
    sum += std::exp(-0.5 * (explanation.residual - best.residual) / variance);
  }
  return 1.0 / sum;
}

}  // namespace

std::optional<CodeReading> ReadCode(const MarkerDetectorOptions& options,
                                    const GraySampler& gray,
                                    const Eigen::Matrix3d& pixel_from_circle,
                                    const CodeSearch& search) {
  if (!ShowsCircles(options, gray, pixel_from_circle)) return std::nullopt;
  Unrolled stripe = Unrolled::Zero();
  for (const double radius : kStripeRadii) {
    const std::optional<Unrolled> circle = Unroll(gray, pixel_from_circle, radius);
    if (!circle) return std::nullopt;
    stripe += *circle;
  }
  stripe /= static_cast<double>(kStripeRadii.size());
  const double leak = LeakOf(pixel_from_circle, search.blur_px);
  const MarkerCodebook& codebook = MarkerCodebook::Get();
  std::vector<Explanation> by_id(static_cast<std::size_t>(codebook.size()));
  const int num_starts = search.is_upright ? 1 : kSamplesPerCell;
  const Eigen::VectorXd lengths2 = SquaredLengths(codebook.size(), leak);
  for (int start = 0; start < num_starts; ++start) {
    ExplainAt(stripe, start, leak, lengths2, &by_id);
  }
  const auto best = std::min_element(by_id.begin(), by_id.end(), [](const auto& a, const auto& b) {
    return a.residual < b.residual;
  });
  CodeReading reading;
  reading.probability = Probability(by_id, *best);
  if (best->explained < kMinExplained || reading.probability < options.min_probability) {
    return std::nullopt;
  }
  const int id = static_cast<int>(best - by_id.begin());
  const std::uint32_t word = ThresholdedWord(stripe, best->start, leak);
  const std::optional<CodeMatch> looked_up = codebook.Find(word);
  if (looked_up && looked_up->id != id) return std::nullopt;
  const std::uint32_t wrong = word ^ RotateWord(codebook.Word(id), best->rotation);
  reading.id = id;
  reading.rotation = best->rotation;
  reading.num_wrong_cells = static_cast<int>(std::bitset<kNumCodeBits>(wrong).count());
  reading.angle_rad = 2.0 * M_PI * (best->start + kSamplesPerCell * best->rotation) / kNumAngles;
  return reading;
}

}  // namespace plumb
