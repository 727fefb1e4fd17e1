// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/map_replica.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

ViewState MakeView(std::uint32_t id) {
  ViewState view;
  view.photo = PhotoId{id};
  view.name = std::to_string(id) + ".jpg";
  return view;
}

ObservationState Observe(std::uint32_t landmark, std::uint32_t photo, std::uint32_t feature) {
  return {LandmarkId{landmark}, PhotoId{photo}, feature, {1.5F, 2.5F}};
}

MapDelta FirstDelta() {
  MapDelta delta;
  delta.sequence = 1;
  delta.views_set = {MakeView(1), MakeView(2), MakeView(3)};
  delta.landmarks_set = {{LandmarkId{7}, {1, 2, 3}, {9, 8, 7}}, {LandmarkId{4}, {0, 0, 1}, {}}};
  delta.observations_added = {
      Observe(7, 1, 0), Observe(7, 2, 5), Observe(7, 3, 1), Observe(4, 1, 2), Observe(4, 2, 2)};
  return delta;
}

TEST(MapReplica, SnapshotHoldsWhatTheDeltasBrought) {
  MapReplica replica;
  ASSERT_TRUE(replica.Apply(FirstDelta()));
  const MapDelta snapshot = replica.Snapshot();
  EXPECT_EQ(snapshot.sequence, 1U);
  EXPECT_TRUE(snapshot.is_snapshot);
  EXPECT_EQ(snapshot.views_set.size(), 3U);
  ASSERT_EQ(snapshot.landmarks_set.size(), 2U);
  EXPECT_EQ(snapshot.landmarks_set[0].id, LandmarkId{4});  // Ascending.
  EXPECT_EQ(snapshot.landmarks_set[1].position_in_map, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(snapshot.observations_added.size(), 5U);
}

TEST(MapReplica, RemovalsOfOneDeltaComeBeforeWhatItSets) {
  MapReplica replica;
  ASSERT_TRUE(replica.Apply(FirstDelta()));
  MapDelta second;
  second.sequence = 2;
  second.landmarks_removed = {LandmarkId{4}};
  second.observations_removed = {Observe(7, 2, 5)};
  second.landmarks_set = {{LandmarkId{7}, {5, 5, 5}, {}}};
  second.observations_added = {Observe(7, 2, 6)};
  ASSERT_TRUE(replica.Apply(second));
  ASSERT_EQ(replica.landmarks().size(), 1U);
  const MapReplica::TrackedLandmark& landmark = replica.landmarks().at(LandmarkId{7});
  EXPECT_EQ(landmark.state.position_in_map, Eigen::Vector3d(5, 5, 5));
  EXPECT_EQ(landmark.pixel_of_feature.count({PhotoId{2}, 5}), 0U);
  EXPECT_EQ(landmark.pixel_of_feature.count({PhotoId{2}, 6}), 1U);
  EXPECT_EQ(landmark.pixel_of_feature.size(), 3U);  // A moved landmark keeps its track.
}

TEST(MapReplica, ARemovedViewTakesItsObservationsAlong) {
  MapReplica replica;
  ASSERT_TRUE(replica.Apply(FirstDelta()));
  MapDelta second;
  second.sequence = 2;
  second.views_removed = {PhotoId{3}};
  ASSERT_TRUE(replica.Apply(second));
  EXPECT_EQ(replica.views().size(), 2U);
  EXPECT_EQ(replica.landmarks().at(LandmarkId{7}).pixel_of_feature.size(), 2U);
}

TEST(MapReplica, RefusesADeltaAfterAGapAndAnOldOneAgain) {
  MapReplica replica;
  ASSERT_TRUE(replica.Apply(FirstDelta()));
  MapDelta third;
  third.sequence = 3;
  third.landmarks_removed = {LandmarkId{7}};
  EXPECT_FALSE(replica.Apply(third));
  EXPECT_FALSE(replica.Apply(FirstDelta()));
  EXPECT_EQ(replica.sequence(), 1U);
  EXPECT_EQ(replica.landmarks().size(), 2U);
}

TEST(MapReplica, ASnapshotReplacesEverythingAndDeltasGoOnFromIt) {
  MapReplica replica;
  ASSERT_TRUE(replica.Apply(FirstDelta()));
  MapDelta snapshot;
  snapshot.sequence = 41;
  snapshot.is_snapshot = true;
  snapshot.views_set = {MakeView(9)};
  ASSERT_TRUE(replica.Apply(snapshot));
  EXPECT_EQ(replica.views().size(), 1U);
  EXPECT_TRUE(replica.landmarks().empty());
  MapDelta next;
  next.sequence = 42;
  EXPECT_TRUE(replica.Apply(next));
}

TEST(MapReplica, ASnapshotOfAReplicaRebuildsIt) {  // Law: round trip.
  MapReplica replica;
  ASSERT_TRUE(replica.Apply(FirstDelta()));
  MapReplica copy;
  ASSERT_TRUE(copy.Apply(replica.Snapshot()));
  const MapDelta a = replica.Snapshot();
  const MapDelta b = copy.Snapshot();
  ASSERT_EQ(a.observations_added.size(), b.observations_added.size());
  for (std::size_t i = 0; i < a.observations_added.size(); ++i) {
    EXPECT_EQ(a.observations_added[i].landmark, b.observations_added[i].landmark);
    EXPECT_EQ(a.observations_added[i].pixel, b.observations_added[i].pixel);
  }
  EXPECT_EQ(a.sequence, b.sequence);
}

}  // namespace
}  // namespace plumb
