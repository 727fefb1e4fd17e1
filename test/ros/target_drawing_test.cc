// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/target_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace plumb::ros_adapter {
namespace {

using plumbline::TargetResidual;
using testing::HasSubstr;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Seen `off` metres from where the survey has it, along z; 0.5 m a map unit.
TargetResidual Target(int id, const char* role, const char* state, double off_m) {
  TargetResidual target;
  target.id = id;
  target.name = std::to_string(id);
  target.role = role;
  target.state = state;
  target.survey_in_map = {4.0 * id, 0.0, 10.0};
  target.point_in_map = {4.0 * id, 0.0, 10.0 + 2.0 * off_m};
  target.error_mm = 1000.0 * off_m;
  return target;
}

plumbline::Georeference MakeGeoreference() {
  plumbline::Georeference georeference;
  georeference.source = plumbline::Georeference::TARGETS;
  georeference.metres_per_map_unit = 0.5;
  georeference.targets = {Target(0, "control", "good", 0.002),
                          Target(1, "check", "good", 0.003),
                          Target(2, "control", "wrong", 0.5)};
  TargetResidual unseen = Target(3, "control", "unseen", 0.0);
  unseen.point_in_map.assign(kNan);
  georeference.targets.push_back(unseen);
  return georeference;
}

const Marker* Find(const MarkerArray& drawing, const std::string& name, int id) {
  for (const Marker& marker : drawing.markers) {
    if (marker.ns == name && marker.id == id) return &marker;
  }
  return nullptr;
}

TEST(DrawTargets, ShowsEachWhereTheSurveyHasItAsLargeAsItIs) {
  const MarkerArray drawing = DrawTargets({}, MakeGeoreference());
  for (int id = 0; id < 4; ++id) {
    const Marker* marker = Find(drawing, "targets", id);
    ASSERT_NE(marker, nullptr);
    EXPECT_EQ(marker->pose.position.x, 4.0 * id);
    EXPECT_EQ(marker->pose.position.z, 10.0);
    EXPECT_DOUBLE_EQ(marker->scale.x, 1.0);  // 0.5 m.
  }
}

TEST(DrawTargets, TellsKindsApartByShapeAndColour) {
  const MarkerArray drawing = DrawTargets({}, MakeGeoreference());
  EXPECT_EQ(Find(drawing, "targets", 0)->type, Marker::SPHERE);
  EXPECT_EQ(Find(drawing, "targets", 1)->type, Marker::CUBE);
  EXPECT_NE(Find(drawing, "wrong_targets", 2), nullptr);
  EXPECT_EQ(Find(drawing, "wrong_targets", 0), nullptr);
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) {
      EXPECT_NE(Find(drawing, "targets", a)->color, Find(drawing, "targets", b)->color);
    }
  }
}

TEST(DrawTargets, ArrowsPointToWhereTheModelPutsThem) {
  const MarkerArray drawing =
      DrawTargets({"map", 0.5, /*magnification=*/100.0}, MakeGeoreference());
  const auto length = [&](int id) {
    const Marker* arrow = Find(drawing, "target_residuals", id);
    EXPECT_EQ(arrow->points[0].x, arrow->points[1].x);
    return arrow->points[1].z - arrow->points[0].z;
  };
  EXPECT_NEAR(length(0), 100.0 * 0.004, 1e-9);
  EXPECT_NEAR(length(1), 100.0 * 0.006, 1e-9);
  EXPECT_NEAR(length(2), 1.0, 1e-9);  // As it is.
  EXPECT_EQ(Find(drawing, "target_residuals", 3), nullptr);
}

TEST(DrawTargets, SaysTheMillimetres) {
  const MarkerArray drawing = DrawTargets({}, MakeGeoreference());
  EXPECT_EQ(Find(drawing, "target_labels", 0)->text, "T0: 2.0 mm");
  EXPECT_EQ(Find(drawing, "target_labels", 2)->text, "T2: WRONG 500 mm");
  EXPECT_EQ(Find(drawing, "target_labels", 3)->text, "T3: not seen");
}

TEST(DrawTargets, EachTextHasItsPlateBehindIt) {
  const MarkerArray drawing = DrawTargets({}, MakeGeoreference());
  int num_texts = 0;
  for (const Marker& text : drawing.markers) {
    if (text.type != Marker::TEXT_VIEW_FACING) continue;
    ++num_texts;
    const Marker* plate = Find(drawing, "plates_of_targets", text.id);
    ASSERT_NE(plate, nullptr);
    EXPECT_EQ(plate->pose.position.z, text.pose.position.z);
    EXPECT_GT(plate->pose.position.y, text.pose.position.y);  // The map's y leads into the wall.
    EXPECT_GT(plate->scale.x, 0.5 * text.scale.z * static_cast<double>(text.text.size()));
  }
  EXPECT_EQ(num_texts, 4);
}

TEST(DrawTargets, ShowsTargetsThatWaitWhereThePhotosSeeThem) {
  plumbline::Georeference georeference;
  georeference.source = plumbline::Georeference::NONE;
  TargetResidual waiting = Target(5, "control", "waiting", 0.0);
  waiting.survey_in_map.assign(kNan);
  georeference.targets = {waiting};
  const MarkerArray drawing = DrawTargets({}, georeference);
  EXPECT_EQ(Find(drawing, "targets", 5)->pose.position.x, 20.0);
}

TEST(DrawTargets, DrawsNothingWhereNothingHasAPlace) {
  EXPECT_TRUE(DrawTargets({}, plumbline::Georeference()).markers.empty());
}

}  // namespace
}  // namespace plumb::ros_adapter
