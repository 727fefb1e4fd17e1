// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/flight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;

// The pilot does as planned.
FlightLeg ExactLeg() {
  FlightLeg leg;
  leg.pilot = {0.0, 0.0, 0.0, 0, 3, 0, 4, 70.0, 0.0, 0.0};
  return leg;
}

FlightOptions Flying(const FlightLeg& leg) {
  FlightOptions options;
  options.legs = {leg};
  return options;
}

std::vector<PlannedPhoto> Plan(const FlightLeg& leg, std::uint64_t seed = 1) {
  return PlanFlight(Flying(leg), test::MakeCamera(), {20.0, 8.0}, seed);
}

Eigen::Vector3d CenterOf(const PlannedPhoto& photo) {
  return photo.cam_from_world.TargetOriginInSource();
}
Eigen::Vector3d ForwardOf(const PlannedPhoto& photo) {
  return photo.cam_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
}

double SecondsBetween(const PlannedPhoto& a, const PlannedPhoto& b) {
  return 1e-9 * static_cast<double>(b.exposure_time.ns - a.exposure_time.ns);
}

std::string ErrorOf(const FlightOptions& options) {
  try {
    PlanFlight(options, test::MakeCamera(), {20.0, 8.0}, 1);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

// Part of a wall's stretch [m] that one photo of the test camera covers, side by side and up.
double WidthAt(double distance_m) { return 4000.0 / 2500.0 * distance_m; }
double HeightAt(double distance_m) { return 3000.0 / 2500.0 * distance_m; }

TEST(PlanFlight, RowsCoverTheWallWithAtLeastTheOverlapAskedFor) {
  FlightLeg leg = ExactLeg();
  leg.distance_m = 4.0;
  leg.x_min_m = -1.0;
  leg.x_max_m = 21.0;
  leg.z_min_m = 0.5;
  leg.z_max_m = 15.0;
  leg.forward_overlap = 0.7;
  leg.side_overlap = 0.5;
  std::set<double> heights;
  double left = 1e9;
  double right = -1e9;
  const std::vector<PlannedPhoto> photos = Plan(leg);
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const Eigen::Vector3d center = CenterOf(photos[i]);
    EXPECT_NEAR(center.y(), -4.0, 1e-12);
    EXPECT_LT((ForwardOf(photos[i]) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
    heights.insert(std::round(1e6 * center.z()) * 1e-6);
    left = std::min(left, center.x());
    right = std::max(right, center.x());
    if (i == 0) continue;
    const Eigen::Vector3d step = center - CenterOf(photos[i - 1]);
    // Back and forth: the next row begins where this one ends.
    EXPECT_LE(std::abs(step.x()), step.z() == 0.0 ? 0.3 * WidthAt(4.0) + 1e-9 : 1e-9);
  }
  EXPECT_NEAR(left, -1.0 + 0.5 * WidthAt(4.0), 1e-9);
  EXPECT_NEAR(right, 21.0 - 0.5 * WidthAt(4.0), 1e-9);
  EXPECT_NEAR(*heights.begin(), 0.5 + 0.5 * HeightAt(4.0), 1e-6);
  EXPECT_NEAR(*heights.rbegin(), 15.0 - 0.5 * HeightAt(4.0), 1e-6);
  for (auto height = std::next(heights.begin()); height != heights.end(); ++height) {
    EXPECT_LE(*height - *std::prev(height), 0.5 * HeightAt(4.0) + 1e-5);
  }
}

TEST(PlanFlight, GivesExactlySoManyPhotosAlsoWithGaps) {
  FlightLeg leg = ExactLeg();
  leg.num_photos = 83;
  EXPECT_EQ(Plan(leg).size(), 83U);
  leg.pilot.num_gaps = 3;
  leg.pilot.gap_photos = 4;
  const std::vector<PlannedPhoto> photos = Plan(leg);
  EXPECT_EQ(photos.size(), 83U);
  int num_jumps = 0;
  for (std::size_t i = 1; i < photos.size(); ++i) {
    const double waited_s = SecondsBetween(photos[i - 1], photos[i]);
    if (waited_s > 4.5) ++num_jumps;
  }
  EXPECT_EQ(num_jumps, 3);
}

TEST(PlanFlight, ObliquePhotosLookAtThePlacesOfTheStraightOnes) {
  FlightLeg leg = ExactLeg();
  const std::vector<PlannedPhoto> straight = Plan(leg);
  leg.yaw_deg = 25.0;
  leg.pitch_deg = 10.0;
  const std::vector<PlannedPhoto> oblique = Plan(leg);
  ASSERT_EQ(straight.size(), oblique.size());
  for (std::size_t i = 0; i < straight.size(); ++i) {
    const Eigen::Vector3d center = CenterOf(oblique[i]);
    const Eigen::Vector3d forward = ForwardOf(oblique[i]);
    const Eigen::Vector3d seen = center - center.y() / forward.y() * forward;
    const Eigen::Vector3d wanted(CenterOf(straight[i]).x(), 0.0, CenterOf(straight[i]).z());
    EXPECT_LT((seen - wanted).norm(), 1e-9);
    EXPECT_LT(forward.x(), 0.0);  // Turned left.
    EXPECT_NEAR(std::asin(forward.z()) * kDegPerRad, 10.0, 1e-9);
  }
}

TEST(PlanFlight, OrbitFacesTheBuildingAllTheWayAndCloses) {
  FlightLeg leg = ExactLeg();
  leg.kind = "orbit";
  leg.distance_m = 5.0;
  leg.z_max_m = 3.0;
  leg.max_turn_deg = 9.0;
  const std::vector<PlannedPhoto> photos = Plan(leg);
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const Eigen::Vector3d center = CenterOf(photos[i]);
    const Eigen::Vector3d nearest(
        std::clamp(center.x(), 0.0, 20.0), std::clamp(center.y(), 0.0, 8.0), center.z());
    EXPECT_NEAR((nearest - center).norm(), 5.0, 1e-9);
    EXPECT_LT((ForwardOf(photos[i]) - (nearest - center) / 5.0).norm(), 1e-9) << i;
    const PlannedPhoto& next = photos[(i + 1) % photos.size()];
    EXPECT_LT((CenterOf(next) - center).norm(), 0.25 * WidthAt(5.0) + 1e-9);
    EXPECT_LT(std::acos(std::min(1.0, ForwardOf(next).dot(ForwardOf(photos[i])))) * kDegPerRad,
              9.01);
  }
}

TEST(PlanFlight, HoverTurnsOnTheSpot) {
  FlightLeg leg = ExactLeg();
  leg.kind = "hover";
  leg.num_photos = 9;
  leg.sweep_deg = 40.0;
  const std::vector<PlannedPhoto> photos = Plan(leg);
  ASSERT_EQ(photos.size(), 9U);
  for (const PlannedPhoto& photo : photos) {
    EXPECT_LT((CenterOf(photo) - Eigen::Vector3d(5.0, -6.0, 4.0)).norm(), 1e-12);
    EXPECT_EQ(photo.velocity_in_cam_m_s.norm(), 0.0);
  }
  EXPECT_NEAR(
      ForwardOf(photos.front()).dot(ForwardOf(photos.back())), std::cos(40.0 / kDegPerRad), 1e-12);
}

TEST(PlanFlight, WaypointsAreReached) {
  FlightLeg leg = ExactLeg();
  leg.kind = "waypoints";
  leg.waypoints = {
      {0.0, 10.0, 2.0, 0.0, 0.0}, {0.0, 4.0, 2.0, 0.0, 0.0}, {8.0, 4.0, 5.0, 30.0, 0.0}};
  const std::vector<PlannedPhoto> photos = Plan(leg);
  EXPECT_LT((CenterOf(photos.front()) - Eigen::Vector3d(0.0, -10.0, 2.0)).norm(), 1e-9);
  EXPECT_LT((CenterOf(photos.back()) - Eigen::Vector3d(8.0, -4.0, 5.0)).norm(), 1e-9);
  EXPECT_GT(photos.size(), 8U);
}

// Law: the velocity that blurs a photo is that of the way from photo to photo.
TEST(PlanFlight, TimesAreThoseOfAMavThatFliesAtItsSpeed) {
  FlightLeg leg = ExactLeg();
  leg.speed_m_s = 2.0;
  leg.distance_m = 10.0;
  leg.x_max_m = 40.0;
  const std::vector<PlannedPhoto> photos = Plan(leg);
  const double step_m = (CenterOf(photos[1]) - CenterOf(photos[0])).norm();
  const double step_s = SecondsBetween(photos[0], photos[1]);
  EXPECT_NEAR(step_m / step_s, 2.0, 1e-6);
  EXPECT_NEAR(photos[1].velocity_in_cam_m_s.x(), 2.0, 1e-6);
  leg.min_interval_s = 10.0;
  const std::vector<PlannedPhoto> slow = Plan(leg);
  EXPECT_EQ(slow[1].exposure_time.ns - slow[0].exposure_time.ns, 10'000'000'000);
  EXPECT_NEAR(slow[1].velocity_in_cam_m_s.x(), step_m / 10.0, 1e-9);
  leg.stop_to_shoot = true;
  EXPECT_EQ(Plan(leg)[1].velocity_in_cam_m_s.norm(), 0.0);
}

TEST(PlanFlight, JitterHasItsSizeAndItsSeed) {
  FlightLeg leg = ExactLeg();
  leg.num_photos = 600;
  const std::vector<PlannedPhoto> planned = Plan(leg);
  leg.pilot.position_jitter_m = 0.2;
  const std::vector<PlannedPhoto> flown = Plan(leg);
  double sum2 = 0.0;
  for (std::size_t i = 0; i < flown.size(); ++i) {
    sum2 += (CenterOf(flown[i]) - CenterOf(planned[i])).squaredNorm() / 3.0;
  }
  EXPECT_NEAR(std::sqrt(sum2 / static_cast<double>(flown.size())), 0.2, 0.02);
  EXPECT_EQ(CenterOf(Plan(leg)[7]), CenterOf(flown[7]));
  EXPECT_NE(CenterOf(Plan(leg, 2)[0]), CenterOf(flown[0]));
}

TEST(PlanFlight, WrongTurnsLookAwayAndComeBack) {
  FlightLeg leg = ExactLeg();
  leg.num_photos = 60;
  leg.pilot.num_wrong_turns = 2;
  leg.pilot.wrong_turn_photos = 3;
  const std::vector<PlannedPhoto> photos = Plan(leg);
  int num_away = 0;
  for (const PlannedPhoto& photo : photos) num_away += ForwardOf(photo).y() < 0.9 ? 1 : 0;
  EXPECT_EQ(num_away, 6);
  EXPECT_GT(ForwardOf(photos.front()).y(), 0.999);
  EXPECT_GT(ForwardOf(photos.back()).y(), 0.999);
}

TEST(PlanFlight, NamesPhotosByTimeAndRow) {
  FlightOptions options;
  options.legs = {ExactLeg(), ExactLeg()};
  options.legs[0].row = "10m";
  const std::vector<PlannedPhoto> photos = PlanFlight(options, test::MakeCamera(), {20.0, 8.0}, 1);
  EXPECT_EQ(photos.front().name, "0001_10m.jpg");
  EXPECT_EQ(photos.back().name, "0008.jpg");
  for (std::size_t i = 1; i < photos.size(); ++i) {
    EXPECT_LT(photos[i - 1].exposure_time, photos[i].exposure_time);
  }
}

TEST(PlanFlight, SaysWhatIsImpossible) {
  FlightOptions options;
  EXPECT_THAT(ErrorOf(options), HasSubstr("legs must be at least one"));
  options = Flying(ExactLeg());
  options.legs[0].forward_overlap = 1.0;
  options.legs[0].pilot.gap_photos = 0;
  EXPECT_THAT(ErrorOf(options),
              AllOf(HasSubstr("legs[0].forward_overlap must be in [0, 0.98], but is 1"),
                    HasSubstr("legs[0].pilot.gap_photos")));
  options = Flying(ExactLeg());
  options.legs[0].num_photos = 2;
  options.legs[0].x_max_m = 100.0;
  EXPECT_THAT(ErrorOf(options),
              AllOf(HasSubstr("flight.legs[0]: num_photos of 2"), HasSubstr("at least")));
  options = Flying(ExactLeg());
  options.legs[0].pilot.num_wrong_turns = 30;
  EXPECT_THAT(ErrorOf(options), HasSubstr("pilot.num_wrong_turns of 30 does not fit"));
  options = Flying(ExactLeg());
  options.start_time = "2026-02-30T10:00:00";
  EXPECT_THAT(ErrorOf(options), HasSubstr("start_time"));
}

}  // namespace
}  // namespace plumb
