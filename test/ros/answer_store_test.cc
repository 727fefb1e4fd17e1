// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/answer_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "plumbline/camera/camera.h"
#include "ros/unsearched_photos.h"
#include "test/ros/temporary_folder.h"

namespace plumb::ros_adapter {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

plumbline::MarkerDetectionArray Answer(std::uint32_t sequence, std::size_t num_markers) {
  plumbline::MarkerDetectionArray answer;
  answer.header.stamp = ros::Time(sequence, 5);
  answer.sequence = sequence;
  answer.name = std::to_string(sequence) + ".jpg";
  answer.detections.resize(num_markers);
  for (std::size_t i = 0; i < num_markers; ++i) {
    answer.detections[i].id = static_cast<std::uint32_t>(i);
    answer.detections[i].center_px = {1.0 / 3.0, 1e3};
  }
  return answer;
}

TEST(AnswerStore, GoesOnWithWhatWasSavedLast) {
  const TemporaryFolder session;
  {
    AnswerStore store(session.path());
    store.Save(Answer(2, 3));
    store.Save(Answer(1, 1));
    store.Save(Answer(1, 2));
  }
  const auto answers = AnswerStore(session.path()).Load();
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0], Answer(1, 2));
  EXPECT_EQ(answers[1], Answer(2, 3));
}

TEST(AnswerStore, ForgetsAnswersOfOtherMessages) {
  const TemporaryFolder session;
  AnswerStore store(session.path());
  store.Save(Answer(1, 1));
  sqlite::Database(session / "markers.db", sqlite::Access::kWrite)
      .Execute("UPDATE answers SET definition = 'another'");
  EXPECT_TRUE(store.Load().empty());
}

TEST(AnswerStore, NamesAFileThatIsCut) {
  const TemporaryFolder session;
  AnswerStore store(session.path());
  store.Save(Answer(1, 1));
  sqlite::Database(session / "markers.db", sqlite::Access::kWrite)
      .Execute("UPDATE answers SET message = substr(message, 1, 40)");
  EXPECT_THAT([&] { store.Load(); }, ThrowsMessage<std::runtime_error>(HasSubstr("markers.db")));
}

TEST(AnswerStore, NamesAFileThatIsNoDatabase) {
  TemporaryFolder session;
  session.Write("markers.db", "no database, but long enough to be taken for the header of one ...");
  EXPECT_THAT([&] { AnswerStore store(session.path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("markers.db")));
}

class UnsearchedPhotosTest : public testing::Test {
 protected:
  UnsearchedPhotosTest() {
    const LensParameters<double> lens{60.0, 60.0, 31.5, 23.5};
    session_.Write("camera.yaml",
                   ToCameraYaml(Camera("tiny", 64, 48, DistortionModel::kPlumbBob, lens)));
  }

  void Take(const std::string& name) {
    card_.Write(name, "pixels of " + name);
    ASSERT_TRUE(PhotoIntake(session_.path()).TakeFile(card_.path(), name));
  }

  static bool None(std::uint32_t) { return false; }

  TemporaryFolder card_;
  TemporaryFolder session_;
};

TEST_F(UnsearchedPhotosTest, GivesThemAsCameraIngestSendsThem) {
  UnsearchedPhotos photos(session_.path());
  EXPECT_FALSE(photos.Next(None));  // None was taken up yet.
  Take("a.jpg");
  Take("b.jpg");
  const auto photo = photos.Next([](std::uint32_t sequence) { return sequence == 1; });
  ASSERT_TRUE(photo);
  EXPECT_EQ(photo->sequence, 2U);
  EXPECT_EQ(photo->name, "b.jpg");
  EXPECT_EQ(photo->header.frame_id, "camera_optical");
  EXPECT_EQ(photo->camera_info.K[0], 60.0);
  EXPECT_EQ(std::string(photo->image.data.begin(), photo->image.data.end()), "pixels of b.jpg");
  EXPECT_FALSE(photos.Next([](std::uint32_t) { return true; }));
}

TEST_F(UnsearchedPhotosTest, NamesWhatCannotBeReadOnceAndGoesOn) {
  Take("a.jpg");
  Take("b.jpg");
  std::filesystem::remove(session_ / "photos/a.jpg");
  UnsearchedPhotos photos(session_.path());
  EXPECT_THAT([&] { photos.Next(None); }, ThrowsMessage<std::runtime_error>(HasSubstr("a.jpg")));
  const auto photo = photos.Next(None);
  ASSERT_TRUE(photo);
  EXPECT_EQ(photo->sequence, 2U);
}

TEST_F(UnsearchedPhotosTest, WaitsForTheCamera) {
  Take("a.jpg");
  std::filesystem::remove(session_ / "camera.yaml");
  EXPECT_FALSE(UnsearchedPhotos(session_.path()).Next(None));
}

}  // namespace
}  // namespace plumb::ros_adapter
