// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What holds of a whole session: repeatable, replayable, resumable, in any order.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "test/sfm/equal_deltas.h"
#include "test/sfm/map_invariants.h"
#include "test/sfm/mapper_flight.h"

namespace plumb {
namespace {

using test::ExpectEqual;
using test::Flight;
using test::Recorder;
using test::RowOfTwelve;
using test::SceneOptions;

constexpr double kMaxCenterError_m = 0.05;

void FlyWithAStrayPhoto(Flight* flight) {
  flight->AddFirst(3);
  flight->Add(9);
  flight->mapper().Add(test::MakeForeignPhoto(100));
  for (const std::size_t camera : {3U, 4U, 5U, 6U, 7U, 8U, 10U, 11U}) flight->Add(camera);
  flight->mapper().Finish();
}

TEST(MapperSession, IsTheSameEachTime) {
  Flight first(RowOfTwelve());
  Flight second(RowOfTwelve());
  FlyWithAStrayPhoto(&first);
  FlyWithAStrayPhoto(&second);
  ASSERT_EQ(first.heard().deltas.size(), second.heard().deltas.size());
  for (std::size_t i = 0; i < first.heard().deltas.size(); ++i) {
    ExpectEqual(first.heard().deltas[i], second.heard().deltas[i]);
  }
  ASSERT_EQ(first.heard().verdicts.size(), second.heard().verdicts.size());
  for (std::size_t i = 0; i < first.heard().verdicts.size(); ++i) {
    EXPECT_EQ(first.heard().verdicts[i].photo, second.heard().verdicts[i].photo);
    EXPECT_EQ(first.heard().verdicts[i].status, second.heard().verdicts[i].status);
    EXPECT_EQ(first.heard().verdicts[i].num_inliers, second.heard().verdicts[i].num_inliers);
  }
}

TEST(MapperSession, DeltasInOrderGiveTheMap) {
  Flight flight(RowOfTwelve());
  FlyWithAStrayPhoto(&flight);
  const Recorder& heard = flight.heard();
  for (std::size_t i = 0; i < heard.deltas.size(); ++i) {
    EXPECT_EQ(heard.deltas[i].sequence, i + 1);
    EXPECT_FALSE(heard.deltas[i].is_snapshot);
  }
  ExpectEqual(heard.replica.Snapshot(), flight.map().Snapshot());
}

TEST(MapperSession, TakesPhotosInAnyOrder) {
  for (int seed = 1; seed <= 3; ++seed) {
    std::vector<std::size_t> order(12);
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    test::Random random(seed);
    for (std::size_t i = order.size() - 1; i > 0; --i) {
      std::swap(order[i], order[static_cast<std::size_t>(random.Index(static_cast<int>(i) + 1))]);
    }
    Flight flight(RowOfTwelve());
    for (std::uint32_t id = 0; id < 12; ++id) flight.AddAs(id, order[id]);
    flight.mapper().Finish();
    EXPECT_EQ(flight.heard().NumAccepted(), 12) << "seed " << seed;
    EXPECT_LT(flight.LargestCenterError(), kMaxCenterError_m) << "seed " << seed;
    EXPECT_EQ(test::ContradictionIn(flight.map()), "");
    ExpectEqual(flight.heard().replica.Snapshot(), flight.map().Snapshot());
  }
}

TEST(MapperSession, GoesOnAfterItsFinish) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(6);
  flight.mapper().Finish();
  for (std::size_t camera = 6; camera < 12; ++camera) flight.Add(camera);
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_LT(flight.LargestCenterError(), kMaxCenterError_m);
}

// What a session folder holds of a flight: its photos, latest verdicts and map.
void RestoreFrom(const Flight& flight,
                 const std::vector<MapperPhoto>& photos,
                 Recorder* heard,
                 Mapper* mapper) {
  std::vector<PhotoVerdict> verdicts;
  for (const auto& [photo, verdict] : flight.heard().latest) {
    heard->latest[photo] = verdict;
    verdicts.push_back(verdict);
  }
  const MapDelta snapshot = flight.heard().replica.Snapshot();
  ASSERT_TRUE(heard->replica.Apply(snapshot));
  mapper->Restore(photos, verdicts, snapshot);
}

std::vector<MapperPhoto> StoredPhotos(const Flight& flight, const std::vector<std::size_t>& ids) {
  std::vector<MapperPhoto> photos;
  for (const std::size_t id : ids) photos.push_back(flight.PhotoOf(id));
  return photos;
}

TEST(MapperSession, RestoredGoesOnWhereItWas) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(5);
  flight.Add(10);
  ASSERT_EQ(flight.verdict(10).status, VerdictStatus::kRefused);

  Recorder heard;
  Mapper restored({}, flight.scene().camera, &heard);
  RestoreFrom(flight, StoredPhotos(flight, {0, 1, 2, 3, 4, 10}), &heard, &restored);
  EXPECT_TRUE(heard.verdicts.empty());  // Nothing is new.
  EXPECT_TRUE(heard.deltas.empty());
  ExpectEqual(restored.map().Snapshot(), flight.map().Snapshot());

  restored.Add(flight.PhotoOf(5));
  EXPECT_EQ(heard.latest.at({5}).status, VerdictStatus::kAccepted);
  ASSERT_FALSE(heard.deltas.empty());
  EXPECT_EQ(heard.deltas[0].sequence, flight.heard().replica.sequence() + 1);

  for (const std::size_t camera : {6U, 7U, 8U, 9U}) restored.Add(flight.PhotoOf(camera));
  EXPECT_EQ(heard.latest.at({10}).status, VerdictStatus::kAccepted);  // Refused before.
  EXPECT_EQ(heard.NumAccepted(), 11);
  restored.Finish();
  ExpectEqual(heard.replica.Snapshot(), restored.map().Snapshot());
}

// Flies the photos in that order; after each, if asked to, a new mapper goes on from what was
// stored.
struct Outcome {
  std::map<PhotoId, VerdictStatus> statuses;
  std::map<PhotoId, Eigen::Vector3d> centers;
};

Outcome FlyAll(const Camera& camera, const std::vector<MapperPhoto>& photos, bool is_interrupted) {
  Recorder heard;
  auto mapper = std::make_unique<Mapper>(MapperOptions(), camera, &heard);
  std::vector<MapperPhoto> stored;
  for (const MapperPhoto& photo : photos) {
    mapper->Add(photo);
    stored.push_back(photo);
    if (!is_interrupted) continue;
    std::vector<PhotoVerdict> verdicts;
    for (const auto& [id, verdict] : heard.latest) verdicts.push_back(verdict);
    mapper = std::make_unique<Mapper>(MapperOptions(), camera, &heard);
    mapper->Restore(stored, verdicts, heard.replica.Snapshot());
  }
  mapper->Finish();
  Outcome outcome;
  for (const auto& [id, verdict] : heard.latest) outcome.statuses[id] = verdict.status;
  for (const auto& [id, view] : mapper->map().views()) {
    outcome.centers[id] = view.cam_from_map.TargetOriginInSource();
  }
  return outcome;
}

TEST(MapperSession, IsTheSameWhenRestartedAfterEachPhoto) {
  // It begins with a pair of little parallax and with photos of something else: the map starts anew
  // on the way.
  SceneOptions options = RowOfTwelve();
  options.num_cameras = 2;
  options.spacing_m = 0.45;
  Flight near(options);
  options.num_cameras = 7;
  options.spacing_m = 2.5;
  Flight apart(options);
  std::vector<MapperPhoto> photos = {near.PhotoOf(0), near.PhotoOf(1), test::MakeForeignPhoto(2)};
  for (std::uint32_t i = 0; i < 7; ++i) {
    MapperPhoto photo = apart.PhotoOf(i);
    photo.id = {10 + i};
    photo.analysis.content_hash += 10;
    photos.push_back(photo);
  }
  const Outcome whole = FlyAll(apart.scene().camera, photos, /*is_interrupted=*/false);
  const Outcome resumed = FlyAll(apart.scene().camera, photos, /*is_interrupted=*/true);
  EXPECT_EQ(resumed.statuses, whole.statuses);
  ASSERT_EQ(whole.centers.size(), 9U);
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> expected;
  for (const auto& [id, center] : resumed.centers) {
    found.push_back(center);
    expected.push_back(whole.centers.at(id));
  }
  const auto whole_from_resumed = AlignPoints(found, expected);
  ASSERT_TRUE(whole_from_resumed);
  const std::vector<double> distances = AlignmentResiduals(*whole_from_resumed, found, expected);
  EXPECT_LT(*std::max_element(distances.begin(), distances.end()), 0.005);  // Of a depth of 10.
}

TEST(MapperSession, RestoredKnowsItsDuplicates) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(3);
  Recorder heard;
  Mapper restored({}, flight.scene().camera, &heard);
  RestoreFrom(flight, StoredPhotos(flight, {0, 1, 2}), &heard, &restored);
  MapperPhoto again = flight.PhotoOf(2);
  again.id = {30};
  restored.Add(again);
  EXPECT_EQ(heard.latest.at({30}).reason, RefusalReason::kDuplicate);
  EXPECT_NE(heard.latest.at({30}).hint.find("photo2.jpg"), std::string::npos);
}

TEST(MapperSession, RestoredBeforeItsMapBeganStartsOne) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(1);
  Recorder heard;
  Mapper restored({}, flight.scene().camera, &heard);
  RestoreFrom(flight, StoredPhotos(flight, {0}), &heard, &restored);
  restored.Add(flight.PhotoOf(1));
  restored.Add(flight.PhotoOf(2));
  EXPECT_EQ(heard.NumAccepted(), 3);
}

}  // namespace
}  // namespace plumb
