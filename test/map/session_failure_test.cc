// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a session does when it is killed, when the disk fills, and when the folder is not its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "plumbline/map/session_store.h"
#include "test/map/session_fixture.h"

namespace plumb {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using SessionFailure = SessionTest;

// The message of the std::runtime_error that `action` throws; empty if it throws none.
std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

void RunSql(const std::string& path, const char* sql) {
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &handle), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(handle);
}

// Runs `action` in a child process and returns its exit status.
int InChild(const std::function<int()>& action) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(action());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr int kChildPassed = 0;
constexpr int kChildFailed = 1;
constexpr int kChildCannotTry = 2;

int Check(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    if (message.find(part) != std::string::npos) continue;
    std::fprintf(stderr, "\"%s\" does not hold \"%s\"\n", message.c_str(), part.c_str());
    return kChildFailed;
  }
  return kChildPassed;
}

TEST_F(SessionFailure, AnotherCameraIsRefusedAndTheDifferenceNamed) {
  { SessionStore store(folder_, MakeCamera()); }
  EXPECT_THAT(ErrorOf([&] { SessionStore store(folder_, MakeCamera(810.0)); }),
              AllOf(HasSubstr(folder_), HasSubstr("another camera (fx 800, now 810)")));
}

TEST_F(SessionFailure, ANewerSchemaIsRefused) {
  { SessionStore store(folder_, MakeCamera()); }
  RunSql(folder_ + "/session.db", "PRAGMA user_version = 99");
  const std::string error = ErrorOf([&] { SessionStore store(folder_, MakeCamera()); });
  EXPECT_THAT(error, AllOf(HasSubstr(folder_ + "/session.db"), HasSubstr("schema 99")));
  EXPECT_EQ(ErrorOf([&] { SessionStore::OpenExisting(folder_); }), error);
}

TEST_F(SessionFailure, WhatIsNoSessionIsRefusedAndLeftAsItIs) {
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ + "/session.db") << std::string(5000, 'x');
  EXPECT_THAT(ErrorOf([&] { SessionStore store(folder_, MakeCamera()); }),
              AllOf(HasSubstr(folder_ + "/session.db"), HasSubstr("not a database")));
  EXPECT_EQ(std::filesystem::file_size(folder_ + "/session.db"), 5000u);
  std::filesystem::remove(folder_ + "/session.db");
  RunSql(folder_ + "/session.db", "CREATE TABLE contacts (name TEXT)");
  EXPECT_THAT(ErrorOf([&] { SessionStore store(folder_, MakeCamera()); }),
              AllOf(HasSubstr(folder_ + "/session.db"), HasSubstr("not a Plumbline session")));
}

TEST_F(SessionFailure, ReadingAFolderWithoutASessionMakesNone) {
  EXPECT_THAT(ErrorOf([&] { SessionStore::OpenExisting(folder_); }),
              AllOf(HasSubstr(folder_), HasSubstr("there is no such folder")));
  EXPECT_FALSE(std::filesystem::exists(folder_));
  std::filesystem::create_directory(folder_);
  EXPECT_THAT(ErrorOf([&] { SessionStore::OpenExisting(folder_); }),
              AllOf(HasSubstr(folder_), HasSubstr("holds no session")));
  std::ofstream(folder_ + "/photo.jpg") << 'x';
  EXPECT_THAT(ErrorOf([&] { SessionStore::OpenExisting(folder_ + "/photo.jpg"); }),
              AllOf(HasSubstr("photo.jpg"), HasSubstr("is a file")));
}

TEST_F(SessionFailure, ASecondWriterIsRefusedWhileAReaderIsWelcome) {
  SessionStore store(folder_, MakeCamera());
  EXPECT_THAT(ErrorOf([&] { SessionStore second(folder_, MakeCamera()); }),
              AllOf(HasSubstr(folder_), HasSubstr("another program writes")));
  EXPECT_EQ(SessionStore::OpenExisting(folder_).NextPhotoId(), PhotoId{0});
}

TEST_F(SessionFailure, AFolderThatCannotBeWrittenIsNamed) {
  std::filesystem::permissions(root_, std::filesystem::perms(0555));
  const int status = InChild([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return kChildCannotTry;  // Root may all.
    return Check(ErrorOf([&] { SessionStore store(folder_, MakeCamera()); }),
                 {folder_, "Permission denied", "writable"});
  });
  std::filesystem::permissions(root_, std::filesystem::perms(0755));
  if (status == kChildCannotTry) GTEST_SKIP() << "cannot become an unprivileged user";
  EXPECT_EQ(status, kChildPassed);
}

TEST_F(SessionFailure, ASessionThatBecameReadOnlyIsNamed) {
  { SessionStore store(folder_, MakeCamera()); }
  std::filesystem::permissions(folder_ + "/session.db", std::filesystem::perms(0444));
  std::filesystem::permissions(root_, std::filesystem::perms(0755));
  for (const char* path : {"", "/photos"}) {
    std::filesystem::permissions(folder_ + path, std::filesystem::perms(0777));
  }
  std::filesystem::permissions(folder_ + "/session.lock", std::filesystem::perms(0666));
  const int status = InChild([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return kChildCannotTry;
    return Check(ErrorOf([&] {
                   SessionStore store(folder_, MakeCamera());
                   store.SavePhoto({0}, "a.jpg", MakeBytes(100, 1));
                 }),
                 {folder_ + "/session.db", "writable"});
  });
  if (status == kChildCannotTry) GTEST_SKIP() << "cannot become an unprivileged user";
  EXPECT_EQ(status, kChildPassed);
}

// Files and folders of the session and above it, for nobody to write.
void MakeReadOnly(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    fs::permissions(entry, fs::perms(entry.is_directory() ? 0555 : 0444));
  }
  fs::permissions(root, fs::perms(0555));
}

std::set<std::string> FilesOf(const std::string& folder) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.insert(entry.path());
  return files;
}

TEST_F(SessionFailure, ASessionOnAReadOnlyMediumIsReadWithoutATrace) {
  {
    SessionStore store(folder_, MakeCamera());
    store.SavePhoto({0}, "a.jpg", MakeBytes(100, 1));
    store.Apply(MakeDelta(1, 0, 5));
  }
  const std::set<std::string> files = FilesOf(folder_);
  MakeReadOnly(root_);
  const int status = InChild([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return kChildCannotTry;
    const SessionStore store = SessionStore::OpenExisting(folder_);
    const bool is_read = store.Photos().size() == 1 && store.Snapshot().landmarks_set.size() == 5;
    return is_read ? kChildPassed : kChildFailed;
  });
  EXPECT_EQ(FilesOf(folder_), files);
  if (status == kChildCannotTry) GTEST_SKIP() << "cannot become an unprivileged user";
  EXPECT_EQ(status, kChildPassed);
}

// Runs a writer that leaves what it wrote in the log, for it ends without closing the database.
void RunKilledWriter(const std::string& folder) {
  ASSERT_EQ(InChild([&] {
              SessionStore store(folder, MakeCamera());
              store.SavePhoto({0}, "a.jpg", MakeBytes(100, 1));
              store.Apply(MakeDelta(1, 0, 5));
              ::_exit(kChildPassed);
              return kChildFailed;
            }),
            kChildPassed);
  ASSERT_GT(std::filesystem::file_size(folder + "/session.db-wal"), 0u);
}

TEST_F(SessionFailure, WhatAKilledWriterLeftInTheLogIsRead) {
  RunKilledWriter(folder_);
  EXPECT_EQ(SessionStore::OpenExisting(folder_).Snapshot().landmarks_set.size(), 5u);
}

TEST_F(SessionFailure, ALogThatCannotBeReadIsNotPassedOver) {
  RunKilledWriter(folder_);
  std::filesystem::remove(folder_ + "/session.db-shm");
  MakeReadOnly(root_);
  const int status = InChild([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return kChildCannotTry;
    return Check(ErrorOf([&] { SessionStore::OpenExisting(folder_).Snapshot(); }),
                 {folder_ + "/session.db", "copy the session"});
  });
  if (status == kChildCannotTry) GTEST_SKIP() << "cannot become an unprivileged user";
  EXPECT_EQ(status, kChildPassed);
}

TEST_F(SessionFailure, AReaderChangesNothingAndKeepsNoWriterOut) {
  { SessionStore store(folder_, MakeCamera()); }
  const std::set<std::string> files = FilesOf(folder_);
  {
    SessionStore reader = SessionStore::OpenExisting(folder_);
    EXPECT_THAT(ErrorOf([&] { reader.Apply(MakeDelta(1, 0, 5)); }), HasSubstr("session.db"));
    SessionStore writer(folder_, MakeCamera());
    writer.SavePhoto({0}, "a.jpg", MakeBytes(100, 1));
    writer.Apply(MakeDelta(1, 0, 5));
    EXPECT_EQ(reader.Snapshot().landmarks_set.size(), 5u);
  }
  EXPECT_EQ(FilesOf(folder_), files);
}

TEST_F(SessionFailure, AFolderWithSignsOfAUriIsRead) {
  const std::string folder = folder_ + "/50% #1?mode=rw";
  { SessionStore store(folder, MakeCamera()); }
  EXPECT_EQ(SessionStore::OpenExisting(folder).NextPhotoId(), PhotoId{0});
  MakeReadOnly(root_);
  const int status = InChild([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return kChildCannotTry;
    const PhotoId next = SessionStore::OpenExisting(folder).NextPhotoId();
    return next == PhotoId{0} ? kChildPassed : kChildFailed;
  });
  if (status == kChildCannotTry) GTEST_SKIP() << "cannot become an unprivileged user";
  EXPECT_EQ(status, kChildPassed);
}

TEST_F(SessionFailure, AFullDiskIsNamedWithItsCureAndLosesNothingWritten) {
  std::filesystem::create_directories(folder_);
  const int status = InChild([&] {
    if (::unshare(CLONE_NEWNS) != 0 ||
        ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=3m") != 0) {
      return kChildCannotTry;
    }
    SessionStore store(folder_, MakeCamera());
    std::uint32_t saved = 0;
    const std::string error = ErrorOf([&] {
      for (; saved < 100; ++saved) {
        store.SavePhoto({saved}, std::to_string(saved), MakeBytes(100, saved));
        store.SaveAnalysis({saved}, Timestamp{}, MakeAnalysis(1000, saved));
      }
    });
    if (Check(error, {folder_ + "/session.db", "full", "free some space"}) != kChildPassed) {
      return kChildFailed;
    }
    for (std::uint32_t i = 0; i < saved; ++i) {
      if (store.LoadFeatures({i}).size() != 1000) return kChildFailed;
    }
    const std::string photo_error =
        ErrorOf([&] { store.SavePhoto({1000}, "large.jpg", MakeBytes(4000000, 1)); });
    return Check(photo_error, {folder_ + "/photos/large.jpg", "free some space"});
  });
  if (status == kChildCannotTry) GTEST_SKIP() << "cannot mount a small disk here";
  EXPECT_EQ(status, kChildPassed);
}

TEST_F(SessionFailure, AWriteTheSystemRefusesIsNamedWithItsCure) {
  const int status = InChild([&] {
    SessionStore store(folder_, MakeCamera());
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {1 << 20, 1 << 20};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    return Check(ErrorOf([&] {
                   for (std::uint32_t i = 0; i < 100; ++i) {
                     store.SavePhoto({i}, std::to_string(i), MakeBytes(100, i));
                     store.SaveAnalysis({i}, Timestamp{}, MakeAnalysis(1000, i));
                   }
                 }),
                 {folder_ + "/session.db", "check its space"});
  });
  EXPECT_EQ(status, kChildPassed);
}

// Photos, features, verdicts and deltas without an end.
[[noreturn]] void WriteForever(const std::string& folder, int ready) {
  SessionStore store(folder, MakeCamera());
  for (std::uint32_t i = store.NextPhotoId().value;; ++i) {
    store.SavePhoto({i}, "photo.jpg", MakeBytes(20000, i));
    store.SaveAnalysis({i}, Timestamp{1}, MakeAnalysis(300, i));
    PhotoVerdict verdict;
    verdict.photo = {i};
    store.SaveVerdict(verdict);
    store.Apply(MakeDelta(store.Snapshot().sequence + 1, i, 200));
    if (::write(ready, "x", 1) != 1) ::_exit(kChildFailed);
  }
}

// Starts a writer, lets it finish one photo, and kills it somewhere in a later one.
void WriteAndKill(const std::string& folder, useconds_t delay_us) {
  int channel[2];
  ASSERT_EQ(::pipe(channel), 0);
  const pid_t child = ::fork();
  if (child == 0) WriteForever(folder, channel[1]);
  ::close(channel[1]);
  char one_photo = 0;
  EXPECT_EQ(::read(channel[0], &one_photo, 1), 1) << "the writer died by itself";
  ::usleep(delay_us);  // Any moment will do; a different one each time.
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(channel[0]);
}

TEST_F(SessionFailure, AKillAtAnyMomentLeavesAConsistentSessionThatGoesOn) {
  for (useconds_t kill = 0; kill < 12; ++kill) {
    WriteAndKill(folder_, kill * 1700);
    SessionStore store(folder_, MakeCamera());
    const std::vector<StoredPhoto> photos = store.Photos();
    ASSERT_GT(photos.size(), kill);
    for (const StoredPhoto& photo : photos) {
      EXPECT_EQ(std::filesystem::file_size(store.photos().PathOf(photo.name)), photo.num_bytes);
      EXPECT_EQ(store.LoadFeatures(photo.id).size(), photo.analysis ? 300u : 0u);
    }
    const MapDelta snapshot = store.Snapshot();
    EXPECT_EQ(snapshot.sequence, snapshot.views_set.size());
    std::map<PhotoId, int> observations;
    for (const ObservationState& seen : snapshot.observations_added) ++observations[seen.photo];
    for (const ViewState& view : snapshot.views_set) EXPECT_EQ(observations[view.photo], 200);
    EXPECT_GE(store.LatestVerdicts().size(), snapshot.views_set.size());
  }
}

}  // namespace
}  // namespace plumb
