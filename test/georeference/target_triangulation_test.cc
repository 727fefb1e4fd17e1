// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/target_triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

// Eight cameras in a row before a point.
class TriangulateTargetTest : public testing::Test {
 protected:
  std::vector<TargetSighting> See(const Eigen::Vector3d& point, double noise_px, int seed = 1) {
    test::Random random(seed);
    std::vector<TargetSighting> sightings;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const Eigen::Vector3d center(0.8 * i - 2.8, -10.0, 0.4 * (i % 3));
      TargetSighting sighting;
      sighting.photo = {i};
      sighting.cam_from_map = Rigid3(test::FacingFacade(), -(test::FacingFacade() * center));
      sighting.pixel = *camera_.Project(sighting.cam_from_map * point) + random.Normal2(noise_px);
      sighting.covariance_px2 = noise_px * noise_px * Eigen::Matrix2d::Identity();
      sightings.push_back(sighting);
    }
    return sightings;
  }

  std::optional<TriangulatedTarget> Triangulate(const std::vector<TargetSighting>& sightings) {
    return TriangulateTarget(bounds_, camera_, sightings);
  }

  Camera camera_ = test::MakeCamera(-0.05, 0.02, 0.001, -0.001);
  TriangulationBounds bounds_;
  Eigen::Vector3d point_{0.5, 0.2, -0.7};
};

TEST_F(TriangulateTargetTest, FindsTheTruthWithoutNoise) {
  const auto target = Triangulate(See(point_, 0.0));
  ASSERT_TRUE(target);
  EXPECT_LT((target->point_in_map - point_).norm(), 1e-6);
  EXPECT_EQ(target->used.size(), 8U);
  EXPECT_FALSE(target->second_point_in_map);
}

TEST_F(TriangulateTargetTest, SaysHowSureItIs) {
  // Mean of the squared normalised error over many draws: 3, and with 400 draws to 0.35 (3 sigma).
  double sum = 0.0;
  bounds_.min_sigma_px = 1e-6;
  constexpr int kDraws = 400;
  for (int i = 0; i < kDraws; ++i) {
    const auto target = Triangulate(See(point_, 0.3, i + 1));
    ASSERT_TRUE(target);
    const Eigen::Vector3d error = target->point_in_map - point_;
    sum += error.dot(target->covariance.ldlt().solve(error));
  }
  // Raised where the scatter is larger than expected, never lowered: a little below 3.
  EXPECT_LT(sum / kDraws, 3.35);
  EXPECT_GT(sum / kDraws, 2.0);
}

TEST_F(TriangulateTargetTest, LeavesMisreadSightingsOut) {
  std::vector<TargetSighting> sightings = See(point_, 0.1);
  sightings[2].pixel += Eigen::Vector2d(300, 40);
  sightings[5].pixel += Eigen::Vector2d(-20, 150);
  sightings[6].pixel += Eigen::Vector2d(90, -80);
  const auto target = Triangulate(sightings);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->used, (std::vector<int>{0, 1, 3, 4, 7}));
  EXPECT_LT((target->point_in_map - point_).norm(), 2e-3);  // 0.1 px are 0.4 mm at 10 m.
  EXPECT_FALSE(target->second_point_in_map);
}

TEST_F(TriangulateTargetTest, TakesOneSightingOfAPhoto) {
  std::vector<TargetSighting> sightings = See(point_, 0.1);
  for (std::size_t i = 0; i < 3; ++i) {
    sightings.push_back(sightings[i]);
    sightings.back().pixel += Eigen::Vector2d(2.0, 100.0 * static_cast<double>(i));
  }
  const auto target = Triangulate(sightings);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->used.size(), 8U);
  EXPECT_LT((target->point_in_map - point_).norm(), 2e-3);
}

TEST_F(TriangulateTargetTest, NoticesAnIdThatIsThereTwice) {
  const Eigen::Vector3d second(-1.5, 0.0, 0.4);
  std::vector<TargetSighting> sightings = See(point_, 0.1);
  const std::vector<TargetSighting> of_second = See(second, 0.1, 2);
  sightings.insert(sightings.end(), of_second.begin() + 3, of_second.end());
  const auto target = Triangulate(sightings);
  ASSERT_TRUE(target);
  EXPECT_LT((target->point_in_map - point_).norm(), 2e-3);
  ASSERT_TRUE(target->second_point_in_map);
  EXPECT_LT((*target->second_point_in_map - second).norm(), 5e-3);
}

TEST_F(TriangulateTargetTest, NeedsTwoPhotosWithParallax) {
  const std::vector<TargetSighting> sightings = See(point_, 0.0);
  EXPECT_FALSE(Triangulate({}));
  EXPECT_FALSE(Triangulate({sightings[0]}));
  EXPECT_FALSE(Triangulate({sightings[0], sightings[0]}));
  EXPECT_TRUE(Triangulate({sightings[0], sightings[1]}));
  bounds_.min_parallax_deg = 10.0;  // Neighbours: 0.9 m before 10 m, 5 deg.
  EXPECT_FALSE(Triangulate({sightings[0], sightings[1]}));
  // Rays that do not meet.
  std::vector<TargetSighting> apart = {sightings[0], sightings[7]};
  apart[1].pixel.y() += 200.0;
  EXPECT_FALSE(Triangulate(apart));
}

TEST_F(TriangulateTargetTest, WeighsSightingsByTheirCovariance) {
  std::vector<TargetSighting> sightings = See(point_, 0.0);
  sightings[3].pixel += Eigen::Vector2d(0.0, 3.0);
  sightings[3].covariance_px2 = 100.0 * Eigen::Matrix2d::Identity();
  const auto target = Triangulate(sightings);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->used.size(), 8U);
  EXPECT_LT((target->point_in_map - point_).norm(), 1e-5);
}

}  // namespace
}  // namespace plumb
