// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/export_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ExportFolderTest : public testing::Test {
 protected:
  ExportFolderTest() {
    std::string pattern = testing::TempDir() + "export_folder_XXXXXX";
    root_ = ::mkdtemp(pattern.data());
    fs::create_directory(root_ + "/colmap");
  }
  ~ExportFolderTest() override { fs::remove_all(root_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(root_ + '/' + name) << text;
  }
  bool Has(const std::string& name) const { return fs::exists(root_ + '/' + name); }

  std::string root_;
};

TEST_F(ExportFolderTest, DeletesWhatItWroteOfAnotherState) {
  Write("colmap/images.txt", "1");
  Write("points.ply", "2");
  Write("gcp_list.txt", "3");
  ExportFolder(root_).Add({"colmap/images.txt", "points.ply"}, "map 1");
  ExportFolder(root_).Add({"gcp_list.txt"}, "");
  EXPECT_THAT(ExportFolder(root_).DeleteStale("map 1"), IsEmpty());
  EXPECT_TRUE(Has("points.ply"));
  Write("points.ply", "4");
  ExportFolder files(root_);
  files.Add({"points.ply"}, "map 2");
  EXPECT_THAT(files.DeleteStale("map 2"),
              ElementsAre(HasSubstr("deleted " + root_ + "/colmap/images.txt")));
  EXPECT_FALSE(Has("colmap"));  // Nothing else was in it.
  EXPECT_TRUE(Has("points.ply"));
  EXPECT_TRUE(Has("gcp_list.txt"));                                                // Of any map,
  EXPECT_THAT(files.Delete({"gcp_list.txt"}), ElementsAre(HasSubstr("deleted")));  // until asked.
  EXPECT_THAT(files.Delete({"gcp_list.txt"}), IsEmpty());
  EXPECT_THAT(ExportFolder(root_).DeleteStale("map 2"), IsEmpty());
}

TEST_F(ExportFolderTest, KeepsWhatAPersonWroteOrChanged) {
  Write("points.ply", "ours");
  Write("mesh.obj", "a person's");
  Write("notes.txt", "a person's");
  Write("colmap/images.txt", "ours");
  Write("colmap/project.ini", "a person's");
  ExportFolder(root_).Add({"points.ply", "colmap/images.txt"}, "map 1");
  Write("points.ply", "cleaned by hand");
  EXPECT_THAT(ExportFolder(root_).DeleteStale("map 2"),
              ElementsAre(HasSubstr("deleted " + root_ + "/colmap/images.txt"),
                          HasSubstr("kept, as Plumbline did not write it like this: points.ply, "
                                    "mesh.obj; it may be")));
  for (const char* name : {"points.ply", "mesh.obj", "notes.txt", "colmap/project.ini"}) {
    EXPECT_TRUE(Has(name)) << name;
  }
}

TEST_F(ExportFolderTest, SetsAsideWhatAPersonWroteOrChanged) {
  Write("points.ply", "ours");
  Write("colmap/images.txt", "ours");
  ExportFolder(root_).Add({"points.ply", "colmap/images.txt"}, "map 1");
  Write("points.ply", "cleaned by hand");
  Write("mesh.obj", "a person's");
  Write("mesh.obj.kept1", "from before");
  ExportFolder files(root_);
  const std::vector<std::string> names = {
      "colmap/images.txt", "points.ply", "mesh.obj", "frame.json"};
  EXPECT_THAT(
      files.SetAside(names),
      ElementsAre(HasSubstr(root_ + "/points.ply.kept1"), HasSubstr(root_ + "/mesh.obj.kept2")));
  EXPECT_TRUE(Has("colmap/images.txt"));
  EXPECT_FALSE(Has("points.ply"));
  EXPECT_TRUE(Has("points.ply.kept1"));
  EXPECT_TRUE(Has("mesh.obj.kept2"));
  EXPECT_THAT(files.SetAside(names), IsEmpty());
}

TEST_F(ExportFolderTest, ADamagedListDeletesNothing) {
  Write("points.ply", "ours");
  Write("../outside.txt", "a person's");
  ExportFolder(root_).Add({"points.ply"}, "map 1");
  for (const char* list : {"",
                           "{",
                           "[1, 2]",
                           "{\"points.ply\": 7}",
                           "{\"points.ply\": {\"of\": 1}}",
                           "{\"points.ply\": {\"of\": \"map 1\", \"fingerprint\": \"\"}}",
                           "{\"../outside.txt\": {\"of\": \"map 1\", \"fingerprint\": \"\"}}",
                           "{\"/etc/passwd\": {\"of\": \"map 1\", \"fingerprint\": \"\"}}",
                           "{\"\": {\"of\": \"map 1\", \"fingerprint\": \"\"}}",
                           "{\"colmap\": {\"of\": \"map 1\", \"fingerprint\": \"\"}}"}) {
    Write("plumbline_files.json", list);
    EXPECT_THAT(ExportFolder(root_).DeleteStale("map 2"),
                ElementsAre(HasSubstr("like this: points.ply; it may be")))
        << list;
    EXPECT_TRUE(Has("points.ply")) << list;
  }
  fs::remove(root_ + "/../outside.txt");
}

TEST_F(ExportFolderTest, AStateIsOfTheMapAndTheGeoreference) {
  EXPECT_NE(ExportState(1, false, ""), ExportState(2, false, ""));
  EXPECT_NE(ExportState(1, false, ""), ExportState(1, true, ""));
  const std::string path = root_ + "/georeference.json";
  Write("georeference.json", "one");
  const std::string one = ExportState(1, false, path);
  EXPECT_NE(one, ExportState(1, false, ""));
  EXPECT_EQ(one, ExportState(1, false, path));
  Write("georeference.json", "two");
  EXPECT_NE(one, ExportState(1, false, path));
}

}  // namespace
}  // namespace plumb::tools
