// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/mesh_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "plumbline/common/atomic_file.h"
#include "plumbline/evaluation/ply_reader.h"
#include "plumbline/georeference/georeference_file.h"
#include "test/map/session_fixture.h"
#include "test/surface/simple_maps.h"
#include "tools/export_session.h"
#include "tools/georeference.h"
#include "tools/session_frame.h"

namespace plumb::tools {
namespace {

using MeshSessionTest = SessionTest;

SurfaceOptions WideOptions() {
  SurfaceOptions options;
  options.max_edge_ratio = 0.2;
  return options;
}

SessionStore MakeWallSession(const std::string& folder) {
  SessionStore store(folder, MakeCamera());
  const MapDelta wall = test::SimpleMap::Wall().Snapshot();
  for (const ViewState& view : wall.views_set) {
    store.SavePhoto(view.photo, std::to_string(view.photo.value) + ".jpg", MakeBytes(10, 1));
  }
  store.Apply(wall);
  return store;
}

Similarity3 EnuFromMap() {
  return {
      2.5, Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ())), {3.0, -7.0, 1.0}};
}

// Of the session's map, in `crs` about `origin`.
void Georeference(const SessionStore& store,
                  const std::string& crs,
                  const Eigen::Vector3d& origin) {
  plumb::Georeference georeference;
  georeference.source = GeoreferenceSource::kTargets;
  georeference.map_sequence = store.Snapshot().sequence;
  georeference.enu_from_map = EnuFromMap();
  georeference.frame = GeoFrame(crs, HeightReference::kEllipsoidal, origin);
  std::filesystem::create_directories(store.folder() + "/export");
  std::ofstream(GeoreferencePath(store.folder())) << ToJson(georeference);
}

std::string TextOf(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  return {bytes.begin(), bytes.end()};
}

TEST_F(MeshSessionTest, WritesTheMeshAndTellsWhatItTook) {
  const SessionStore store = MakeWallSession(folder_);
  const nlohmann::ordered_json report =
      MeshSession(WideOptions(), store, ReadSessionMap(store), folder_ + "/export");
  EXPECT_EQ(report.at("vertices"), 400);
  EXPECT_EQ(report.at("rays"), 4000);
  EXPECT_GT(report.at("faces"), 300);
  EXPECT_TRUE(report.at("problems").empty());
  const TriangleMesh mesh = ReadPlyMesh(folder_ + "/export/mesh.ply");
  EXPECT_EQ(mesh.triangles.size(), report.at("faces"));
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/export/mesh.obj"));
}

TEST_F(MeshSessionTest, FollowsTheGeoreferenceAsThePointsDo) {
  struct Place {
    std::string crs;
    Eigen::Vector3d origin;
    std::string frame;
  };
  const SessionStore store = MakeWallSession(folder_);
  const std::string folder = folder_ + "/export";
  MeshSession(WideOptions(), store, ReadSessionMap(store), folder);
  const std::vector<Eigen::Vector3d> in_map = ReadPlyMesh(folder + "/mesh.ply").vertices;
  for (const Place& place :
       {Place{"EPSG:32633", {532110.0, 5212350.0, 360.0}, "EPSG:32633 less 532110 5212350 360"},
        Place{"EPSG:4979", {15.4, 47.06, 400.0}, "enu about 15.4 47.06 400"}}) {
    Georeference(store, place.crs, place.origin);
    const nlohmann::ordered_json report =
        MeshSession(WideOptions(), store, ReadSessionMap(store), folder);
    EXPECT_EQ(report.at("frame"), place.frame + ", metres");
    ExportSession(store, ReadSessionMap(store), folder);
    const GeoFrame frame(place.crs, HeightReference::kEllipsoidal, place.origin);
    const std::vector<Eigen::Vector3d> vertices = ReadPlyMesh(folder + "/mesh.ply").vertices;
    ASSERT_EQ(vertices.size(), in_map.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      Eigen::Vector3d expected = EnuFromMap() * in_map[i];
      if (!frame.is_geographic()) expected = frame.ToCrs(expected) - place.origin;
      EXPECT_LT((vertices[i] - expected).norm(), 1e-8);
      EXPECT_LT(vertices[i].norm(), 50.0);  // No large coordinate.
    }
    const std::vector<std::string> comments = ReadPlyComments(folder + "/mesh.ply");
    std::vector<std::string> of_points = ReadPlyComments(folder + "/points.ply");
    of_points[0] = "Plumbline mesh";
    EXPECT_EQ(comments, of_points);
    EXPECT_THAT(TextOf(folder + "/mesh.obj"), testing::HasSubstr("# crs: " + place.crs + "\n"));
    EXPECT_THAT(TextOf(folder + "/frame.json"), testing::HasSubstr("\"mesh.ply\""));
    // And evaluate finds the map again.
    const std::vector<Eigen::Vector3d> back =
        BroughtIntoMap(folder + "/mesh.ply", comments, vertices);
    for (std::size_t i = 0; i < back.size(); ++i) {
      EXPECT_LT((back[i] - in_map[i]).norm(), 1e-7) << place.crs;
    }
  }
}

TEST_F(MeshSessionTest, AMeshWhoseHeaderIsDamagedIsRefused) {
  const std::vector<Eigen::Vector3d> points = {{1, 2, 3}};
  EXPECT_EQ(BroughtIntoMap("mesh.ply", {"made by hand"}, points), points);
  EXPECT_EQ(BroughtIntoMap("mesh.ply", {"frame: map"}, points), points);
  for (const char* similarity : {"", "1 1 0 0 0 0 0", "-1 1 0 0 0 0 0 0", "1 9 0 0 0 0 0 0", "x"}) {
    try {
      BroughtIntoMap("mesh.ply",
                     {"frame: crs less offset, metres",
                      "crs: local",
                      "heights: local",
                      "offset: 1 2 3",
                      std::string("enu_from_map: ") + similarity},
                     points);
      ADD_FAILURE() << similarity;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("mesh.ply: what its header says of the frame"));
      EXPECT_THAT(error.what(), testing::HasSubstr("run plumbline mesh again"));
    }
  }
}

TEST_F(MeshSessionTest, FilesOfAnotherGeoreferenceDoNotStayBeside) {
  const SessionStore store = MakeWallSession(folder_);
  const std::string folder = folder_ + "/export";
  Georeference(store, "EPSG:32633", {532110.0, 5212350.0, 360.0});
  ExportSession(store, ReadSessionMap(store), folder);
  EXPECT_TRUE(MeshSession(WideOptions(), store, ReadSessionMap(store), folder).at("stale").empty());
  Georeference(store, "EPSG:31256", {-68110.0, 212350.0, 360.0});
  std::ofstream(folder + "/mesh.obj", std::ios::app) << "# smoothed by hand\n";
  const std::vector<std::string> lines = ExportSession(store, ReadSessionMap(store), folder).lines;
  EXPECT_THAT(lines, testing::Contains(testing::HasSubstr("deleted " + folder + "/mesh.ply")));
  EXPECT_THAT(lines,
              testing::Contains(testing::HasSubstr(
                  folder + ": kept, as Plumbline did not write it like this: mesh.obj")));
  EXPECT_FALSE(std::filesystem::exists(folder + "/mesh.ply"));
  EXPECT_THAT(TextOf(folder + "/mesh.obj"), testing::HasSubstr("smoothed by hand"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/points.ply"));
}

TEST_F(MeshSessionTest, OfAnEmptySessionThereIsNone) {
  const SessionStore store(folder_, MakeCamera());
  const nlohmann::ordered_json report =
      MeshSession(WideOptions(), store, ReadSessionMap(store), folder_ + "/export");
  EXPECT_EQ(report.at("faces"), 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/export"));
}

TEST_F(MeshSessionTest, NamesAFolderThatIsAFile) {
  const SessionStore store = MakeWallSession(folder_);
  std::ofstream(folder_ + "/mesh") << "text";
  try {
    MeshSession(WideOptions(), store, ReadSessionMap(store), folder_ + "/mesh");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(folder_ + "/mesh: cannot make this folder"));
  }
}

}  // namespace
}  // namespace plumb::tools
