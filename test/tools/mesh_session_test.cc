// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/mesh_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "plumbline/evaluation/ply_reader.h"
#include "test/map/session_fixture.h"
#include "test/surface/simple_maps.h"

namespace plumb::tools {
namespace {

using MeshSessionTest = SessionTest;

SurfaceOptions WideOptions() {
  SurfaceOptions options;
  options.max_edge_ratio = 0.2;
  return options;
}

TEST_F(MeshSessionTest, WritesTheMeshAndTellsWhatItTook) {
  SessionStore store(folder_, MakeCamera());
  const MapDelta wall = test::SimpleMap::Wall().Snapshot();
  for (const ViewState& view : wall.views_set) {
    store.SavePhoto(view.photo, std::to_string(view.photo.value) + ".jpg", MakeBytes(10, 1));
  }
  store.Apply(wall);
  const nlohmann::ordered_json report = MeshSession(WideOptions(), store, folder_ + "/export");
  EXPECT_EQ(report.at("vertices"), 400);
  EXPECT_EQ(report.at("rays"), 4000);
  EXPECT_GT(report.at("faces"), 300);
  EXPECT_TRUE(report.at("problems").empty());
  const TriangleMesh mesh = ReadPlyMesh(folder_ + "/export/mesh.ply");
  EXPECT_EQ(mesh.triangles.size(), report.at("faces"));
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/export/mesh.obj"));
}

TEST_F(MeshSessionTest, OfAnEmptySessionIsAnEmptyMesh) {
  const SessionStore store(folder_, MakeCamera());
  const nlohmann::ordered_json report = MeshSession(WideOptions(), store, folder_ + "/export");
  EXPECT_EQ(report.at("faces"), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/export/mesh.ply"));
}

}  // namespace
}  // namespace plumb::tools
