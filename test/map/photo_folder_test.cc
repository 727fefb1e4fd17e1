// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/photo_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "plumbline/common/atomic_file.h"
#include "test/map/session_fixture.h"

namespace plumb {
namespace {

using PhotoFolderTest = SessionTest;

TEST(SafeFileName, KeepsAnOrdinaryNameAndTakesThePathOffATrickyOne) {
  EXPECT_EQ(SafeFileName("DSC 0001.JPG"), "DSC 0001.JPG");
  EXPECT_EQ(SafeFileName("../../etc/passwd"), "passwd");
  EXPECT_EQ(SafeFileName("/absolute/a.jpg"), "a.jpg");
  EXPECT_EQ(SafeFileName("C:\\DCIM\\a.jpg"), "a.jpg");
  EXPECT_EQ(SafeFileName("line\nbreak\x7f.jpg"), "line_break_.jpg");
  EXPECT_EQ(SafeFileName(std::string("nul\0l.jpg", 9)), "nul_l.jpg");
}

TEST(SafeFileName, NeverGivesAnEmptyHiddenOrSpecialName) {
  for (const char* name : {"", ".", "..", "a/", "a/..", ".hidden.jpg"}) {
    const std::string safe = SafeFileName(name);
    EXPECT_FALSE(safe.empty()) << name;
    EXPECT_NE(safe[0], '.') << name;
  }
}

TEST(SafeFileName, ShortensBetweenCharactersAndKeepsTheExtension) {
  std::string umlauts;
  for (int i = 0; i < 150; ++i) umlauts += "\xc3\xa4";
  const std::string safe = SafeFileName("x" + umlauts + ".jpg");
  EXPECT_LE(safe.size(), 200u);
  EXPECT_EQ(safe.substr(safe.size() - 6), "\xc3\xa4.jpg");
}

TEST_F(PhotoFolderTest, KeepsTheBytesAsTheyAre) {
  PhotoFolder folder(folder_);
  folder.Prepare();
  const std::vector<std::uint8_t> bytes = MakeBytes(100000, 1);
  EXPECT_EQ(folder.Save("a.jpg", bytes), "a.jpg");
  EXPECT_EQ(ReadFileBytes(folder.PathOf("a.jpg")), bytes);
}

TEST_F(PhotoFolderTest, NumbersADifferentPhotoOfTheSameNameAndFindsBothAgain) {
  const std::vector<std::uint8_t> first = MakeBytes(1000, 1);
  const std::vector<std::uint8_t> second = MakeBytes(1000, 2);
  {
    PhotoFolder folder(folder_);
    folder.Prepare();
    EXPECT_EQ(folder.Save("a.jpg", first), "a.jpg");
    EXPECT_EQ(folder.Save("a.jpg", second), "a_2.jpg");
    EXPECT_EQ(folder.Save("a.jpg", first), "a.jpg");
  }
  PhotoFolder folder(folder_);
  folder.Prepare();
  EXPECT_EQ(folder.ClaimName("a.jpg", second), "a_2.jpg");
  EXPECT_EQ(folder.ClaimName("a.jpg", MakeBytes(1000, 3)), "a_3.jpg");
  EXPECT_EQ(ReadFileBytes(folder.PathOf("a.jpg")), first);
  EXPECT_EQ(ReadFileBytes(folder.PathOf("a_2.jpg")), second);
}

TEST_F(PhotoFolderTest, TellsPhotosOfTheSameNameApartByTheirFolder) {
  PhotoFolder folder(folder_);
  folder.Prepare();
  EXPECT_EQ(folder.Save("DCIM/100MEDIA/a.jpg", MakeBytes(10, 1)), "a.jpg");
  EXPECT_EQ(folder.Save("DCIM/101MEDIA/a.jpg", MakeBytes(10, 2)), "101MEDIA_a.jpg");
  EXPECT_EQ(folder.Save("DCIM\\101MEDIA\\a.jpg", MakeBytes(10, 3)), "a_2.jpg");
  EXPECT_EQ(folder.Save("../a.jpg", MakeBytes(10, 4)), "a_3.jpg");
  EXPECT_EQ(folder.Save("DCIM/101MEDIA/a.jpg", MakeBytes(10, 2)), "101MEDIA_a.jpg");
}

TEST_F(PhotoFolderTest, AClaimedNameIsNotGivenToOtherBytesBeforeItIsWritten) {
  PhotoFolder folder(folder_);
  folder.Prepare();
  EXPECT_EQ(folder.ClaimName("a.jpg", MakeBytes(10, 1)), "a.jpg");
  EXPECT_EQ(folder.ClaimName("a.jpg", MakeBytes(10, 2)), "a_2.jpg");
  EXPECT_EQ(folder.Save("a.jpg", MakeBytes(10, 2)), "a_2.jpg");
  EXPECT_FALSE(std::filesystem::exists(folder.PathOf("a.jpg")));
}

TEST_F(PhotoFolderTest, DoesNotWriteThroughALink) {
  PhotoFolder folder(folder_);
  folder.Prepare();
  const std::filesystem::path outside = root_ / "outside";
  std::filesystem::create_symlink(outside, folder.PathOf("a.jpg"));
  EXPECT_EQ(folder.Save("a.jpg", MakeBytes(10, 1)), "a_2.jpg");
  EXPECT_FALSE(std::filesystem::exists(outside));
}

TEST_F(PhotoFolderTest, ClearsWhatAKilledProcessLeftHalfWritten) {
  std::filesystem::create_directories(folder_);
  const std::filesystem::path leftover = folder_ + "/.plumbline-99999999-a.jpg";
  std::ofstream(leftover) << "half";
  PhotoFolder folder(folder_);
  folder.Prepare();
  EXPECT_FALSE(std::filesystem::exists(leftover));
}

TEST_F(PhotoFolderTest, KeepsWhatAnotherProcessIsWriting) {  // The mapper starts in mid-photo.
  std::filesystem::create_directories(folder_);
  const std::string name = "/.plumbline-" + std::to_string(::getppid()) + "-a.jpg";
  std::ofstream(folder_ + name) << "half";
  PhotoFolder folder(folder_);
  folder.Prepare();
  EXPECT_TRUE(std::filesystem::exists(folder_ + name));
}

TEST_F(PhotoFolderTest, AFileInTheWayIsNamed) {
  std::ofstream(folder_) << "a file";
  try {
    PhotoFolder folder(folder_);
    folder.Prepare();
    folder.Prepare();
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(folder_));
  }
}

}  // namespace
}  // namespace plumb
