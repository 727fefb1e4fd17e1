// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/face_model.h"

#include <gtest/gtest.h>

#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"
#include "test/support/random.h"

namespace plumb::test {
namespace {

const std::uint32_t kWord = MarkerCodebook::Get().Word(20);

TEST(BlurredFace, IsTheFaceItselfFarFromItsEdges) {
  const Eigen::Matrix2d fine = Eigen::Matrix2d::Identity() * 0.002;
  EXPECT_NEAR(BlurredFace(kWord, {0.1, 0.0}, fine, {1.0, 0.0}).value, 1.0, 1e-9);
  EXPECT_NEAR(BlurredFace(kWord, {0.0, 0.3}, fine, {1.0, 0.0}).value, 0.0, 1e-9);
  EXPECT_NEAR(BlurredFace(kWord, {-0.9, 0.0}, fine, {1.0, 0.0}).value, 0.0, 1e-9);
  EXPECT_NEAR(BlurredFace(kWord, {0.0, -1.2}, fine, {1.0, 0.0}).value, 1.0, 1e-9);
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double cell = random.Index(kNumCodeBits) + random.Uniform(0.2, 0.8);
    const double angle_rad = 2.0 * M_PI * cell / kNumCodeBits;
    const Eigen::Vector2d point = 0.6 * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    EXPECT_NEAR(
        BlurredFace(kWord, point, fine, {1.0, 0.0}).value, IsWhite(kWord, point) ? 1.0 : 0.0, 1e-9);
  }
}

// Its blur along the edges changes with the place, which the derivative leaves out by design.
TEST(BlurredFace, ItsDerivativesAreThoseOfDifferences) {
  Random random(2);
  Eigen::Matrix2d marker_from_pixel;
  marker_from_pixel << 0.05, 0.01, -0.02, 0.08;
  for (int i = 0; i < 200; ++i) {
    const double radius = random.Uniform(0.75, 1.15);
    const double angle_rad = random.Uniform(-3.1, 3.1);
    const Eigen::Vector2d point(radius * std::cos(angle_rad), radius * std::sin(angle_rad));
    const auto value_at = [&](const Eigen::Vector2d& at, const EdgeLook& look) {
      return BlurredFace(kWord, at, marker_from_pixel, look).value;
    };
    const EdgeLook look{0.9, 0.3};
    const Whiteness face = BlurredFace(kWord, point, marker_from_pixel, look);
    const double step = 1e-5;
    const double by_blur = (value_at(point, {look.blur + step, look.growth}) -
                            value_at(point, {look.blur - step, look.growth})) /
                           (2.0 * step);
    EXPECT_NEAR(face.by_blur, by_blur, 1e-4);
    const double by_growth = (value_at(point, {look.blur, look.growth + step}) -
                              value_at(point, {look.blur, look.growth - step})) /
                             (2.0 * step);
    EXPECT_NEAR(face.by_growth, by_growth, 1e-4);
    const Eigen::Vector2d outward = point.normalized() * step;
    const double by_radius =
        (value_at(point + outward, look) - value_at(point - outward, look)) / (2.0 * step);
    EXPECT_NEAR(face.by_point.dot(point.normalized()), by_radius, 0.3);  // Of up to 8.
  }
}

TEST(BlurredFace, WhiteGrowsOnBothSidesOfTheBlackRing) {
  const Eigen::Matrix2d fine = Eigen::Matrix2d::Identity() * 0.01;  // 100 px of radius.
  for (const double growth : {-1.0, 0.0, 1.5}) {
    for (const double edge : {kDiscRadius + 0.01 * growth, 1.0 - 0.01 * growth}) {
      EXPECT_NEAR(BlurredFace(kWord, {edge, 0.0}, fine, {0.8, growth}).value, 0.5, 1e-6);
    }
  }
}

}  // namespace
}  // namespace plumb::test
