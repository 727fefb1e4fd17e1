// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Control points given to a mapper in flight.
#include <gtest/gtest.h>

#include "test/sfm/map_invariants.h"
#include "test/sfm/mapper_flight.h"

namespace plumb {
namespace {

using test::Flight;
using test::RowOfTwelve;
using test::Scene;

constexpr double kMarkerSigma_px = 0.05;
constexpr double kSurveySigma_m = 0.001;

// Twelve along the facade, alternately high and low, as the scene has them: in metres, in a frame
// that no map has.
BundleConstraints ControlPoints(const Scene& scene) {
  BundleConstraints constraints;
  for (int i = 0; i < 12; ++i) {
    MarkerTrack track;
    track.marker_id = i;
    track.position_in_map = {-16.5 + 3.0 * i, 0.1 * (i % 3), i % 2 == 0 ? 2.0 : -2.0};
    track.survey = MeasuredPosition{track.position_in_map, kSurveySigma_m};
    for (std::uint32_t k = 0; k < scene.cams_from_map.size(); ++k) {
      const auto pixel = scene.camera.Project(scene.cams_from_map[k] * track.position_in_map);
      if (!pixel || !scene.camera.IsInImage(*pixel)) continue;
      track.sightings.push_back({{k}, *pixel, kMarkerSigma_px});
    }
    track.sightings.push_back({{999}, {10.0, 10.0}, kMarkerSigma_px});  // Of a photo not located.
    constraints.markers.push_back(track);
  }
  return constraints;
}

TEST(MapperConstraints, HoldTheMapWhateverFrameTheyWereGivenIn) {
  Flight alone(RowOfTwelve());
  alone.AddFirst(12);
  alone.mapper().Finish();
  Flight held(RowOfTwelve());
  held.AddFirst(8);
  held.mapper().SetConstraints(ControlPoints(held.scene()));
  for (const std::size_t camera : {8U, 9U, 10U, 11U}) held.Add(camera);
  held.mapper().Finish();
  EXPECT_EQ(test::ContradictionIn(held.map()), "");
  EXPECT_EQ(held.heard().NumAccepted(), 12);
  EXPECT_LT(held.LargestCenterError(), 0.9 * alone.LargestCenterError());
}

TEST(MapperConstraints, AreReplacedByNone) {
  Flight alone(RowOfTwelve());
  alone.AddFirst(12);
  alone.mapper().Finish();
  Flight freed(RowOfTwelve());
  freed.mapper().SetConstraints(ControlPoints(freed.scene()));
  freed.mapper().SetConstraints({});
  freed.AddFirst(12);
  freed.mapper().Finish();
  EXPECT_EQ(freed.LargestCenterError(), alone.LargestCenterError());
}

}  // namespace
}  // namespace plumb
