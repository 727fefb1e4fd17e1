// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How a map begins, and how it begins again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "test/sfm/equal_deltas.h"
#include "test/sfm/mapper_flight.h"

namespace plumb {
namespace {

using test::Flight;
using test::RowOfTwelve;
using test::Scene;
using test::SceneOptions;
using test::ScenePhoto;

constexpr double kMaxCenterError_m = 0.05;

// Photos of a yard, from the car to the start of the flight.
std::vector<ScenePhoto> PhotosOfTheYard() {
  SceneOptions options;
  options.num_points = 500;
  options.noise_px = 0.5;
  options.random_seed = 77;
  return test::MakeScenePhotos(MakeScene(options), /*seed=*/77);
}

TEST(MapperStart, WaitsWhileTheCameraOnlyTurns) {
  SceneOptions options = RowOfTwelve();
  options.spacing_m = 0.0;
  options.num_cameras = 5;
  Flight hover(options);
  hover.AddFirst(5);
  for (std::uint32_t id = 1; id < 5; ++id) {
    EXPECT_EQ(hover.verdict(id).status, VerdictStatus::kWaiting) << id;
    EXPECT_EQ(hover.verdict(id).reason, RefusalReason::kNoParallax) << id;
    EXPECT_THAT(hover.verdict(id).hint, testing::HasSubstr("sideways"));
  }
  EXPECT_TRUE(hover.map().views().empty());
  EXPECT_TRUE(hover.heard().deltas.empty());
  hover.mapper().Finish();
  EXPECT_TRUE(hover.map().views().empty());
  for (std::uint32_t id = 1; id < 5; ++id) {
    EXPECT_EQ(hover.verdict(id).status, VerdictStatus::kRefused) << id;
    EXPECT_EQ(hover.verdict(id).reason, RefusalReason::kNoParallax) << id;
  }
}

TEST(MapperStart, SaysWhatIsMissingWhenOnePhotoIsAll) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(1);
  flight.mapper().Finish();
  EXPECT_EQ(flight.verdict(0).status, VerdictStatus::kRefused);
  EXPECT_THAT(flight.verdict(0).hint, testing::HasSubstr("a second one"));
  EXPECT_THAT(flight.verdict(0).hint, testing::HasSubstr("to the side"));
}

TEST(MapperStart, SaysWhatIsMissingWhenNoTwoPhotosOverlap) {
  Flight flight(RowOfTwelve());
  flight.Add(0);
  flight.Add(9);
  flight.mapper().Finish();
  EXPECT_TRUE(flight.map().views().empty());
  for (const std::uint32_t id : {0U, 9U}) {
    EXPECT_EQ(flight.verdict(id).reason, RefusalReason::kNoOverlap) << id;
    EXPECT_THAT(flight.verdict(id).hint, testing::Not(testing::HasSubstr("of the model")));
    EXPECT_THAT(flight.verdict(id).hint, testing::HasSubstr("to the side"));
  }
}

TEST(MapperStart, TakesInThePhotosOfTheHoverOnceTheCameraMoves) {
  SceneOptions options = RowOfTwelve();
  options.num_cameras = 3;
  options.spacing_m = 0.02;
  Flight flight(options);
  flight.AddFirst(3);
  ASSERT_TRUE(flight.map().views().empty());
  options.num_cameras = 5;
  options.spacing_m = 2.5;
  const std::vector<ScenePhoto> moved = test::MakeScenePhotos(MakeScene(options));
  for (std::uint32_t i = 0; i < 5; ++i) {
    flight.mapper().Add(test::MakeMapperPhoto(10 + i, moved[i].features));
  }
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 8);
}

TEST(MapperStart, ReplacesAFirstPairThatShowsSomethingElse) {
  Flight flight(RowOfTwelve());
  const std::vector<ScenePhoto> yard = PhotosOfTheYard();
  for (std::uint32_t i = 0; i < 2; ++i) {
    flight.mapper().Add(test::MakeMapperPhoto(100 + i, yard[i].features));
  }
  ASSERT_EQ(flight.map().views().size(), 2U);
  for (std::uint32_t id = 0; id < 12; ++id) flight.AddAs(200 + id, id);
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_FALSE(flight.map().HasView({100}));
  EXPECT_LT(flight.LargestCenterError(), 2.0 * kMaxCenterError_m);

  flight.mapper().Finish();
  EXPECT_LT(flight.LargestCenterError(), kMaxCenterError_m);
  EXPECT_EQ(flight.heard().latest.size(), 14U);  // None is lost.
  for (const std::uint32_t id : {100U, 101U}) {
    EXPECT_EQ(flight.verdict(id).status, VerdictStatus::kRefused);
    EXPECT_EQ(flight.verdict(id).reason, RefusalReason::kNoOverlap);
  }
  // Listeners followed the change.
  EXPECT_EQ(flight.heard().replica.views().size(), 12U);
  test::ExpectEqual(flight.heard().replica.Snapshot(), flight.map().Snapshot());
}

TEST(MapperStart, KeepsTheFacadeWhenTwoPhotosShowSomethingElse) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(3);
  const std::vector<ScenePhoto> yard = PhotosOfTheYard();
  for (std::uint32_t i = 0; i < 2; ++i) {
    flight.mapper().Add(test::MakeMapperPhoto(100 + i, yard[i].features));
  }
  for (std::size_t camera = 3; camera < 12; ++camera) flight.Add(camera);
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_EQ(flight.verdict(100).status, VerdictStatus::kRefused);
  EXPECT_EQ(flight.verdict(101).status, VerdictStatus::kRefused);
}

TEST(MapperStart, GivesAPairOfLittleParallaxUpForABetterOne) {
  // Two photos 0.45 m apart at 10 m, the others 2.5 m apart.
  SceneOptions options = RowOfTwelve();
  options.num_cameras = 2;
  options.spacing_m = 0.45;
  Flight flight(options);
  flight.AddFirst(2);
  ASSERT_EQ(flight.map().views().size(), 2U);
  options.num_cameras = 4;
  options.spacing_m = 2.5;
  const std::vector<ScenePhoto> apart = test::MakeScenePhotos(MakeScene(options));
  for (std::uint32_t i = 0; i < 4; ++i) {
    flight.mapper().Add(test::MakeMapperPhoto(10 + i, apart[i].features));
  }
  const std::vector<MapDelta>& deltas = flight.heard().deltas;
  EXPECT_TRUE(std::any_of(deltas.begin(), deltas.end(), [](const MapDelta& delta) {
    return !delta.views_removed.empty();
  }));
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 6);
}

}  // namespace
}  // namespace plumb
