// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "plumbline/common/atomic_file.h"
#include "tools/experiment_cell.h"
#include "tools/experiment_plots.h"
#include "tools/experiment_report.h"
#include "tools/simulate.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

constexpr char kTiny[] = R"(
samples_per_axis: 1
facade: {width_m: 14.0, height_m: 10.5, depth_m: 6.0, num_storeys: 2, num_targets: 7}
lens: {width_px: 640, height_px: 426, cx_offset_px: 0, cy_offset_px: 0}
laser: {spacing_m: 0.15}
flight:
  legs:
    - {row: far, distance_m: 8.0, x_max_m: 14.0, z_min_m: 1.0, z_max_m: 9.0, num_photos: 8}
    - {row: near, distance_m: 6.5, x_max_m: 14.0, z_min_m: 1.0, z_max_m: 9.0, num_photos: 9}
)";

// A flight of small photos, simulated once for all tests.
class ExperimentTest : public testing::Test {
 protected:
  static std::string Root() { return testing::TempDir() + "/experiment_test"; }

  static void SetUpTestSuite() {
    fs::remove_all(Root());
    fs::create_directories(Root());
    WriteFileAtomically(Root() + "/tiny.yaml", kTiny);
    SimulateArguments arguments;
    arguments.scenario = Root() + "/tiny.yaml";
    arguments.output = Root() + "/flight";
    arguments.no_bag = true;
    std::ostringstream printed;
    Console console(&printed, /*is_terminal=*/false);
    ASSERT_EQ(Simulate(arguments, {}, false, &console), kDone);
  }
  static void TearDownTestSuite() { fs::remove_all(Root()); }

  ExperimentTest() {
    fs::remove_all(Root() + "/broken");
    arguments_.flight = Root() + "/flight";
    arguments_.output = Root() + "/out";
    arguments_.num_seeds = 1;
    arguments_.settings = {"reconstruction.features.max_features=1200",
                           "refinement.num_rounds=1"};  // Quick.
  }

  // Without the photos' bytes, which the errors below come before.
  std::string BrokenFlight() {
    fs::copy(arguments_.flight, Root() + "/broken", fs::copy_options::recursive);
    arguments_.flight = Root() + "/broken";
    arguments_.output = Root() + "/broken_out";
    return arguments_.flight;
  }

  ExitCode Run() {
    Console console(&printed_, /*is_terminal=*/false);
    return RunMultiscaleExperiment(arguments_, stop_, &console);
  }

  std::string ErrorOf() {
    try {
      Run();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  static std::string ReadText(const std::string& path) {
    const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
    return {bytes.begin(), bytes.end()};
  }

  ExperimentArguments arguments_;
  std::atomic<bool> stop_{false};
  std::ostringstream printed_;
};

TEST_F(ExperimentTest, MeasuresRowsAndBundlesAndGoesOnWhereItWas) {
  ASSERT_EQ(Run(), kDone);
  const Json results = Json::parse(ReadText(arguments_.output + "/results.json"));
  ASSERT_EQ(results.size(), 3U * std::size(kBundles));
  for (const Json& line : results) {
    SCOPED_TRACE(line.dump());
    EXPECT_EQ(line["located"]["mean"], line["photos"]);
    const double check_mm = line["check_mm"]["mean"].get<double>();
    // The survey is off by 1 mm an axis.
    EXPECT_NEAR(check_mm, line["true_check_mm"]["mean"].get<double>(), 4.0);
    // Photos so few and small give no good block; a pixel is 19 mm on the facade.
    const bool is_best = line["rows"] == "all" && line["bundle"] == "constrained";
    EXPECT_LT(check_mm, is_best ? 30.0 : 1000.0);
    EXPECT_GT(line["laser_p90_mm"]["mean"].get<double>(), 0.0);
  }
  const Json cell = Json::parse(ReadText(arguments_.output + "/cells/all-seed1.json"));
  const auto focal_px = [&](const char* bundle) {
    return cell["bundles"][bundle]["focal_px"].get<double>();
  };
  EXPECT_EQ(focal_px("held"), cell["faulty_lens"]["focal_px"].get<double>());
  EXPECT_NE(focal_px("standard"), focal_px("held"));
  EXPECT_NE(focal_px("multi_scale"), focal_px("standard"));
  EXPECT_LT(cell["bundles"]["constrained"]["control_mm"]["mean"].get<double>(),
            cell["bundles"]["multi_scale"]["control_mm"]["mean"].get<double>());
  EXPECT_THAT(ReadText(arguments_.output + "/tables.md"),
              AllOf(HasSubstr("Table I: each row alone"),
                    HasSubstr("| far | 8 of 8 | held |"),
                    HasSubstr("Table II: all rows together")));
  for (const char* name : {"/errors.svg", "/laser.svg", "/results.csv"}) {
    EXPECT_GT(fs::file_size(arguments_.output + name), 300U) << name;
  }

  // What is kept is not computed again; what is lost, to the same figures.
  const std::string near_path = arguments_.output + "/cells/near-seed1.json";
  const Json near = Json::parse(ReadText(near_path));
  const auto written = fs::last_write_time(arguments_.output + "/cells/far-seed1.json");
  fs::remove(near_path);
  ASSERT_EQ(Run(), kDone);
  EXPECT_THAT(printed_.str(), HasSubstr("1 of 3 reconstructions to do"));
  EXPECT_EQ(fs::last_write_time(arguments_.output + "/cells/far-seed1.json"), written);
  const Json again = Json::parse(ReadText(near_path));
  EXPECT_EQ(again["bundles"]["standard"]["check_mm"], near["bundles"]["standard"]["check_mm"]);

  std::ofstream(near_path) << "{";
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("near-seed1.json: is damaged"), HasSubstr("remove it")));
  fs::remove(near_path);
  stop_ = true;
  EXPECT_EQ(Run(), kInterrupted);
  EXPECT_FALSE(fs::exists(near_path));
  arguments_.settings.emplace_back("distance_exponent=2");
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("other options"), HasSubstr("--output")));
}

TEST_F(ExperimentTest, SaysWhatIsWrongWithTheFlight) {
  const std::string flight = BrokenFlight();
  arguments_.rows = {"middle"};
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("\"middle\""), HasSubstr("far near all")));
  arguments_.rows.clear();
  arguments_.settings = {"distance_exponent=0"};
  EXPECT_THAT(ErrorOf(), HasSubstr("distance_exponent"));
  arguments_.settings = {"refinement.bundle.huber_width_px=-1"};
  EXPECT_THAT(ErrorOf(), HasSubstr("huber_width_px"));
  arguments_.settings.clear();

  fs::remove(flight + "/ground_truth/surface.ply");
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("surface.ply: is missing"), HasSubstr("simulate")));
  std::ofstream(flight + "/survey.csv") << "0,0,0,0\n1,1,0,0\n";
  std::ofstream(flight + "/ground_truth/surface.ply") << "ply\n";
  EXPECT_THAT(ErrorOf(), HasSubstr("2 control points"));
  for (const auto& entry : fs::directory_iterator(flight + "/photos")) {
    if (entry.path().string().find("near") != std::string::npos) fs::remove(entry);
  }
  EXPECT_THAT(ErrorOf(), HasSubstr("row far only"));
  std::ofstream(flight + "/ground_truth/rows.csv") << "photo,row,distance_m\na.jpg,far\n";
  EXPECT_THAT(ErrorOf(), HasSubstr("rows.csv: line 2"));
  fs::remove(flight + "/ground_truth/rows.csv");
  EXPECT_THAT(ErrorOf(), HasSubstr("rows.csv: is missing"));
  fs::remove(flight + "/survey.csv");
  EXPECT_THAT(ErrorOf(), HasSubstr("survey.csv: is missing"));
  arguments_.flight = Root() + "/nowhere";
  EXPECT_THAT(ErrorOf(), HasSubstr("nowhere/camera.yaml: is missing"));
  EXPECT_FALSE(fs::exists(arguments_.output));
}

TEST(ExperimentFlight, SplitsASurveyOfControlPointsOnly) {
  Survey survey;
  survey.targets.resize(8);
  EXPECT_TRUE(SplitSurvey(&survey));
  std::vector<int> check;
  for (int i = 0; i < 8; ++i) {
    if (survey.targets[static_cast<std::size_t>(i)].is_check) check.push_back(i);
  }
  EXPECT_THAT(check, testing::ElementsAre(1, 4, 7));
  EXPECT_FALSE(SplitSurvey(&survey));  // It has check points now.
  for (const std::size_t count : {2, 3}) {
    survey.targets.assign(count, {});
    EXPECT_FALSE(SplitSurvey(&survey));  // All are needed.
  }
}

TEST(ExperimentFlight, FaultyCamerasAreOffByWhatACalibrationMayBe) {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 3344.0;
  lens[kCx] = 2455.5;
  lens[kCy] = 1631.5;
  const Camera camera("true", 4912, 3264, DistortionModel::kPlumbBob, lens);
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Camera faulty = MakeFaultyCamera(camera, seed);
    const double off = std::abs(faulty.MeanFocalLength() / camera.MeanFocalLength() - 1.0);
    EXPECT_GE(off, 0.001);
    EXPECT_LE(off, 0.003);
    // In the corner, by the distortion alone.
    const Eigen::Vector2d corner(2456.0 / 3344.0, 1632.0 / 3344.0);
    const double corner_px = 3344.0 * std::abs(faulty.lens()[kK1]) * std::pow(corner.norm(), 3);
    EXPECT_GT(corner_px, 1.99);
    EXPECT_LT(corner_px, 4.01);
    EXPECT_EQ(faulty.lens(), MakeFaultyCamera(camera, seed).lens());
  }
  EXPECT_NE(MakeFaultyCamera(camera, 1).lens(), MakeFaultyCamera(camera, 2).lens());
}

TEST(ExperimentReport, SummarisesOverTheSeeds) {
  EXPECT_FALSE(Summarise({}));
  EXPECT_EQ(Summarise({3.0})->spread, 0.0);
  const auto summary = Summarise({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(summary->mean, 2.0);
  EXPECT_DOUBLE_EQ(summary->spread, 1.0);
  EXPECT_EQ(summary->count, 3);
}

TEST(ExperimentReport, DrawsTheBendWhereThereIsOne) {
  Json cell = {{"rows", "all"}, {"bundles", Json::object()}};
  for (const char* bundle : kBundles) cell["bundles"][bundle] = {{"bend_profile", Json::array()}};
  EXPECT_TRUE(DrawBend({"all"}, {cell}).empty());
  cell["bundles"]["held"]["bend_profile"] = {{{"u_m", 1.0}, {"bend_mm", -12.0}},
                                             {{"u_m", 3.0}, {"bend_mm", 14.0}}};
  const std::string svg = DrawBend({"far", "all"}, {cell});
  EXPECT_THAT(svg, AllOf(HasSubstr("<svg"), HasSubstr("</svg>")));
}

TEST(ExperimentReport, WhatWasNotMeasuredIsNotZero) {
  const Camera camera(
      "any", 100, 100, DistortionModel::kPlumbBob, {100, 100, 49.5, 49.5, 0, 0, 0, 0, 0, 0, 0, 0});
  ExperimentFlight flight{"", camera, {}, false, {}, {{"4m", 4.1, 3}}, {}};
  Json cell = {{"rows", "4m"},
               {"seed", 1},
               {"photos", 3},
               {"located", 0},
               {"reconstruct_cpu_s", 1.0},
               {"bundles", Json::object()}};
  for (const char* bundle : kBundles) cell["bundles"][bundle] = nullptr;
  const auto lines = SummariseCells(flight, {"4m"}, {cell});
  ASSERT_EQ(lines.size(), std::size(kBundles));
  EXPECT_FALSE(lines[1].check_mm);
  const std::string markdown = ToMarkdown(flight, lines);
  EXPECT_THAT(markdown, HasSubstr("| 4m | 0 of 3 | standard | - | - | - | - | - | - | 45.2 |"));
  EXPECT_THAT(markdown, testing::Not(HasSubstr("Table II")));
}

}  // namespace
}  // namespace plumb::tools
