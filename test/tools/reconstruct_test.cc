// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "plumbline/common/atomic_file.h"
#include "plumbline/evaluation/pose_evaluation.h"
#include "plumbline/map/session_store.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr char kCameraYaml[] =
    "image_width: 640\nimage_height: 480\ncamera_name: test\n"
    "camera_matrix: {rows: 3, cols: 3, data: [600, 0, 319.5, 0, 600, 239.5, 0, 0, 1]}\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n";

class ReconstructTest : public testing::Test {
 protected:
  ReconstructTest() {
    std::string pattern = testing::TempDir() + "reconstruct_XXXXXX";
    root_ = ::mkdtemp(pattern.data());
    fs::create_directory(root_ / "photos");
    std::ofstream(root_ / "camera.yaml") << kCameraYaml;
    arguments_.photos = (root_ / "photos").string();
    arguments_.camera = (root_ / "camera.yaml").string();
    arguments_.session = (root_ / "session").string();
  }
  ~ReconstructTest() override { fs::remove_all(root_); }

  void WritePhoto(const std::string& name, const std::string& bytes) {
    std::ofstream(root_ / "photos" / name) << bytes;
  }

  ExitCode Run(const std::atomic<bool>& stop = false) {
    std::ostringstream out;
    ExitCode code;
    {
      Console console(&out, /*is_terminal=*/false);
      code = Reconstruct(arguments_, stop, &console);
    }
    output_ = out.str();
    return code;
  }

  std::string ErrorOf() {
    try {
      Run();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  static std::string TextOf(const std::string& path) {
    const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
    return {bytes.begin(), bytes.end()};
  }

  nlohmann::json Report() const {
    return nlohmann::json::parse(std::ifstream(arguments_.session + "/report.json"));
  }

  // Takes the first photos of a shared scene; false where it is absent.
  bool UseSharedScene(const std::string& scene, int num_photos) {
    const char* data = std::getenv("PLUMBLINE_DATA");
    const fs::path root = data ? data : PLUMBLINE_SOURCE_DIR "/../shared/data";
    if (!fs::exists(root / scene)) return false;
    arguments_.camera = (root / scene / "camera.yaml").string();
    for (int i = 0; i < num_photos; ++i) {
      const std::string name = "000" + std::to_string(i) + ".jpg";
      fs::create_symlink(root / scene / "photos" / name, root_ / "photos" / name);
    }
    return true;
  }

  fs::path root_;
  ReconstructArguments arguments_;
  std::string output_;
};

TEST_F(ReconstructTest, GivesEveryBadPhotoAVerdictAndGoesOn) {
  WritePhoto("empty.jpg", "");
  WritePhoto("notes.jpg", "not a photo");
  WritePhoto("truncated.jpg", std::string("\xff\xd8\xff\xe0\x00\x10JFIF", 10));
  EXPECT_EQ(Run(), kNothingLocated);
  const nlohmann::json report = Report();
  EXPECT_EQ(report["session"]["photos"], 3);
  EXPECT_EQ(report["session"]["refused"], 3);
  std::set<std::string> names;
  for (const auto& photo : report["photos"]) {
    EXPECT_EQ(photo["reason"], "undecodable") << photo;
    EXPECT_FALSE(photo["hint"].get<std::string>().empty()) << photo;
    names.insert(photo["name"]);
    EXPECT_THAT(output_, HasSubstr(photo["name"].get<std::string>() + ": refused, undecodable"));
  }
  EXPECT_THAT(names, testing::ElementsAre("empty.jpg", "notes.jpg", "truncated.jpg"));
  EXPECT_EQ(TextOf(arguments_.session + "/photos/notes.jpg"), "not a photo");
  EXPECT_TRUE(fs::exists(arguments_.session + "/export/colmap/images.txt"));
  EXPECT_TRUE(fs::exists(arguments_.session + "/export/points.ply"));
  EXPECT_THAT(output_, Not(HasSubstr("scale")));  // There is no map that could have one.
}

TEST_F(ReconstructTest, LeavesWhatIsNoPhotoOutOfTheSessionAndSaysSo) {
  WritePhoto("a.jpg", "first");
  for (const char* name : {"DJI_1.MP4", "DJI_1.SRT", "notes.txt", "Thumbs.db", ".DS_Store"}) {
    WritePhoto(name, "x");
  }
  Run();
  EXPECT_THAT(output_, HasSubstr("1 .db, 1 .mp4, 1 .srt, 1 .txt, 1 hidden"));
  EXPECT_EQ(Report()["session"]["photos"], 1);
  EXPECT_FALSE(fs::exists(arguments_.session + "/photos/notes.txt"));
}

TEST_F(ReconstructTest, AFileThatCannotBeReadIsNamedAndTakenOnceItCan) {
  fs::create_symlink(root_ / "card" / "a.jpg", root_ / "photos" / "a.jpg");
  WritePhoto("b.jpg", "second");
  Run();
  EXPECT_THAT(output_, HasSubstr("a.jpg: not taken: "));
  EXPECT_THAT(output_, HasSubstr("is a link to " + (root_ / "card" / "a.jpg").string()));
  EXPECT_EQ(Report()["session"]["photos"], 1);
  EXPECT_EQ(Report()["run"]["unread"].size(), 1u);
  EXPECT_FALSE(fs::exists(arguments_.session + "/photos/a.jpg"));
  fs::create_directory(root_ / "card");
  std::ofstream(root_ / "card" / "a.jpg") << "first";
  Run();
  EXPECT_EQ(Report()["session"]["photos"], 2);
  EXPECT_TRUE(Report()["run"]["unread"].empty());
  EXPECT_TRUE(fs::exists(arguments_.session + "/photos/a.jpg"));
}

TEST_F(ReconstructTest, TakesPhotosOfSubfoldersAndTellsThoseOfOneNameApart) {
  fs::create_directories(root_ / "photos" / "DCIM" / "100MEDIA");
  fs::create_directories(root_ / "photos" / "DCIM" / "101MEDIA");
  WritePhoto("DCIM/100MEDIA/a.jpg", "first");
  WritePhoto("DCIM/101MEDIA/a.jpg", "second");
  Run();
  EXPECT_THAT(output_, HasSubstr("DCIM/100MEDIA/ (1), DCIM/101MEDIA/ (1)"));
  const SessionStore store = SessionStore::OpenExisting(arguments_.session);
  std::vector<std::string> names;
  for (const StoredPhoto& photo : store.Photos()) names.push_back(photo.name);
  EXPECT_THAT(names, testing::ElementsAre("a.jpg", "101MEDIA_a.jpg"));
  Run();
  EXPECT_THAT(output_, HasSubstr("2 files in the session already"));
}

TEST_F(ReconstructTest, RefusesASessionThatIsMixedUpWithThePhotos) {
  WritePhoto("a.jpg", "first");
  const std::string photos = arguments_.photos;
  const std::string session = arguments_.session;
  arguments_.session = photos + "/";
  EXPECT_THAT(ErrorOf(), HasSubstr("is the folder of the photos"));
  arguments_.session = photos + "/a.jpg";
  EXPECT_THAT(ErrorOf(), HasSubstr("a.jpg: is a file; a session is a folder"));
  arguments_.session = root_.string();
  EXPECT_THAT(ErrorOf(), HasSubstr("lies inside the session"));
  arguments_.session = session;
  Run();
  arguments_.photos = session + "/photos";
  EXPECT_THAT(ErrorOf(), HasSubstr("lies inside the session"));
  EXPECT_FALSE(fs::exists(photos + "/session.db"));

  arguments_.photos = photos;
  arguments_.session = photos + "/session";  // Below the photos it is told apart from them.
  Run();
  Run();
  EXPECT_EQ(Report()["session"]["photos"], 1);
}

TEST_F(ReconstructTest, ASecondRunTakesOnlyWhatIsNew) {
  WritePhoto("a.jpg", "first");
  WritePhoto("b.jpg", "second");
  Run();
  WritePhoto("b.jpg", "another under the same name");
  WritePhoto("c.jpg", "third");
  Run();
  EXPECT_THAT(output_, HasSubstr("1 file in the session already"));
  const SessionStore store = SessionStore::OpenExisting(arguments_.session);
  std::vector<std::string> names;
  for (const StoredPhoto& photo : store.Photos()) names.push_back(photo.name);
  EXPECT_THAT(names, testing::ElementsAre("a.jpg", "b.jpg", "b_2.jpg", "c.jpg"));
  EXPECT_EQ(store.LatestVerdicts().size(), 4u);
}

TEST_F(ReconstructTest, WithNothingNewAllStaysAsItIs) {
  WritePhoto("a.jpg", "first");
  Run();
  EXPECT_THAT(output_, Not(HasSubstr("nothing new")));
  const std::string report = TextOf(arguments_.session + "/report.json");
  EXPECT_EQ(Run(), kNothingLocated);
  EXPECT_THAT(output_, HasSubstr("nothing new"));
  EXPECT_EQ(TextOf(arguments_.session + "/report.json"), report);

  arguments_.settings = {"localizer.num_views=12"};
  Run();
  EXPECT_THAT(output_, Not(HasSubstr("nothing new"))) << "other options, another map";
  WriteFileAtomically(arguments_.session + "/report.json", "{\"run\": 5");
  Run();
  EXPECT_THAT(output_, Not(HasSubstr("nothing new"))) << "the report says nothing";
  EXPECT_EQ(Report()["session"]["photos"], 1);
}

TEST_F(ReconstructTest, FinishesFirstWhatWasCutOff) {
  WritePhoto("a.jpg", "first");
  {
    SessionStore store(arguments_.session, ReadCameraYaml(arguments_.camera));
    store.SavePhoto({0}, "cut_off.jpg", {'x'});  // No analysis, no verdict.
  }
  WritePhoto("cut_off.jpg", "x");
  Run();
  EXPECT_THAT(output_, Not(HasSubstr("in the session already"))) << "it was answered only now";
  const SessionStore store = SessionStore::OpenExisting(arguments_.session);
  const std::vector<PhotoVerdict> verdicts = store.AllVerdicts();
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[0].name, "cut_off.jpg");
  EXPECT_EQ(verdicts[0].photo, PhotoId{0});
  EXPECT_EQ(verdicts[1].name, "a.jpg");
  EXPECT_EQ(verdicts[1].photo, PhotoId{1});
  EXPECT_EQ(store.Photos().size(), 2u);
}

TEST_F(ReconstructTest, StopsBetweenPhotosAndKeepsWhatThereIs) {
  WritePhoto("a.jpg", "first");
  EXPECT_EQ(Run(/*stop=*/true), kInterrupted);
  EXPECT_EQ(Report()["run"]["interrupted"], true);
  EXPECT_THAT(output_,
              testing::EndsWith("interrupted: 1 of 1 photo not yet looked at; the same "
                                "command goes on\n"));
  EXPECT_EQ(Run(), kNothingLocated);
  EXPECT_EQ(Report()["run"]["interrupted"], false);
  EXPECT_EQ(Report()["session"]["photos"], 1);
}

TEST_F(ReconstructTest, WhatIsWrongWithTheArgumentsIsNamedBeforeASessionIsMade) {
  EXPECT_THAT(ErrorOf(), HasSubstr(arguments_.photos + ": holds no photo"));
  WritePhoto("a.jpg", "first");
  arguments_.order = "sideways";
  EXPECT_THAT(ErrorOf(), HasSubstr("sideways"));
  arguments_.order = "name";
  arguments_.settings = {"localizer.max_error_px=-1"};
  EXPECT_THAT(ErrorOf(), HasSubstr("localizer.max_error_px"));
  arguments_.settings.clear();
  arguments_.options = (root_ / "options.yaml").string();
  EXPECT_THAT(ErrorOf(), HasSubstr(arguments_.options));
  std::ofstream(arguments_.options) << "bundle: {huber_width_px: wide}";
  EXPECT_THAT(ErrorOf(), HasSubstr(arguments_.options + ": bundle.huber_width_px"));
  arguments_.options.clear();
  arguments_.camera = (root_ / "absent.yaml").string();
  EXPECT_THAT(ErrorOf(), HasSubstr(arguments_.camera));
  EXPECT_FALSE(fs::exists(arguments_.session));
}

TEST_F(ReconstructTest, TheSamePhotosInTheSameOrderGiveTheSameMap) {
  if (!UseSharedScene("Herz-Jesus-P8", 5)) GTEST_SKIP() << "set PLUMBLINE_DATA to the shared data";
  EXPECT_EQ(Run(), kDone);
  EXPECT_THAT(output_, testing::EndsWith("survey, then export again\n"));
  const std::string first = arguments_.session;
  EXPECT_THAT(TextOf(first + "/export/points.ply"), HasSubstr("\ncomment scale: none"));
  arguments_.session += "2";
  EXPECT_EQ(Run(), kDone);
  for (const char* file : {"cameras.txt", "images.txt", "points3D.txt"}) {
    const std::string name = std::string("/export/colmap/") + file;
    EXPECT_EQ(ReadFileBytes(first + name), ReadFileBytes(arguments_.session + name)) << file;
  }
  EXPECT_EQ(Run(), kDone);
  EXPECT_THAT(output_, HasSubstr("nothing new"));
  const std::string points = "/export/colmap/points3D.txt";
  EXPECT_EQ(ReadFileBytes(first + points), ReadFileBytes(arguments_.session + points));
}

TEST_F(ReconstructTest, AKilledRunGoesOnAndLocatesEveryPhotoOnce) {
  if (!UseSharedScene("Herz-Jesus-P8", 6)) GTEST_SKIP() << "set PLUMBLINE_DATA to the shared data";
  int channel[2];
  ASSERT_EQ(::pipe(channel), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(channel[1], STDOUT_FILENO);
    const std::atomic<bool> stop{false};
    std::ostream out(std::cout.rdbuf());
    Console console(&out, false);
    Reconstruct(arguments_, stop, &console);
    ::_exit(0);
  }
  ::close(channel[1]);
  std::string heard;
  char character = 0;
  while (heard.find("0003.jpg: ") == std::string::npos && ::read(channel[0], &character, 1) == 1) {
    heard += character;
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(channel[0]);
  ASSERT_FALSE(fs::exists(arguments_.session + "/report.json")) << "it was not killed in time";

  EXPECT_EQ(Run(), kDone);
  const SessionStore store = SessionStore::OpenExisting(arguments_.session);
  std::multiset<std::string> names;
  for (const StoredPhoto& photo : store.Photos()) names.insert(photo.source_name);
  EXPECT_THAT(
      names,
      testing::ElementsAre("0000.jpg", "0001.jpg", "0002.jpg", "0003.jpg", "0004.jpg", "0005.jpg"));
  for (const PhotoVerdict& verdict : store.LatestVerdicts()) {
    EXPECT_EQ(verdict.status, VerdictStatus::kAccepted) << verdict.name;
  }
  EXPECT_EQ(store.Snapshot().views_set.size(), 6u);
}

}  // namespace
}  // namespace plumb::tools
