// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/marker_floor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <set>

#include "plumbline/marker/marker_detector.h"
#include "plumbline/simulation/photographer.h"

namespace plumb {
namespace {

Scenario SmallFloor() {
  Scenario scenario;
  scenario.floor.num_photos = 4;
  scenario.lens.width_px = 900;
  scenario.lens.height_px = 600;
  scenario.lens.cx_offset_px = 2.0;
  scenario.lens.cy_offset_px = -1.0;
  return scenario;
}

TEST(MarkerFloor, LaysSixteenMarkersApartFromOneAnother) {
  for (const char* grid : {"", "a4", "a3"}) {
    SCOPED_TRACE(grid);
    MarkerFloorOptions options;
    options.num_photos = 1;
    options.fixed_grid = grid;
    options.first_id = 20;
    const World world = BuildMarkerFloor(options);
    ASSERT_EQ(world.plates.size(), 16U);
    std::set<int> ids;
    for (const Plate& plate : world.plates) {
      ids.insert(plate.id);
      EXPECT_GT(plate.world_from_plate.translation.z(), 0.0);
      for (const Plate& other : world.plates) {
        if (other.id == plate.id) continue;
        EXPECT_GE((plate.world_from_plate.translation - other.world_from_plate.translation).norm(),
                  plate.side_m);
      }
    }
    EXPECT_EQ(*ids.begin(), 20);
    EXPECT_EQ(ids.size(), 16U);
  }
}

TEST(MarkerFloor, BendsTheSheetByAsMuchAsIsAsked) {
  MarkerFloorOptions options;
  options.num_photos = 1;
  options.fixed_grid = "a4";
  options.bend_m = 0.003;
  double low = 1.0;
  double high = 0.0;
  for (const Plate& plate : BuildMarkerFloor(options).plates) {
    low = std::min(low, plate.world_from_plate.translation.z());
    high = std::max(high, plate.world_from_plate.translation.z());
  }
  EXPECT_GT(high - low, 0.001);
  EXPECT_LT(high - low, 0.003);
}

// The truth that a calibration is held against: a marker is seen where its plate's middle lies.
TEST(MarkerFloor, PhotosShowTheMarkersWhereTheyLie) {
  const Scenario scenario = SmallFloor();
  const Photographer photographer(scenario);
  ASSERT_EQ(photographer.photos().size(), 4U);
  int num_found = 0;
  for (std::size_t i = 0; i < photographer.photos().size(); ++i) {
    const cv::Mat gray = cv::imdecode(photographer.Take(i, 0), cv::IMREAD_GRAYSCALE);
    for (const MarkerDetection& marker : DetectMarkers({}, gray, &photographer.camera())) {
      const auto plate = std::find_if(photographer.world().plates.begin(),
                                      photographer.world().plates.end(),
                                      [&](const Plate& other) { return other.id == marker.id; });
      ASSERT_NE(plate, photographer.world().plates.end());
      const auto pixel = photographer.camera().Project(photographer.photos()[i].cam_from_world *
                                                       plate->world_from_plate.translation);
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - marker.center_px).norm(), 0.15);
      ++num_found;
    }
  }
  EXPECT_GE(num_found, 32);
}

TEST(MarkerFloor, RefusesWhatCannotBe) {
  MarkerFloorOptions options;
  options.fixed_grid = "a5";
  options.first_id = 100;
  options.spacing_m = 0.1;
  EXPECT_EQ(options.Problems().size(), 3U);
  EXPECT_THROW(BuildMarkerFloor(options), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
