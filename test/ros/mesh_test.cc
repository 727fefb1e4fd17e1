// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Messages and markers of the mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "ros/mesh_conversion.h"
#include "ros/mesh_drawing.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using visualization_msgs::Marker;

QualityBlock TwoFaces() {
  QualityBlock block;
  block.mesh.id = {-1, 2, 3};
  for (std::uint32_t i = 0; i < 4; ++i) {
    block.mesh.vertices.push_back(
        {LandmarkId{10 + i}, {0.1 * i, 1e5 + 1e-9, i % 2 == 0 ? 0.0 : 1.0}, {1, 2, 3}});
  }
  block.mesh.faces = {{0, 1, 2}, {1, 3, 2}};
  block.shapes = ShapesOf(block.mesh);
  block.qualities.resize(2);
  block.qualities[1].gsd = 0.002F;
  block.qualities[1].sigma_per_px = 0.001F;
  block.qualities[1].num_views = 7;
  return block;
}

Measure MakeMeasure() { return {1.0, 1000.0, 0.5}; }

std_msgs::Header MakeHeader() {
  std_msgs::Header header;
  header.frame_id = "map";
  return header;
}

TEST(MeshBlockMsg, HasTheBlockToTheLastBit) {
  const QualityBlock block = TwoFaces();
  const plumbline::MeshBlock msg = ToMeshBlockMsg(block);
  EXPECT_EQ(BlockId({msg.x, msg.y, msg.z}), block.mesh.id);
  EXPECT_THAT(msg.landmarks, ElementsAre(10, 11, 12, 13));
  ASSERT_EQ(msg.positions_in_map.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    const auto axis = static_cast<Eigen::Index>(i % 3);
    EXPECT_EQ(msg.positions_in_map[i], block.mesh.vertices[i / 3].position_in_map[axis]);
  }
  EXPECT_THAT(msg.colors_rgb, ElementsAre(1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3));
  EXPECT_THAT(msg.faces, ElementsAre(0, 1, 2, 1, 3, 2));
  EXPECT_THAT(msg.gsd, ElementsAre(std::numeric_limits<float>::infinity(), 0.002F));
  EXPECT_THAT(msg.sigma_per_px, ElementsAre(std::numeric_limits<float>::infinity(), 0.001F));
  EXPECT_THAT(msg.num_views, ElementsAre(0, 7));
}

TEST(DrawBlock, IsAListOfTrianglesWithAColourEach) {
  const Marker marker =
      DrawBlock(TwoFaces(), Layer::kRedundancy, Palette::kPaper, MakeMeasure(), 5, MakeHeader());
  EXPECT_EQ(marker.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(marker.ns, "redundancy");
  EXPECT_EQ(marker.id, 5);
  ASSERT_EQ(marker.points.size(), 6U);
  ASSERT_EQ(marker.colors.size(), 2U);  // RViz takes a third of the points for one a face.
  EXPECT_EQ(marker.points[4].x, 0.1 * 3);
  EXPECT_NEAR(marker.colors[0].r, marker.colors[0].b, 1e-6);  // Unseen: grey.
  EXPECT_GT(std::abs(marker.colors[1].r - marker.colors[1].b), 0.05);
}

TEST(DrawBlock, ShadesByTheNormal) {
  QualityBlock block = TwoFaces();
  block.shapes[0].normal_in_map = {0, -1, 0};
  block.shapes[1].normal_in_map = {0, 1, 0};
  const Marker marker =
      DrawBlock(block, Layer::kPlain, Palette::kPaper, MakeMeasure(), 0, MakeHeader());
  EXPECT_GT(marker.colors[0].g, 1.5F * marker.colors[1].g);
  EXPECT_GT(marker.colors[1].g, 0.2F);
}

TEST(DrawBlock, DeletesABlockWithoutFaces) {
  EXPECT_EQ(DrawBlock({}, Layer::kGsd, Palette::kPaper, MakeMeasure(), 1, MakeHeader()).action,
            Marker::DELETE);
}

Gap MakeGap() {
  Gap gap;
  gap.center_in_map = {1, 2, 3};
  gap.normal_in_map = {0, -1, 0};
  gap.camera_in_map = {1, -3, 3};
  gap.area = 2.0;
  return gap;
}

std::map<PhotoId, Rigid3> OneView() {
  return {{PhotoId{3}, Rigid3(Eigen::Quaterniond::Identity(), {-4, 0, 0})}};
}

TEST(DrawGaps, ShowsThemAndTheWayToTheFirst) {
  const auto array = DrawGaps({MakeGap(), MakeGap()}, OneView(), MakeHeader());
  EXPECT_EQ(array.markers.front().action, Marker::DELETEALL);
  int num_arrows = 0;
  int num_frames = 0;
  for (const Marker& marker : array.markers) {
    if (marker.ns == "gap_photo") ++num_frames;
    if (marker.type != Marker::ARROW || marker.action != Marker::ADD) continue;
    ++num_arrows;
    EXPECT_EQ(marker.points[0].x, 4.0);
    EXPECT_EQ(marker.points[1].y, -3.0);
  }
  EXPECT_EQ(num_arrows, 1);
  EXPECT_EQ(num_frames, 1);
  EXPECT_EQ(DrawGaps({}, OneView(), MakeHeader()).markers.size(), 1U);
}

// White on a round disc in the ink of the ring: a target's name is black on a white plate.
TEST(DrawGaps, NamesThemOnDiscsThatAreLegibleInTheWholeView) {
  Gap far = MakeGap();
  far.center_in_map.x() += 50.0;
  far.area = 0.01;
  std::vector<std::string> names;
  std::vector<Marker> discs;
  for (const Marker& marker : DrawGaps({MakeGap(), far}, OneView(), MakeHeader()).markers) {
    if (marker.type == Marker::CYLINDER) discs.push_back(marker);
    if (marker.type != Marker::TEXT_VIEW_FACING) continue;
    names.push_back(marker.text);
    EXPECT_GT(marker.scale.z, 0.025 * 50.0);
    EXPECT_EQ(marker.color.g, 1.0F);
    ASSERT_FALSE(discs.empty());
    EXPECT_LT(marker.pose.position.y, discs.back().pose.position.y);  // Before it.
    EXPECT_GT(discs.back().scale.x, 1.5 * marker.scale.z);
    EXPECT_LT(discs.back().color.g, 0.1F);
  }
  EXPECT_THAT(names, testing::ElementsAre("G1", "G2"));
}

TEST(DrawGaps, OfAHorizontalGapHasAxesToo) {
  Gap gap = MakeGap();
  gap.normal_in_map = {0, 0, 1};
  for (const Marker& marker : DrawGaps({gap}, {}, MakeHeader()).markers) {
    for (const auto& point : marker.points) EXPECT_TRUE(std::isfinite(point.x + point.y + point.z));
  }
}

TEST(DrawRefused, PutsThePhotoBetweenThoseBeforeAndAfter) {
  const auto at = [](double x) { return Rigid3(Eigen::Quaterniond::Identity(), {-x, 0, 0}); };
  const std::map<PhotoId, Rigid3> views = {{PhotoId{2}, at(0.0)}, {PhotoId{6}, at(4.0)}};
  const auto array = DrawRefused({{PhotoId{1}, {"a.jpg", "too_blurred"}},
                                  {PhotoId{3}, {"b.jpg", "no_overlap"}},
                                  {PhotoId{9}, {"c.jpg", "no_overlap"}}},
                                 views,
                                 MakeHeader());
  const Marker& crosses = array.markers.back();
  ASSERT_EQ(crosses.points.size(), 18U);
  EXPECT_NEAR(crosses.points[2].x, 0.0, 1e-9);
  EXPECT_NEAR(crosses.points[8].x, 1.0, 1e-9);
  EXPECT_NEAR(crosses.points[14].x, 4.0, 1e-9);
  EXPECT_EQ(array.markers[2].text, "b.jpg: no overlap");
  EXPECT_EQ(DrawRefused({{PhotoId{1}, {}}}, {}, MakeHeader()).markers.size(), 1U);
}

TEST(DrawRefused, WritesNamesOfPhotosAtOneSpotBelowEachOther) {
  const std::map<PhotoId, Rigid3> views = {{PhotoId{2}, Rigid3()}};
  const auto array = DrawRefused({{PhotoId{3}, {"a.jpg", "no_overlap"}},
                                  {PhotoId{4}, {"b.jpg", "no_overlap"}},
                                  {PhotoId{5}, {"c.jpg", "no_overlap"}}},
                                 views,
                                 MakeHeader());
  ASSERT_EQ(array.markers.size(), 5U);
  for (std::size_t i = 2; i < 4; ++i) {
    const Marker& above = array.markers[i - 1];
    EXPECT_LE(array.markers[i].pose.position.z, above.pose.position.z - above.scale.z);
  }
}

TEST(GapsMsg, IsInMetresAndHasAdvice) {
  Measure measure = MakeMeasure();
  measure.metres_per_map_unit = 2.0;
  const Rigid3 cam_from_map(Eigen::Quaterniond::Identity(), {0, 0, 0});
  const plumbline::Gaps msg = ToGapsMsg({MakeGap()}, GapOptions(), measure, cam_from_map);
  ASSERT_EQ(msg.gaps.size(), 1U);
  EXPECT_NEAR(msg.gaps[0].area_m2, 8.0, 1e-9);
  EXPECT_NEAR(msg.gaps[0].right_m, 2.0, 1e-9);
  EXPECT_NEAR(msg.gaps[0].forward_m, 6.0, 1e-9);
  EXPECT_THAT(msg.gaps[0].way, testing::HasSubstr("6.0 m closer"));
  EXPECT_EQ(msg.gaps[0].advice, msg.gaps[0].problem + ". Fly " + msg.gaps[0].way + ".");
  EXPECT_EQ(msg.wanted_gsd, GapOptions().wanted_gsd_mm);
}

}  // namespace
}  // namespace plumb::ros_adapter
