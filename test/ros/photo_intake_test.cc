// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/photo_intake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "test/ros/temporary_folder.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::HasSubstr;

std::vector<std::uint8_t> Bytes(const std::string& text) { return {text.begin(), text.end()}; }

class PhotoIntakeTest : public ::testing::Test {
 protected:
  // Takes up a file of this name and content.
  std::optional<TakenPhoto> Take(PhotoIntake* intake,
                                 const std::string& name,
                                 const std::string& content) {
    card_.Write(name, content);
    return intake->TakeFile(card_.path(), name);
  }

  TemporaryFolder card_;
  TemporaryFolder session_;
};

TEST_F(PhotoIntakeTest, CountsFromOneAndKeepsTheBytes) {
  PhotoIntake intake(session_.path());
  const auto first = Take(&intake, "a.jpg", "one");
  const auto second = Take(&intake, "b.jpg", "two");
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->sequence, 1U);
  EXPECT_EQ(second->sequence, 2U);
  EXPECT_EQ(second->name, "b.jpg");
  EXPECT_EQ(intake.ReadBytes(*second), Bytes("two"));
  EXPECT_TRUE(std::filesystem::exists(session_ / "photos/b.jpg"));
}

TEST_F(PhotoIntakeTest, TakesTheSameFileOnlyOnce) {
  PhotoIntake intake(session_.path());
  EXPECT_TRUE(Take(&intake, "a.jpg", "one"));
  EXPECT_FALSE(intake.TakeFile(card_.path(), "a.jpg"));
  EXPECT_FALSE(Take(&intake, "a.jpg", "one"));  // Written again, the same bytes.
}

TEST_F(PhotoIntakeTest, TakesOtherBytesOfTheSameNameAsAnotherPhoto) {
  PhotoIntake intake(session_.path());
  const auto first = Take(&intake, "a.jpg", "one");
  const auto second = Take(&intake, "a.jpg", "another");
  ASSERT_TRUE(first && second);
  EXPECT_EQ(second->sequence, 2U);
  EXPECT_NE(second->name, first->name);
  EXPECT_EQ(intake.ReadBytes(*first), Bytes("one"));
  EXPECT_EQ(intake.ReadBytes(*second), Bytes("another"));
}

TEST_F(PhotoIntakeTest, TakesPhotosOfTheSameNameAndTimeInTwoSubfoldersAsTwo) {
  std::filesystem::create_directories(card_ / "100MEDIA");
  std::filesystem::create_directories(card_ / "101MEDIA");
  PhotoIntake intake(session_.path());
  const auto first = Take(&intake, "100MEDIA/DJI_0001.JPG", "one");
  card_.Write("101MEDIA/DJI_0001.JPG", "two");
  std::filesystem::last_write_time(
      card_ / "101MEDIA/DJI_0001.JPG",
      std::filesystem::last_write_time(card_ / "100MEDIA/DJI_0001.JPG"));
  const auto second = intake.TakeFile(card_.path(), "101MEDIA/DJI_0001.JPG");
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->name, "DJI_0001.JPG");
  EXPECT_EQ(second->name, "101MEDIA_DJI_0001.JPG");
  EXPECT_EQ(second->source, "101MEDIA/DJI_0001.JPG");
  EXPECT_EQ(intake.ReadBytes(*second), Bytes("two"));
  EXPECT_FALSE(intake.TakeFile(card_.path(), "101MEDIA/DJI_0001.JPG"));
}

TEST_F(PhotoIntakeTest, TakesNoPhotoTwiceWhenItsFolderIsGivenInAnotherWay) {
  std::filesystem::create_directories(card_ / "100MEDIA");
  PhotoIntake intake(session_.path());
  EXPECT_TRUE(Take(&intake, "100MEDIA/a.jpg", "one"));
  EXPECT_FALSE(intake.TakeFile(card_ / "100MEDIA", "a.jpg"));
}

TEST_F(PhotoIntakeTest, TakesTheSameBytesUnderAnotherNameForTheMapperToJudge) {
  PhotoIntake intake(session_.path());
  EXPECT_TRUE(Take(&intake, "a.jpg", "one"));
  EXPECT_TRUE(Take(&intake, "copy.jpg", "one"));
}

TEST_F(PhotoIntakeTest, GoesOnAfterARestart) {
  TakenPhoto before;
  {
    PhotoIntake intake(session_.path());
    before = *Take(&intake, "a.jpg", "one");
  }
  PhotoIntake intake(session_.path());
  EXPECT_FALSE(intake.TakeFile(card_.path(), "a.jpg"));
  ASSERT_EQ(intake.photos().size(), 1U);
  const TakenPhoto after = intake.photos()[0];
  EXPECT_EQ(after.sequence, before.sequence);
  EXPECT_EQ(after.exposure_time, before.exposure_time);
  EXPECT_EQ(after.received, before.received);
  EXPECT_EQ(Take(&intake, "b.jpg", "two")->sequence, 2U);
}

TEST_F(PhotoIntakeTest, ForgetsALineCutByACrashAndTakesThePhotoAgain) {
  {
    PhotoIntake intake(session_.path());
    Take(&intake, "a.jpg", "one");
    Take(&intake, "b.jpg", "two");
  }
  const std::string ledger = session_ / "photos.jsonl";
  std::filesystem::resize_file(ledger, std::filesystem::file_size(ledger) - 5);
  {
    PhotoIntake intake(session_.path());
    EXPECT_EQ(intake.photos().size(), 1U);
    const auto again = intake.TakeFile(card_.path(), "b.jpg");
    ASSERT_TRUE(again);
    EXPECT_EQ(again->sequence, 2U);
    EXPECT_EQ(again->name, "b.jpg");
  }
  EXPECT_EQ(PhotoIntake(session_.path()).photos().size(), 2U);
}

TEST_F(PhotoIntakeTest, NamesTheLineThatMakesNoSense) {
  session_.Write("photos.jsonl", "{\"sequence\": \"one\"}\n");
  try {
    const PhotoIntake intake(session_.path());
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("photos.jsonl, line 1"));
  }
}

TEST_F(PhotoIntakeTest, NamesAFileThatIsGone) {
  PhotoIntake intake(session_.path());
  try {
    intake.TakeFile(card_.path(), "gone.jpg");
    FAIL() << "nothing was thrown";
  } catch (const UnreadablePhoto& error) {
    EXPECT_THAT(error.what(), HasSubstr("gone.jpg"));
  }
}

// The smallest JPEG that carries EXIF: DateTimeOriginal and nothing else.
std::string JpegTakenAt(const std::string& time) {
  const auto number = [](std::uint32_t value, int num_bytes) {
    std::string text;
    for (int i = 0; i < num_bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xFFU);
    return text;
  };
  std::string tiff = "II" + number(42, 2) + number(8, 4);
  tiff += number(1, 2) + number(0x8769, 2) + number(4, 2) + number(1, 4) + number(26, 4);
  tiff += number(0, 4);  // No further directory.
  tiff += number(1, 2) + number(0x9003, 2) + number(2, 2) + number(20, 4) + number(44, 4);
  tiff += number(0, 4) + time + '\0';
  const std::string body = std::string("Exif\0\0", 6) + tiff;
  const std::size_t size = body.size() + 2;
  return "\xFF\xD8\xFF\xE1" + std::string{static_cast<char>(size >> 8), static_cast<char>(size)} +
         body + "\xFF\xD9";
}

TEST_F(PhotoIntakeTest, TakesTheTimeOfExposureFromExif) {
  PhotoIntake intake(session_.path());
  const auto photo = Take(&intake, "a.jpg", JpegTakenAt("2020:01:02 03:04:05"));
  ASSERT_TRUE(photo);
  EXPECT_EQ(photo->exposure_time, Timestamp{1'577'934'245'000'000'000});
}

TEST_F(PhotoIntakeTest, TakesTheFilesTimeWhereThereIsNoExif) {
  PhotoIntake intake(session_.path());
  const auto photo = Take(&intake, "a.jpg", "one");
  ASSERT_TRUE(photo);
  EXPECT_EQ(photo->exposure_time, photo->source_time);
}

TEST_F(PhotoIntakeTest, KeepsTheStampOfAnImageFromATopic) {
  PhotoIntake intake(session_.path());
  const auto photo = intake.TakeBytes("5.png", Timestamp{5'000'000'001}, Bytes("pixels"));
  ASSERT_TRUE(photo);
  EXPECT_EQ(photo->exposure_time, Timestamp{5'000'000'001});
}

}  // namespace
}  // namespace plumb::ros_adapter
