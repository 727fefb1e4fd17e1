// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario_yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string WriteScenario(const std::string& text) {
  const std::string path = testing::TempDir() + "/scenario_yaml_test.yaml";
  WriteFileAtomically(path, text);
  return path;
}

std::string ErrorOf(const std::string& text) {
  try {
    ReadScenario(WriteScenario(text));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(ReadScenario, EveryShippedOneIsSoundAndReadsBackFromItsJson) {
  int num_scenarios = 0;
  for (const auto& entry : fs::directory_iterator(PLUMBLINE_SOURCE_DIR "/config/scenarios")) {
    SCOPED_TRACE(entry.path());
    const Scenario scenario = ReadScenario(entry.path());
    EXPECT_FALSE(scenario.description.empty());
    if (scenario.floor.num_photos == 0) {
      const Camera camera = MakeTrueCamera(scenario.lens);
      EXPECT_FALSE(PlanFlight(scenario.flight, camera, Building(), 1).empty());
      EXPECT_EQ(BuildFacade(scenario.facade).plates.size(),
                static_cast<std::size_t>(scenario.facade.num_targets));
    }
    EXPECT_NE(ToCameraYaml(MakeWrongCamera(scenario.lens)),
              ToCameraYaml(MakeTrueCamera(scenario.lens)));
    const std::string json = ToJson(scenario).dump();
    EXPECT_EQ(ToJson(ReadScenario(WriteScenario(json))).dump(), json);
    ++num_scenarios;
  }
  EXPECT_GE(num_scenarios, 8);
}

TEST(ReadScenario, ThePaperHas500PhotosInThreeRows) {
  const Scenario scenario = ReadScenario(FindScenario("multiscale_500"));
  std::map<std::string, int> photos_of_row;
  for (const PlannedPhoto& photo :
       PlanFlight(scenario.flight, MakeTrueCamera(scenario.lens), Building(), scenario.seed)) {
    ++photos_of_row[photo.row];
  }
  EXPECT_EQ(photos_of_row["10m"] + photos_of_row["6m"] + photos_of_row["4m"], 500);
  EXPECT_EQ(photos_of_row.size(), 3U);
  EXPECT_EQ(scenario.facade.num_targets, 17);
}

TEST(ReadScenario, NamesFileKeyAndCureOfWhatIsWrong) {
  EXPECT_THAT(ErrorOf("facade: {colour: red}"),
              AllOf(HasSubstr("scenario_yaml_test.yaml: facade: unknown option \"colour\""),
                    HasSubstr("known are")));
  EXPECT_THAT(ErrorOf("flight: {legs: [{distance_m: far}]}"),
              HasSubstr("flight.legs[0].distance_m: must be a number, but is \"far\""));
  EXPECT_THAT(ErrorOf("flight: {legs: {distance_m: 3}}"), HasSubstr("flight.legs: must be a list"));
  EXPECT_THAT(ErrorOf("seed: -1"), HasSubstr("seed: must be a whole number of at least 0"));
  EXPECT_THAT(ErrorOf("light: {towards_sun_in_world: [0, 1]}"), HasSubstr("three numbers"));
  EXPECT_THAT(ErrorOf("flight: {legs: [{side_overlap: 1.2}]}"),
              AllOf(HasSubstr("flight.legs[0].side_overlap must be in [0, 0.98], but is 1.2"),
                    HasSubstr("correct the file")));
  EXPECT_THAT(ErrorOf("flight: {}"), HasSubstr("flight.legs must be at least one"));
}

TEST(FindScenario, NamesTheShippedOnes) {
  EXPECT_EQ(FindScenario("./mine.yaml"), "./mine.yaml");
  try {
    FindScenario("no_such");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no_such"), HasSubstr("demo"), HasSubstr("hover")));
  }
}

TEST(MakeWrongCamera, IsOffInTheCornerAsAskedFor) {
  LensOptions options;
  options.wrong_focal_percent = 0.0;
  options.wrong_corner_px = 3.0;
  options.k1 = options.k2 = options.p1 = options.p2 = options.cx_offset_px = options.cy_offset_px =
      0.0;
  const Camera camera = MakeTrueCamera(options);
  EXPECT_NEAR(camera.MeanFocalLength(), 3344.34, 0.01);  // 16 mm at 4.784 um.
  const Eigen::Vector2d xy = *camera.Unproject({0.0, 0.0});
  EXPECT_NEAR(MakeWrongCamera(options).Project(xy.homogeneous())->norm(), 3.0, 0.01);
}

}  // namespace
}  // namespace plumb::tools
