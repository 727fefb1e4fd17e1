// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/folder_watcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "test/ros/temporary_folder.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kJpeg = "\xFF\xD8 pixels \xFF\xD9";

// Long enough that a test never sees it end unless it waits for that.
constexpr std::chrono::milliseconds kLong{60'000};
constexpr std::chrono::milliseconds kDeadline{20'000};
constexpr std::chrono::milliseconds kNow{0};

const WatchOptions kAlone{kLong, /*max_depth=*/0, ""};
const WatchOptions kWithSubfolders{kLong, /*max_depth=*/3, ""};

TEST(FolderWatcher, FindsWhatLiesThereByNameWhateverTheOrderOfWriting) {
  const TemporaryFolder folder;
  for (const char* name : {"c.jpg", "a.jpg", "b.jpg"}) folder.Write(name, kJpeg);
  FolderWatcher watcher(folder.path(), kAlone);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg", "b.jpg", "c.jpg"));
  EXPECT_THAT(watcher.Wait(kNow), IsEmpty());  // Each once.
}

TEST(FolderWatcher, FindsWhatComesLaterByArrival) {
  const TemporaryFolder folder;
  FolderWatcher watcher(folder.path(), kAlone);
  ASSERT_THAT(watcher.Wait(kNow), IsEmpty());
  folder.Write("b.jpg", kJpeg);
  folder.Write("a.jpg", kJpeg);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("b.jpg", "a.jpg"));
}

TEST(FolderWatcher, WaitsForAPartialJpegToBeCompleted) {
  const TemporaryFolder folder;
  FolderWatcher watcher(folder.path(), kAlone);
  std::ofstream file(folder / "slow.jpg", std::ios::binary);
  file << kJpeg.substr(0, 5) << std::flush;
  EXPECT_THAT(watcher.Wait(kNow), IsEmpty());
  file << kJpeg.substr(5);
  file.close();
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("slow.jpg"));
}

TEST(FolderWatcher, DoesNotTrustAClosedJpegWithoutItsEnd) {
  const TemporaryFolder folder;
  FolderWatcher watcher(folder.path(), kAlone);
  folder.Write("cut.jpg", kJpeg.substr(0, 5));  // A link that reopens and appends.
  EXPECT_THAT(watcher.Wait(kNow), IsEmpty());
  std::ofstream(folder / "cut.jpg", std::ios::binary | std::ios::app) << kJpeg.substr(5);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("cut.jpg"));
}

TEST(FolderWatcher, TakesACutJpegAndAnEmptyFileOnceTheyLieUntouched) {
  const TemporaryFolder folder;
  folder.Write("cut.jpg", kJpeg.substr(0, 5));
  folder.Write("empty.jpg", "");
  FolderWatcher watcher(folder.path(), WatchOptions{std::chrono::milliseconds(50), 0, ""});
  std::vector<std::string> found = watcher.Wait(kDeadline);
  if (found.size() == 1) {
    for (const std::string& name : watcher.Wait(kDeadline)) found.push_back(name);
  }
  EXPECT_THAT(found, ElementsAre("cut.jpg", "empty.jpg"));
}

TEST(FolderWatcher, FindsAFileRenamedIntoPlace) {
  const TemporaryFolder folder;
  FolderWatcher watcher(folder.path(), kAlone);
  folder.Write(".hidden.part", kJpeg);
  EXPECT_THAT(watcher.Wait(kNow), IsEmpty());
  std::filesystem::rename(folder / ".hidden.part", folder / "a.jpg");
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg"));
}

TEST(FolderWatcher, FindsAPhotoAgainThatWasReplaced) {
  const TemporaryFolder folder;
  folder.Write("a.jpg", kJpeg);
  FolderWatcher watcher(folder.path(), kAlone);
  ASSERT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg"));
  folder.Write("a.jpg", "\xFF\xD8 other, longer pixels \xFF\xD9");
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg"));
}

TEST(FolderWatcher, TakesAPaddedJpegAsComplete) {
  const TemporaryFolder folder;
  FolderWatcher watcher(folder.path(), kAlone);
  folder.Write("padded.jpg", kJpeg + std::string(1000, '\0'));
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("padded.jpg"));
}

TEST(FolderWatcher, GoesOnAfterTheFolderWasAwayAndCameBack) {
  const TemporaryFolder folder;
  const std::string card = folder / "card";
  std::filesystem::create_directory(card);
  FolderWatcher watcher(card, kAlone);
  std::filesystem::remove(card);
  EXPECT_THAT(watcher.Wait(std::chrono::milliseconds(1100)), IsEmpty());
  EXPECT_FALSE(watcher.is_watching());
  std::filesystem::create_directory(card);
  folder.Write("card/a.jpg", kJpeg);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg"));
  EXPECT_TRUE(watcher.is_watching());
}

TEST(FolderWatcher, WaitsForAFolderThatIsNotThereYet) {
  const TemporaryFolder folder;
  FolderWatcher watcher(folder / "card", kAlone);
  EXPECT_FALSE(watcher.is_watching());
  std::filesystem::create_directory(folder / "card");
  folder.Write("card/a.jpg", kJpeg);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg"));
  EXPECT_TRUE(watcher.is_watching());
}

TEST(FolderWatcher, NamesAFileThatIsTakenForAFolder) {
  const TemporaryFolder folder;
  folder.Write("a.jpg", kJpeg);
  try {
    const FolderWatcher watcher(folder / "a.jpg", kAlone);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("a.jpg"), HasSubstr("name the folder")));
  }
}

TEST(FolderWatcher, FindsAForgottenPhotoAgain) {
  const TemporaryFolder folder;
  folder.Write("a.jpg", kJpeg);
  FolderWatcher watcher(folder.path(), kAlone);
  ASSERT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg"));
  watcher.Forget("a.jpg");
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("a.jpg"));
}

TEST(FolderWatcher, FindsThePhotosOfACardByItsRoot) {
  const TemporaryFolder card;
  std::filesystem::create_directories(card / "DCIM/100MEDIA");
  std::filesystem::create_directories(card / "DCIM/101MEDIA");
  card.Write("DCIM/101MEDIA/DJI_0001.JPG", kJpeg);
  card.Write("DCIM/100MEDIA/DJI_0999.JPG", kJpeg);
  FolderWatcher watcher(card.path(), kWithSubfolders);
  EXPECT_THAT(watcher.Wait(kDeadline),
              ElementsAre("DCIM/100MEDIA/DJI_0999.JPG", "DCIM/101MEDIA/DJI_0001.JPG"));
  card.Write("DCIM/101MEDIA/DJI_0002.JPG", kJpeg);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("DCIM/101MEDIA/DJI_0002.JPG"));
}

TEST(FolderWatcher, FindsPhotosInASubfolderThatIsMadeLater) {
  const TemporaryFolder card;
  FolderWatcher watcher(card.path(), kWithSubfolders);
  ASSERT_THAT(watcher.Wait(kNow), IsEmpty());
  std::filesystem::create_directory(card / "102MEDIA");
  card.Write("102MEDIA/a.jpg", kJpeg);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("102MEDIA/a.jpg"));
  card.Write("102MEDIA/b.jpg", kJpeg);
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("102MEDIA/b.jpg"));
}

TEST(FolderWatcher, LeavesOutDeepHiddenAndLinkedFoldersAndSessions) {
  const TemporaryFolder card;
  for (const char* name : {"a/b/c/d", ".Trash", "excluded", "flight/photos"}) {
    std::filesystem::create_directories(card / name);
    card.Write(name + std::string("/x.jpg"), kJpeg);
  }
  card.Write("flight/session.db", "");
  card.Write("a/b/c/x.jpg", kJpeg);
  std::filesystem::create_directory_symlink(card.path(), card / "link");
  FolderWatcher watcher(card.path(), {kLong, /*max_depth=*/3, card / "excluded"});
  EXPECT_THAT(watcher.Wait(kDeadline), ElementsAre("a/b/c/x.jpg"));
}

}  // namespace
}  // namespace plumb::ros_adapter
