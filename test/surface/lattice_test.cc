// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/lattice.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <tuple>

#include "test/support/random.h"

namespace plumb {
namespace {

TEST(Lattice, PutsAPointWithinHalfAPitchAndKeepsItThere) {
  test::Random random(1);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Eigen::Vector3d point = random.InBox(1000.0);
    const Eigen::Vector3d offset = LatticeOffset(LandmarkId{i});
    const Eigen::Vector3d snapped = Snapped(point, -7, offset);
    EXPECT_LE((snapped - point).cwiseAbs().maxCoeff(), std::ldexp(0.5, -7));
    EXPECT_EQ(Snapped(snapped, -7, offset), snapped);
  }
}

TEST(Lattice, GivesEveryLandmarkItsOwn) {
  std::set<std::tuple<double, double, double>> offsets;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const Eigen::Vector3d offset = LatticeOffset(LandmarkId{i});
    EXPECT_GE(offset.minCoeff(), 0.0);
    EXPECT_LT(offset.maxCoeff(), 1.0);
    offsets.insert({offset.x(), offset.y(), offset.z()});
  }
  EXPECT_EQ(offsets.size(), 100'000U);
}

TEST(Lattice, RoundsDistancesDownToPowersOfTwo) {
  const auto exponent = [](double distance) { return DistanceExponent(distance * distance); };
  EXPECT_EQ(exponent(1.0), 0);
  EXPECT_EQ(exponent(1.9), 0);
  EXPECT_EQ(exponent(2.0), 1);
  EXPECT_EQ(exponent(0.99), -1);
  EXPECT_EQ(exponent(0.5), -1);
  EXPECT_EQ(exponent(0.3), -2);
  EXPECT_EQ(exponent(5.0), 2);
}

TEST(Lattice, HasNoPitchTooFineForThePoint) {
  const Eigen::Vector3d far(1e9, 0, 0);
  const int pitch_exponent = PitchExponent(/*distance_exponent=*/0, /*bits=*/10, far);
  EXPECT_LE(far.x() / std::ldexp(1.0, pitch_exponent), std::ldexp(1.0, 30));
  EXPECT_EQ(PitchExponent(2, 10, {20, 3, 1}), -8);
  EXPECT_EQ(PitchExponent(2, 10, Eigen::Vector3d::Zero()), -8);
}

TEST(Lattice, KnowsWhatItCannotHold) {
  EXPECT_TRUE(IsUsable({1e6, -1e6, 0}));
  EXPECT_FALSE(IsUsable({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_FALSE(IsUsable({0, std::numeric_limits<double>::infinity(), 0}));
  EXPECT_FALSE(IsUsable({0, 0, -1e120}));
}

}  // namespace
}  // namespace plumb
