// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/session_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "plumbline/common/atomic_file.h"
#include "test/map/session_fixture.h"

namespace plumb {
namespace {

using SessionStoreTest = SessionTest;

void ExpectEqual(const MapDelta& actual, const MapDelta& expected) {
  ASSERT_EQ(actual.views_set.size(), expected.views_set.size());
  for (std::size_t i = 0; i < actual.views_set.size(); ++i) {
    const ViewState& view = actual.views_set[i];
    const ViewState& truth = expected.views_set[i];
    EXPECT_EQ(view.photo, truth.photo);
    EXPECT_EQ(view.name, truth.name);
    EXPECT_EQ(view.exposure_time, truth.exposure_time);
    EXPECT_EQ(view.cam_from_map.Matrix(), truth.cam_from_map.Matrix());  // To the last bit.
  }
  ASSERT_EQ(actual.landmarks_set.size(), expected.landmarks_set.size());
  for (std::size_t i = 0; i < actual.landmarks_set.size(); ++i) {
    EXPECT_EQ(actual.landmarks_set[i].id, expected.landmarks_set[i].id);
    EXPECT_EQ(actual.landmarks_set[i].position_in_map, expected.landmarks_set[i].position_in_map);
    EXPECT_EQ(actual.landmarks_set[i].color, expected.landmarks_set[i].color);
  }
  ASSERT_EQ(actual.observations_added.size(), expected.observations_added.size());
  for (std::size_t i = 0; i < actual.observations_added.size(); ++i) {
    const ObservationState& observation = actual.observations_added[i];
    const ObservationState& truth = expected.observations_added[i];
    EXPECT_EQ(observation.landmark, truth.landmark);
    EXPECT_EQ(observation.photo, truth.photo);
    EXPECT_EQ(observation.feature_idx, truth.feature_idx);
    EXPECT_EQ(observation.pixel, truth.pixel);
  }
}

// A store with photos 0 to 3 and no map.
SessionStore MakeStore(const std::string& folder) {
  SessionStore store(folder, MakeCamera());
  for (std::uint32_t i = 0; i < 4; ++i) {
    store.SavePhoto({i}, "photo" + std::to_string(i) + ".jpg", MakeBytes(100, i));
  }
  return store;
}

PhotoVerdict MakeVerdict(std::uint32_t photo, int attempt, VerdictStatus status) {
  PhotoVerdict verdict;
  verdict.photo = {photo};
  verdict.name = "photo" + std::to_string(photo) + ".jpg";
  verdict.attempt = attempt;
  verdict.status = status;
  verdict.num_matches = 120;
  verdict.num_inliers = 80;
  verdict.median_error_px = 0.5;
  verdict.seconds.verdict_s = 0.375;
  return verdict;
}

TEST_F(SessionStoreTest, GivesBackPhotosAndTheirAnalysisAfterReopening) {
  const PhotoAnalysis analysis = MakeAnalysis(50, 3);
  {
    SessionStore store = MakeStore(folder_);
    EXPECT_EQ(store.SavePhoto({4}, "../photo0.jpg", MakeBytes(100, 9)), "photo0_2.jpg");
    store.SaveAnalysis({2}, Timestamp{77}, analysis);
  }
  SessionStore store(folder_, MakeCamera());
  EXPECT_EQ(store.NextPhotoId(), PhotoId{5});
  const std::vector<StoredPhoto> photos = store.Photos();
  ASSERT_EQ(photos.size(), 5u);
  EXPECT_EQ(photos[4].name, "photo0_2.jpg");
  EXPECT_EQ(photos[4].source_name, "../photo0.jpg");
  EXPECT_EQ(photos[4].num_bytes, 100u);
  EXPECT_FALSE(photos[4].analysis);
  EXPECT_FALSE(photos[4].exposure_time);
  EXPECT_EQ(ReadFileBytes(store.photos().PathOf("photo0_2.jpg")), MakeBytes(100, 9));
  ASSERT_TRUE(photos[2].analysis);
  EXPECT_EQ(photos[2].exposure_time, Timestamp{77});
  const PhotoAnalysis& read = *photos[2].analysis;
  EXPECT_EQ(read.status, PhotoStatus::kOk);
  EXPECT_EQ(read.detail, "fine");
  EXPECT_EQ(read.content_hash, analysis.content_hash);
  EXPECT_EQ(read.metadata.width_px, 640);
  EXPECT_EQ(read.metadata.height_px, 480);
  EXPECT_EQ(read.metadata.exif_orientation, 6);
  EXPECT_EQ(read.metadata.focal_length_mm, 8.8);
  EXPECT_EQ(read.metadata.exposure_time, analysis.metadata.exposure_time);
  ASSERT_TRUE(read.metadata.position);
  EXPECT_EQ(read.metadata.position->lat_deg, 47.3769);
  EXPECT_EQ(read.metadata.position->lon_deg, 8.5417);
  EXPECT_FALSE(read.metadata.position->alt_m);
  EXPECT_EQ(read.blur_px, 0.75);
  EXPECT_EQ(read.decode_s, 0.125);
  EXPECT_EQ(read.features_s, 0.25);
}

TEST_F(SessionStoreTest, GivesBackFeaturesBitByBit) {
  SessionStore store = MakeStore(folder_);
  const PhotoAnalysis analysis = MakeAnalysis(500, 3);
  store.SaveAnalysis({1}, Timestamp{}, analysis);
  const FeatureSet read = store.LoadFeatures({1});
  ASSERT_EQ(read.size(), 500u);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read.features[i].x_px, analysis.features.features[i].x_px);
    EXPECT_EQ(read.features[i].y_px, analysis.features.features[i].y_px);
    EXPECT_EQ(read.features[i].scale_px, analysis.features.features[i].scale_px);
    EXPECT_EQ(read.features[i].orientation_rad, analysis.features.features[i].orientation_rad);
  }
  EXPECT_EQ(read.descriptors, analysis.features.descriptors);
  EXPECT_EQ(read.colors, analysis.features.colors);
}

TEST_F(SessionStoreTest, APhotoWithoutFeaturesHasNone) {
  SessionStore store = MakeStore(folder_);
  PhotoAnalysis undecodable;
  undecodable.detail = "not a photo";
  store.SaveAnalysis({0}, Timestamp{}, undecodable);
  EXPECT_EQ(store.LoadFeatures({0}).size(), 0u);
  EXPECT_EQ(store.LoadFeatures({1}).size(), 0u);  // Never analysed.
  EXPECT_EQ(store.Photos()[0].analysis->status, PhotoStatus::kUndecodable);
}

TEST_F(SessionStoreTest, TheLatestVerdictReplacesButHistoryStays) {
  SessionStore store = MakeStore(folder_);
  PhotoVerdict refused = MakeVerdict(1, 1, VerdictStatus::kRefused);
  refused.reason = RefusalReason::kNoOverlap;
  refused.hint = "fly closer to the last photo";
  store.SaveVerdict(refused);
  store.SaveVerdict(MakeVerdict(0, 1, VerdictStatus::kWaiting));
  store.SaveVerdict(MakeVerdict(1, 2, VerdictStatus::kAccepted));
  StageSeconds seconds;
  seconds.verdict_s = 1.5;
  seconds.expand_s = 0.25;
  seconds.bundle_s = 0.125;
  store.SaveSeconds({1}, seconds);

  const std::vector<PhotoVerdict> latest = store.LatestVerdicts();
  ASSERT_EQ(latest.size(), 2u);
  EXPECT_EQ(latest[0].photo, PhotoId{0});
  EXPECT_EQ(latest[0].status, VerdictStatus::kWaiting);
  EXPECT_EQ(latest[0].seconds.verdict_s, 0.375);
  EXPECT_EQ(latest[1].status, VerdictStatus::kAccepted);
  EXPECT_EQ(latest[1].attempt, 2);
  EXPECT_EQ(latest[1].num_matches, 120);
  EXPECT_EQ(latest[1].num_inliers, 80);
  EXPECT_EQ(latest[1].seconds.bundle_s, 0.125);
  const std::vector<PhotoVerdict> all = store.AllVerdicts();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "photo1.jpg");
  EXPECT_EQ(all[0].reason, RefusalReason::kNoOverlap);
  EXPECT_EQ(all[0].hint, "fly closer to the last photo");
  EXPECT_EQ(all[0].seconds.verdict_s, 0.375);
}

TEST_F(SessionStoreTest, AVerdictGivenLaterWinsWhateverItsAttempt) {
  // After a kill between verdict and map, the photo is taken anew and counts from 1 again.
  SessionStore store = MakeStore(folder_);
  store.SaveVerdict(MakeVerdict(1, 2, VerdictStatus::kAccepted));
  store.SaveVerdict(MakeVerdict(1, 1, VerdictStatus::kWaiting));
  EXPECT_EQ(store.LatestVerdicts()[0].status, VerdictStatus::kWaiting);
}

TEST_F(SessionStoreTest, ASnapshotIsTheSumOfTheDeltas) {
  MapDelta expected = MakeDelta(1, 0, 10);
  {
    SessionStore store = MakeStore(folder_);
    store.Apply(MakeDelta(1, 0, 10));
    MapDelta second = MakeDelta(2, 1, 5);  // Moves landmarks 0 to 4.
    second.lens = MakeCamera(790.125).lens();
    store.Apply(second);
    for (std::size_t i = 0; i < 5; ++i) expected.landmarks_set[i] = second.landmarks_set[i];
    expected.views_set.push_back(second.views_set[0]);
    for (const ObservationState& added : second.observations_added) {
      expected.observations_added.push_back(added);
    }
  }
  std::sort(expected.observations_added.begin(),
            expected.observations_added.end(),
            [](const ObservationState& a, const ObservationState& b) {
              return std::pair(a.landmark.value, a.photo.value) <
                     std::pair(b.landmark.value, b.photo.value);
            });
  const MapDelta snapshot = SessionStore::OpenExisting(folder_).Snapshot();
  EXPECT_EQ(snapshot.sequence, 2u);
  EXPECT_TRUE(snapshot.is_snapshot);
  EXPECT_EQ(snapshot.lens, MakeCamera(790.125).lens());
  ExpectEqual(snapshot, expected);
}

TEST_F(SessionStoreTest, RemovalsTakeTheirObservationsAlong) {
  SessionStore store = MakeStore(folder_);
  store.Apply(MakeDelta(1, 0, 3));
  store.Apply(MakeDelta(2, 1, 3));
  store.Apply(MakeDelta(3, 2, 3));
  MapDelta removal;
  removal.sequence = 4;
  removal.landmarks_removed = {{0}};
  removal.views_removed = {{1}};
  removal.observations_removed = {MakeDelta(3, 2, 3).observations_added[2]};
  store.Apply(removal);
  const MapDelta snapshot = store.Snapshot();
  ASSERT_EQ(snapshot.views_set.size(), 2u);
  ASSERT_EQ(snapshot.landmarks_set.size(), 2u);
  EXPECT_EQ(snapshot.landmarks_set[0].id, LandmarkId{1});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> left;
  for (const ObservationState& observation : snapshot.observations_added) {
    left.emplace_back(observation.landmark.value, observation.photo.value);
  }
  EXPECT_THAT(left, testing::ElementsAre(std::pair(1, 0), std::pair(1, 2), std::pair(2, 0)));
}

TEST_F(SessionStoreTest, MovingAViewKeepsItsObservations) {
  SessionStore store = MakeStore(folder_);
  store.Apply(MakeDelta(1, 0, 3));
  MapDelta move = MakeDelta(2, 0, 0);
  move.views_set[0].cam_from_map = Rigid3();
  store.Apply(move);
  EXPECT_EQ(store.Snapshot().observations_added.size(), 3u);
  EXPECT_EQ(store.Snapshot().views_set[0].cam_from_map.translation, Eigen::Vector3d::Zero());
}

TEST_F(SessionStoreTest, ASnapshotAppliedReplacesEverything) {
  SessionStore store = MakeStore(folder_);
  MapDelta first = MakeDelta(1, 0, 30);
  first.lens = MakeCamera().lens();
  store.Apply(first);
  MapDelta replacement = MakeDelta(17, 3, 2);
  replacement.is_snapshot = true;
  store.Apply(replacement);
  const MapDelta snapshot = store.Snapshot();
  EXPECT_EQ(snapshot.sequence, 17u);
  EXPECT_FALSE(snapshot.lens);
  ExpectEqual(snapshot, replacement);
}

TEST_F(SessionStoreTest, ADeltaOutOfOrderIsABrokenPreconditionAndChangesNothing) {
  SessionStore store = MakeStore(folder_);
  store.Apply(MakeDelta(1, 0, 3));
  EXPECT_THROW(store.Apply(MakeDelta(3, 1, 3)), std::logic_error);
  EXPECT_THROW(store.Apply(MakeDelta(1, 1, 3)), std::logic_error);
  EXPECT_EQ(store.Snapshot().sequence, 1u);
  EXPECT_EQ(store.Snapshot().views_set.size(), 1u);
}

TEST_F(SessionStoreTest, ADeltaThatFailsHalfwayChangesNothing) {
  SessionStore store = MakeStore(folder_);
  MapDelta delta = MakeDelta(1, 0, 3);
  delta.observations_added.push_back({{99}, {0}, 1, {0.0F, 0.0F}});  // No such landmark.
  EXPECT_THROW(store.Apply(delta), std::runtime_error);
  EXPECT_TRUE(store.Snapshot().views_set.empty());
  store.Apply(MakeDelta(1, 0, 3));
  EXPECT_EQ(store.Snapshot().views_set.size(), 1u);
}

// What a bundle of the map of MakeDelta(1, 0, 3) might change.
MapDelta MakeRefinement(const MapDelta& map) {
  MapDelta refined;
  refined.sequence = 2;
  refined.lens = MakeCamera(812.5).lens();
  refined.views_set = map.views_set;
  refined.views_set[0].cam_from_map.translation = {7.0, 8.0, 9.0};
  refined.landmarks_set = {map.landmarks_set[1]};
  refined.landmarks_set[0].position_in_map = {0.125, 1.0 / 3.0, -2.0};
  refined.landmarks_removed = {map.landmarks_set[0].id};
  refined.observations_removed = {map.observations_added[2]};
  return refined;
}

TEST_F(SessionStoreTest, ARefinementLiesBesideTheMap) {
  SessionStore store = MakeStore(folder_);
  EXPECT_FALSE(store.RefinedSnapshot());
  const MapDelta map = MakeDelta(1, 0, 3);
  ASSERT_EQ(map.observations_added.size(), 3u);
  store.Apply(map);
  const MapDelta refined = MakeRefinement(map);
  store.SaveRefinement(refined);
  ExpectEqual(store.Snapshot(), map);  // As it was.

  const auto snapshot = SessionStore::OpenExisting(folder_).RefinedSnapshot();
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->sequence, 1u);
  EXPECT_EQ(snapshot->lens, refined.lens);
  EXPECT_EQ(snapshot->views_set[0].cam_from_map.translation, Eigen::Vector3d(7.0, 8.0, 9.0));
  ASSERT_EQ(snapshot->landmarks_set.size(), 2u);
  EXPECT_EQ(snapshot->landmarks_set[0].position_in_map, refined.landmarks_set[0].position_in_map);
  EXPECT_EQ(snapshot->landmarks_set[1].position_in_map, map.landmarks_set[2].position_in_map);
  for (const ObservationState& observation : snapshot->observations_added) {
    EXPECT_EQ(observation.landmark, map.landmarks_set[1].id);
  }

  store.DropRefinement();
  EXPECT_FALSE(store.RefinedSnapshot());
  ExpectEqual(store.Snapshot(), map);
}

TEST_F(SessionStoreTest, ARefinementIsOfTheMapItWasMadeOf) {
  SessionStore store = MakeStore(folder_);
  store.DropRefinement();  // Nothing there.
  const MapDelta map = MakeDelta(1, 0, 3);
  store.Apply(map);
  MapDelta refined = MakeRefinement(map);
  refined.sequence = 5;
  EXPECT_THROW(store.SaveRefinement(refined), std::logic_error);
  refined.sequence = 2;
  store.SaveRefinement(refined);
  store.Apply(MakeDelta(2, 1, 3));
  EXPECT_FALSE(store.RefinedSnapshot());
  EXPECT_TRUE(store.HasRefinement());
  store.DropRefinement();
  EXPECT_FALSE(store.HasRefinement());
}

}  // namespace
}  // namespace plumb
