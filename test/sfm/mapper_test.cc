// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/mapper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "test/sfm/map_invariants.h"
#include "test/sfm/mapper_flight.h"

namespace plumb {
namespace {

using test::Flight;
using test::MakeForeignPhoto;
using test::RowOfTwelve;
using testing::HasSubstr;

// Half a pixel of noise is 2 mm on the facade; along the row it adds up.
constexpr double kMaxCenterError_m = 0.05;

TEST(Mapper, AcceptsARowOfPhotosAndFindsTheirPlaces) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(12);
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_LT(flight.LargestCenterError(), 2.0 * kMaxCenterError_m);
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_EQ(flight.map().views().size(), 12U);
  EXPECT_LT(flight.LargestCenterError(), kMaxCenterError_m);
  EXPECT_GT(flight.map().num_landmarks(), 1000U);
  EXPECT_EQ(test::ContradictionIn(flight.map()), "");
}

TEST(Mapper, LocatesInLiveModeToo) {
  MapperOptions options;
  options.deterministic = false;
  Flight flight(RowOfTwelve(), options);
  for (std::size_t camera = 0; camera < 12; ++camera) {
    flight.Add(camera);
    flight.mapper().Poll();
  }
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_LT(flight.LargestCenterError(), kMaxCenterError_m);
}

TEST(Mapper, RefinesAWrongFocalLengthIfAsked) {
  test::SceneOptions scene_options = RowOfTwelve();
  scene_options.max_turn_rad = 0.3;
  scene_options.approach_m = 0.3;
  const test::Scene scene = MakeScene(scene_options);
  const std::vector<test::ScenePhoto> photos = test::MakeScenePhotos(scene);
  LensParameters<double> lens = scene.camera.lens();
  lens[kFx] *= 1.01;
  lens[kFy] *= 1.01;
  const Camera wrong("wrong", 4000, 3000, DistortionModel::kPlumbBob, lens);
  MapperOptions options;
  options.bundle.refine_focal_length = true;
  test::Recorder heard;
  Mapper mapper(options, wrong, &heard);
  for (std::uint32_t i = 0; i < photos.size(); ++i) {
    mapper.Add(test::MakeMapperPhoto(i, photos[i].features));
  }
  mapper.Finish();
  EXPECT_EQ(heard.NumAccepted(), 12);
  EXPECT_NEAR(mapper.camera().lens()[kFx], scene.camera.lens()[kFx], 5.0);
  EXPECT_EQ(mapper.camera().lens()[kCx], lens[kCx]);
  ASSERT_TRUE(heard.replica.Snapshot().lens);  // Listeners hear of it.
  EXPECT_EQ(*heard.replica.Snapshot().lens, mapper.camera().lens());
}

TEST(Mapper, AnswersEachPhotoBeforeTheMapGrowsByIt) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(12);
  const test::Recorder& heard = flight.heard();
  for (std::size_t v = 0; v < heard.verdicts.size(); ++v) {
    if (heard.verdicts[v].status != VerdictStatus::kAccepted) continue;
    for (std::size_t d = 0; d < heard.num_deltas_before[v]; ++d) {
      for (const ViewState& view : heard.deltas[d].views_set) {
        EXPECT_NE(view.photo, heard.verdicts[v].photo);
      }
    }
  }
  EXPECT_GE(heard.deltas.size(), 11U);
  EXPECT_GE(heard.seconds_of_photo.size(), 11U);
}

TEST(Mapper, AnAcceptedVerdictSaysWhatItRestsOn) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(4);
  const PhotoVerdict& verdict = flight.verdict(3);
  EXPECT_EQ(verdict.status, VerdictStatus::kAccepted);
  EXPECT_EQ(verdict.reason, RefusalReason::kNone);
  EXPECT_EQ(verdict.name, "photo3.jpg");
  EXPECT_EQ(verdict.hint, "");
  EXPECT_GT(verdict.num_inliers, 200);
  EXPECT_EQ(verdict.inlier_pixels.size(), static_cast<std::size_t>(verdict.num_inliers));
  EXPECT_GT(verdict.median_error_px, 0.1);
  EXPECT_LT(verdict.median_error_px, 1.5);
}

TEST(Mapper, TheFirstPhotoWaits) {
  Flight flight(RowOfTwelve());
  flight.Add(0);
  EXPECT_EQ(flight.verdict(0).status, VerdictStatus::kWaiting);
  EXPECT_EQ(flight.verdict(0).reason, RefusalReason::kNone);
  EXPECT_NE(flight.verdict(0).hint, "");
  EXPECT_TRUE(flight.heard().deltas.empty());
  flight.Add(1);
  EXPECT_EQ(flight.verdict(0).status, VerdictStatus::kAccepted);
  EXPECT_EQ(flight.verdict(0).attempt, 2);
  EXPECT_EQ(flight.verdict(1).status, VerdictStatus::kAccepted);
}

TEST(Mapper, RefusesAPhotoOfSomethingElse) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(5);
  flight.mapper().Add(MakeForeignPhoto(100));
  const PhotoVerdict refused = flight.verdict(100);
  EXPECT_EQ(refused.status, VerdictStatus::kRefused);
  EXPECT_EQ(refused.reason, RefusalReason::kNoOverlap);
  EXPECT_THAT(refused.hint, HasSubstr("overlap"));
  for (std::uint32_t camera = 5; camera < 12; ++camera) flight.Add(camera);
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_EQ(flight.verdict(100).attempt, 1);  // The same answer is not given twice.
  EXPECT_FALSE(flight.map().HasView({100}));
}

// Details that look the same in other places, as stones do.
TEST(Mapper, RefusesAPhotoWhoseMatchesAgreeByChanceAsOneOfSomethingElse) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(5);
  MapperPhoto photo = MakeForeignPhoto(100);
  const DescriptorMatrix& known = flight.photos()[2].features.descriptors;
  photo.analysis.features.descriptors.topRows(150) = known.topRows(150);
  flight.mapper().Add(photo);
  flight.mapper().Finish();
  EXPECT_GE(flight.verdict(100).num_matches, 30);
  EXPECT_EQ(flight.verdict(100).status, VerdictStatus::kRefused);
  EXPECT_EQ(flight.verdict(100).reason, RefusalReason::kNoOverlap);
  EXPECT_THAT(flight.verdict(100).hint, HasSubstr("nothing of the model"));
}

TEST(Mapper, LocatesAPhotoOfWhichHardlyAMatchIsDistinct) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(4);
  // Each feature looks almost as much like another one.
  DescriptorMatrix& looks = flight.photos()[4].features.descriptors;
  const DescriptorMatrix others = looks.colwise().reverse();
  for (Eigen::Index i = 0; i < looks.size(); ++i) {
    looks.data()[i] = static_cast<std::uint8_t>((11 * looks.data()[i] + 9 * others.data()[i]) / 20);
  }
  flight.AddAs(4, 4);
  EXPECT_EQ(flight.verdict(4).status, VerdictStatus::kAccepted);
  flight.mapper().Finish();
  EXPECT_LT(flight.LargestCenterError(), kMaxCenterError_m);
}

TEST(Mapper, NamesTheFirstOfTwoEqualFiles) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(3);
  MapperPhoto again = flight.PhotoOf(1);
  again.id = {50};
  again.name = "copy.jpg";
  flight.mapper().Add(again);
  EXPECT_EQ(flight.verdict(50).status, VerdictStatus::kRefused);
  EXPECT_EQ(flight.verdict(50).reason, RefusalReason::kDuplicate);
  EXPECT_THAT(flight.verdict(50).hint, HasSubstr("photo1.jpg"));
  EXPECT_EQ(flight.verdict(50).name, "copy.jpg");
  EXPECT_FALSE(flight.map().HasView({50}));
}

TEST(Mapper, PassesOnWhatTheAnalysisFoundWrong) {
  const std::vector<std::pair<PhotoStatus, RefusalReason>> kCases = {
      {PhotoStatus::kUndecodable, RefusalReason::kUndecodable},
      {PhotoStatus::kWrongSize, RefusalReason::kWrongSize},
      {PhotoStatus::kTooBlurred, RefusalReason::kTooBlurred},
      {PhotoStatus::kTooFewFeatures, RefusalReason::kTooFewFeatures}};
  Flight flight(RowOfTwelve());
  std::uint32_t id = 60;
  for (const auto& [status, reason] : kCases) {
    MapperPhoto photo = test::MakeMapperPhoto(id, {});
    photo.analysis.status = status;
    photo.analysis.detail = "detail " + std::to_string(id);
    flight.mapper().Add(photo);
    EXPECT_EQ(flight.verdict(id).status, VerdictStatus::kRefused);
    EXPECT_EQ(flight.verdict(id).reason, reason);
    EXPECT_EQ(flight.verdict(id).hint, photo.analysis.detail);
    ++id;
  }
  flight.AddFirst(4);
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 4);
  for (std::uint32_t refused = 60; refused < id; ++refused) {
    EXPECT_EQ(flight.verdict(refused).attempt, 1);  // The map cannot cure them.
  }
}

TEST(Mapper, TakesInAPhotoThatCameBeforeItsNeighbours) {
  Flight flight(RowOfTwelve());
  flight.AddFirst(3);
  flight.Add(9);
  EXPECT_EQ(flight.verdict(9).status, VerdictStatus::kRefused);
  EXPECT_EQ(flight.verdict(9).reason, RefusalReason::kNoOverlap);
  for (const std::size_t camera : {3U, 4U, 5U, 6U, 7U, 8U}) flight.Add(camera);
  EXPECT_EQ(flight.verdict(9).status, VerdictStatus::kAccepted);  // By itself.
  EXPECT_GT(flight.verdict(9).attempt, 1);
  for (const std::size_t camera : {10U, 11U}) flight.Add(camera);
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 12);
  EXPECT_LT(flight.LargestCenterError(), kMaxCenterError_m);
}

TEST(Mapper, RefusesBadOptions) {
  test::Recorder heard;
  MapperOptions options;
  options.bundle.huber_width_px = -1.0;
  EXPECT_THROW(Mapper(options, test::MakeCamera(), &heard), std::invalid_argument);
}

TEST(Mapper, OfNoPhotosFinishesInSilence) {
  test::Recorder heard;
  Mapper mapper({}, test::MakeCamera(), &heard);
  mapper.Poll();
  mapper.Finish();
  EXPECT_TRUE(heard.verdicts.empty());
  EXPECT_TRUE(heard.deltas.empty());
}

TEST(Mapper, BearsPhotosOfNoFeaturesAtAll) {
  Flight flight(RowOfTwelve());
  flight.mapper().Add(test::MakeMapperPhoto(70, {}));
  flight.AddFirst(3);
  flight.mapper().Add(test::MakeMapperPhoto(71, {}));
  flight.mapper().Finish();
  EXPECT_EQ(flight.heard().NumAccepted(), 3);
  EXPECT_EQ(flight.verdict(70).reason, RefusalReason::kNoOverlap);
  EXPECT_EQ(flight.verdict(71).reason, RefusalReason::kNoOverlap);
}

}  // namespace
}  // namespace plumb
