// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/gaps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plumbline/quality/quality_map.h"
#include "test/quality/quality_scene.h"

namespace plumb {
namespace {

using Vector = Eigen::Vector3d;

// A wall of 12 m x 4 m and photos before it, from 5 m: 6 m x 4 m each.
class Gaps : public testing::Test {
 protected:
  Gaps() {
    test::AddGrid({0, 0, 0}, {12, 0, 0}, {0, 0, 4}, 48, 16, &soup_);
    map_.SetCamera(test::SmallCamera());
  }

  void Photograph(const Vector& eye) {
    const auto photo = static_cast<std::uint32_t>(delta_.views_set.size());
    delta_.views_set.push_back(test::MakeView(photo, test::LookAt(eye, eye + Vector(0, 1, 0))));
  }

  void PhotographLeftOf(double x_end) {
    for (double x = 0.0; x < x_end - 2.9; x += 0.7) Photograph({x, -5, 2});
  }

  std::vector<Gap> Find() {
    delta_.is_snapshot = true;
    map_.Apply(delta_, test::SnapshotOf(soup_));
    return FindGaps(options_, map_.blocks(), measure_, 1.0);
  }

  test::Soup soup_;
  MapDelta delta_;
  QualityMap map_{QualityOptions()};
  GapOptions options_ = [] {
    GapOptions options;
    options.wanted_gsd_mm = 12.0;  // 5 m with 500 px gives 10 mm, and more off the axis.
    return options;
  }();
  Measure measure_{1.0, 500.0, 0.5, /*half_photo_px=*/200.0};
};

TEST_F(Gaps, AreNoneWhereThereAreEnoughFinePhotos) {
  for (double x = -2.0; x < 15.0; x += 0.7) Photograph({x, -5, 2});
  EXPECT_THAT(Find(), testing::IsEmpty());
}

TEST_F(Gaps, AreWhereTooFewPhotosSee) {
  PhotographLeftOf(8.0);
  const std::vector<Gap> gaps = Find();
  ASSERT_THAT(gaps, testing::Not(testing::IsEmpty()));
  for (const Gap& gap : gaps) {
    EXPECT_GT(gap.center_in_map.x(), 4.0);
    EXPECT_NEAR(gap.normal_in_map.y(), -1.0, 1e-6);
    EXPECT_GT(gap.share_unsure, 0.9);
    EXPECT_LT(gap.num_views, 3);
    const double distance = (gap.camera_in_map - gap.center_in_map).norm();
    EXPECT_LE(gap.area, M_PI * std::pow(measure_.PhotoRadiusAt(distance), 2));
  }
}

TEST_F(Gaps, AreNoneWhereNoCameraLooks) {  // The wall's end, and its back.
  PhotographLeftOf(6.0);
  test::AddGrid({0, 0.3, 0}, {0, 0, 4}, {12, 0, 0}, 16, 48, &soup_);
  for (const Gap& gap : Find()) {
    EXPECT_LT(gap.center_in_map.y(), 0.2);
    EXPECT_LT(gap.center_in_map.x(), 8.0);
  }
}

// Law: who follows the advice closes the gap.
TEST_F(Gaps, AreClosedByPhotosFromWhereTheySay) {
  PhotographLeftOf(6.0);
  Photograph({8.5, -9, 2});  // Too coarse, and alone.
  std::vector<Gap> gaps = Find();
  int num_rounds = 0;
  for (; !gaps.empty() && num_rounds < 12; ++num_rounds) {
    for (const Gap& gap : gaps) {
      for (const double aside : {-0.4, 0.0, 0.4}) {
        Photograph(gap.camera_in_map + Vector(aside, 0, 0));
      }
    }
    gaps = Find();
  }
  EXPECT_THAT(gaps, testing::IsEmpty());
  EXPECT_LE(num_rounds, 4);
}

TEST_F(Gaps, AreWhereThePhotosAreTooCoarse) {
  for (double x = -4.0; x < 16.0; x += 0.7) Photograph({x, -8, 2});
  const std::vector<Gap> gaps = Find();
  ASSERT_THAT(gaps, testing::Not(testing::IsEmpty()));
  EXPECT_EQ(gaps[0].share_unsure, 0.0);
  EXPECT_NEAR(gaps[0].gsd, 16.0, 1.5);
  EXPECT_NEAR((gaps[0].camera_in_map - gaps[0].center_in_map).norm(), 0.85 * 6.0, 1e-6);  // 12 mm.
  for (std::size_t i = 1; i < gaps.size(); ++i) EXPECT_LE(gaps[i].area, gaps[i - 1].area);
  options_.max_gaps = 2;
  EXPECT_EQ(Find().size(), 2U);
  options_.wanted_gsd_mm = 40.0;
  EXPECT_THAT(Find(), testing::IsEmpty());
}

// 0.5 mm would take 0.2 m.
TEST_F(Gaps, NeverAskForAPhotoFromTooNear) {
  for (double x = -4.0; x < 16.0; x += 0.7) Photograph({x, -8, 2});
  options_.wanted_gsd_mm = 0.5;
  options_.min_distance_m = 3.0;
  const double finest_mm = 1000.0 * 3.0 / 500.0 / 0.85;
  EXPECT_NEAR(WantedGsd(options_, measure_), finest_mm, 1e-9);
  const std::vector<Gap> gaps = Find();
  ASSERT_THAT(gaps, testing::Not(testing::IsEmpty()));
  for (const Gap& gap : gaps) {
    EXPECT_NEAR((gap.camera_in_map - gap.center_in_map).norm(), 3.0, 1e-9);
  }
  EXPECT_THAT(Problem(gaps[0], options_, measure_), testing::HasSubstr("instead of 7.1 mm"));
  measure_.metres_per_map_unit = std::nullopt;  // The first photos: from 10 units.
  options_.wanted_relative_gsd = 0.01;
  options_.min_relative_distance = 0.25;
  EXPECT_NEAR(LeastDistance(options_, measure_), 2.5, 1e-9);
  EXPECT_NEAR(WantedGsd(options_, measure_), 0.25 / 0.85, 1e-9);
}

// There were photos from nearer than a gap may ask for.
TEST_F(Gaps, AskForMorePhotosFromTheLeastDistanceWhereOthersWereNearer) {
  for (double x = 0.0; x < 3.0; x += 2.0) Photograph({x, -1, 2});
  options_.min_distance_m = 3.0;
  for (const Gap& gap : Find()) {
    EXPECT_GE((gap.camera_in_map - gap.center_in_map).norm(), 3.0 - 1e-9);
  }
}

Gap MakeGap(double x, double area) {
  Gap gap;
  gap.center_in_map = {x, 0, 0};
  gap.normal_in_map = {0, -1, 0};
  gap.area = area;
  return gap;
}

std::vector<double> PlacesOf(const std::vector<Gap>& gaps) {
  std::vector<double> places;
  for (const Gap& gap : gaps) places.push_back(gap.center_in_map.x());
  return places;
}

TEST(KeepFirst, PutsTheGapFirstThatWasFirstBefore) {
  std::vector<Gap> gaps = {MakeGap(20, 5), MakeGap(10, 4), MakeGap(0.5, 3)};
  KeepFirst(MakeGap(0, 4), &gaps);
  EXPECT_THAT(PlacesOf(gaps), testing::ElementsAre(0.5, 20, 10));
}

TEST(KeepFirst, LetsALargerOneBeFirst) {
  std::vector<Gap> gaps = {MakeGap(20, 5), MakeGap(0.5, 2)};
  KeepFirst(MakeGap(0, 4), &gaps);
  EXPECT_THAT(PlacesOf(gaps), testing::ElementsAre(20, 0.5));
}

TEST(KeepFirst, LetsGoOfAGapThatIsClosedOrTurnedElsewhere) {
  std::vector<Gap> gaps = {MakeGap(20, 5), MakeGap(10, 4), MakeGap(0.5, 3)};
  gaps[2].normal_in_map = {1, 0, 0};
  KeepFirst(MakeGap(0, 4), &gaps);
  KeepFirst(MakeGap(13, 4), &gaps);
  EXPECT_THAT(PlacesOf(gaps), testing::ElementsAre(20, 10, 0.5));
  std::vector<Gap> none;
  KeepFirst(MakeGap(0, 4), &none);
  EXPECT_THAT(none, testing::IsEmpty());
}

// A wall that is too coarse all over takes as many gaps as photos, not as blocks.
TEST_F(Gaps, AreAsLargeAsAPhotoTakesIn) {
  for (double x = -4.0; x < 16.0; x += 0.7) Photograph({x, -8, 2});
  measure_.half_photo_px = 300.0;  // 3.1 m around the middle, from 5.1 m.
  // Of 12 m x 4 m, 48 blocks: two or three whole circles, and what they leave at the ends.
  EXPECT_LE(Find().size(), 6U);
  measure_.half_photo_px = 60.0;  // 0.6 m: no second block.
  options_.max_gaps = 100;
  for (const Gap& gap : Find()) EXPECT_LE(gap.area, 1.0 + 1e-6);
}

TEST_F(Gaps, AreNotToldBesideMuchLargerOnes) {
  PhotographLeftOf(8.0);
  options_.min_share_of_largest = 0.0;
  const std::vector<Gap> all = Find();
  options_.min_share_of_largest = 0.8;
  const std::vector<Gap> large = Find();
  EXPECT_LT(large.size(), all.size());
  ASSERT_FALSE(large.empty());
  EXPECT_EQ(large[0].area, all[0].area);
  EXPECT_GE(large.back().area, 0.8 * large[0].area);
  EXPECT_LT(all[large.size()].area, 0.8 * all[0].area);
}

TEST_F(Gaps, DoNotJoinWhatDoesNotHangTogether) {
  for (double x = -2.0; x < 15.0; x += 0.7) Photograph({x, -5, 2});
  for (const double x : {4.0, 7.0}) {  // Lids, 3 m apart.
    test::AddGrid({x, -0.01, 1.5}, {0.9, 0, 0}, {0, 0, 0.9}, 1, 1, &soup_);
  }
  options_.min_area_share = 0.3;
  const std::vector<Gap> gaps = Find();
  ASSERT_EQ(gaps.size(), 2U);
  for (const Gap& gap : gaps) {
    EXPECT_LT(std::abs(std::abs(gap.center_in_map.x() - 5.95) - 1.5), 0.3);
  }
}

TEST_F(Gaps, OfAMapThatIsNotMetricCompareWithTheFirstPhotos) {
  measure_.metres_per_map_unit.reset();
  for (double x = -6.0; x < 18.0; x += 0.7) Photograph({x, -13, 2});
  EXPECT_THAT(Find(), testing::IsEmpty());  // 1.3 of 10 units, 1.5 are wanted.
  options_.wanted_relative_gsd = 1.0;
  const std::vector<Gap> gaps = Find();
  ASSERT_THAT(gaps, testing::Not(testing::IsEmpty()));
  EXPECT_NEAR((gaps[0].camera_in_map - gaps[0].center_in_map).norm(), 0.85 * 10.0, 1e-6);
}

TEST_F(Gaps, DoNotComeFromSingleSmallFaces) {
  for (double x = -2.0; x < 15.0; x += 0.7) Photograph({x, -5, 2});
  // A lid before one face hides it from all.
  test::AddGrid({6.0, -0.01, 2.0}, {0.2, 0, 0}, {0, 0, 0.2}, 1, 1, &soup_);
  EXPECT_THAT(Find(), testing::IsEmpty());
  options_.min_area_share = 0.001;
  EXPECT_EQ(Find().size(), 1U);
}

Gap MakeGap() {
  Gap gap;
  gap.center_in_map = {10, 0, 2};
  gap.normal_in_map = {0, -1, 0};
  gap.camera_in_map = {10, -4, 2};
  gap.num_views = 1;
  gap.share_unsure = 1.0;
  gap.gsd = 8.0;
  return gap;
}

TEST(Advice, SaysHowFarAndWhichWay) {
  const Rigid3 cam_from_map = test::LookAt({7, -6, 3}, {7, 0, 3});
  const Measure measure{1.0, 500.0, 0.5};
  EXPECT_EQ(Advice(MakeGap(), GapOptions(), measure, cam_from_map),
            "Only 1 photo sees it. Fly 3.0 m right, 1.0 m down, 2.0 m closer.");
  const Move move = MoveTo(MakeGap(), cam_from_map);
  EXPECT_NEAR(move.right, 3.0, 1e-9);
  EXPECT_NEAR(move.up, -1.0, 1e-9);
  EXPECT_NEAR(move.forward, 2.0, 1e-9);
}

TEST(Advice, IsInMetresOfTheGroundWhateverTheMapsUnit) {
  const Rigid3 cam_from_map = test::LookAt({7, -6, 3}, {7, 0, 3});
  const Measure measure{10.0, 500.0, 0.5};
  EXPECT_EQ(Advice(MakeGap(), GapOptions(), measure, cam_from_map),
            "Only 1 photo sees it. Fly 30 m right, 10 m down, 20 m closer.");
}

TEST(Advice, IsInDistancesToTheGapWhileTheMapIsNotMetric) {
  const Rigid3 cam_from_map = test::LookAt({10, -8, 2}, {10, 0, 2});
  EXPECT_EQ(Advice(MakeGap(), GapOptions(), {std::nullopt, 500.0, 0.5}, cam_from_map),
            "Only 1 photo sees it. Fly 0.5 x closer (x: your distance to it).");
}

TEST(Advice, SaysWhatIsTooCoarseAndNotToMoveWhereOneIsRight) {
  Gap gap = MakeGap();
  gap.share_unsure = 0.2;
  const Rigid3 cam_from_map = test::LookAt({10, -4, 2}, {10, 0, 2});
  EXPECT_EQ(Advice(gap, GapOptions(), {1.0, 500.0, 0.5}, cam_from_map),
            "Too coarse, 8.0 mm instead of 5.0 mm. Take a photo here.");
}

TEST(GapOptions, RefusesNonsense) {
  GapOptions options;
  EXPECT_THAT(options.Problems(), testing::IsEmpty());
  options.wanted_gsd_mm = std::numeric_limits<double>::quiet_NaN();
  options.min_views = 1;
  EXPECT_EQ(options.Problems().size(), 2U);
}

}  // namespace
}  // namespace plumb
