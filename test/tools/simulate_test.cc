// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

#include "plumbline/camera/camera.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/evaluation/true_poses.h"
#include "plumbline/image/photo_metadata.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

constexpr char kTiny[] = R"(
samples_per_axis: 1
facade: {width_m: 10.0, height_m: 10.5, depth_m: 6.0, num_storeys: 2, num_targets: 4}
lens: {width_px: 240, height_px: 160, cx_offset_px: 0, cy_offset_px: 0}
laser: {spacing_m: 0.2}
flight:
  legs:
    - {row: far, distance_m: 9.0, x_max_m: 10.0, z_max_m: 9.0, num_photos: 3}
    - {row: near, distance_m: 6.0, x_max_m: 10.0, z_min_m: 1.0, z_max_m: 6.0, num_photos: 2}
)";

class SimulateTest : public testing::Test {
 protected:
  SimulateTest() {
    fs::remove_all(root_);
    fs::create_directories(root_);
    WriteFileAtomically(root_ + "/tiny.yaml", kTiny);
    arguments_.scenario = root_ + "/tiny.yaml";
    arguments_.output = root_ + "/out";
    arguments_.num_threads = 2;
  }

  ExitCode Run(const FlightBagWriter& write_bag = {}) {
    Console console(&printed_, /*is_terminal=*/false);
    return Simulate(arguments_, write_bag, stop_, &console);
  }

  std::string Error() {
    try {
      Run();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  // All files by their path in the output folder.
  std::map<std::string, std::vector<std::uint8_t>> Files() const {
    std::map<std::string, std::vector<std::uint8_t>> files;
    for (const auto& entry : fs::recursive_directory_iterator(arguments_.output)) {
      if (!entry.is_regular_file()) continue;
      files[fs::relative(entry.path(), arguments_.output)] = ReadFileBytes(entry.path());
    }
    return files;
  }

  std::string root_ = testing::TempDir() + "/simulate_test";
  SimulateArguments arguments_;
  std::atomic<bool> stop_{false};
  std::ostringstream printed_;
};

TEST_F(SimulateTest, WritesAFlightWithItsTruth) {
  EXPECT_EQ(Run(), kDone);
  EXPECT_THAT(
      printed_.str(),
      AllOf(HasSubstr("\n2 of 5 photos, "), HasSubstr("5 photos"), HasSubstr("without ROS")));
  const auto files = Files();
  for (const char* name : {"photos/0001_far.jpg",
                           "photos/0005_near.jpg",
                           "camera.yaml",
                           "camera_wrong.yaml",
                           "survey.csv",
                           "telemetry.csv",
                           "scenario.yaml",
                           "README.md",
                           "ground_truth/poses.csv",
                           "ground_truth/rows.csv",
                           "ground_truth/laser.ply",
                           "ground_truth/surface.ply"}) {
    EXPECT_EQ(files.count(name), 1U) << name;
  }
  EXPECT_EQ(ReadCameraYaml(arguments_.output + "/camera.yaml").width_px(), 240);
  const auto truth = ReadTruePoses(arguments_.output + "/ground_truth/poses.csv");
  ASSERT_THAT(truth, SizeIs(5));
  EXPECT_EQ(truth[0].photo, "0001_far.jpg");
  EXPECT_NEAR(truth[0].center_in_world_m.y(), -9.0, 0.3);
  const PhotoMetadata metadata = ReadPhotoMetadata(files.at("photos/0005_near.jpg"));
  EXPECT_EQ(metadata.width_px, 240);
  EXPECT_TRUE(metadata.position);
  EXPECT_TRUE(metadata.exposure_time);
}

TEST_F(SimulateTest, IsTheSameOnAnyNumberOfThreadsAndAfterAnInterruption) {
  Run();
  const auto at_once = Files();
  arguments_.output = root_ + "/in_parts";
  arguments_.num_threads = 1;
  stop_ = true;
  EXPECT_EQ(Run(), kInterrupted);
  stop_ = false;
  arguments_.max_photos = 2;
  Run();
  WriteFileAtomically(arguments_.output + "/photos/.plumbline-1-0003_far.jpg", "half");
  const auto written = fs::last_write_time(arguments_.output + "/photos/0001_far.jpg");
  arguments_.max_photos = 0;
  Run();
  EXPECT_EQ(fs::last_write_time(arguments_.output + "/photos/0001_far.jpg"), written);
  EXPECT_THAT(printed_.str(), HasSubstr("5 photos, 3 of them taken now"));
  EXPECT_TRUE(Files() == at_once);
}

TEST_F(SimulateTest, TakesOnlySomeRowsAndTheSamePhotosOfThem) {
  Run();
  const auto all = Files();
  arguments_.output = root_ + "/near";
  arguments_.rows = {"near"};
  Run();
  const auto near = Files();
  EXPECT_EQ(near.count("photos/0001_far.jpg"), 0U);
  EXPECT_EQ(near.at("photos/0004_near.jpg"), all.at("photos/0004_near.jpg"));
  EXPECT_THAT(ReadTruePoses(arguments_.output + "/ground_truth/poses.csv"), SizeIs(2));
  arguments_.rows = {"middle"};
  EXPECT_THAT(Error(), AllOf(HasSubstr("no leg"), HasSubstr("far near")));
}

TEST_F(SimulateTest, AnotherSeedIsAnotherFlight) {
  Run();
  const auto first = Files();
  arguments_.output = root_ + "/other";
  arguments_.seed = 2;
  Run();
  const auto other = Files();
  EXPECT_NE(first.at("ground_truth/poses.csv"), other.at("ground_truth/poses.csv"));
  EXPECT_EQ(first.at("ground_truth/surface.ply"), other.at("ground_truth/surface.ply"));
}

TEST_F(SimulateTest, RefusesAFolderOfSomethingElse) {
  Run();
  arguments_.seed = 2;
  EXPECT_THAT(Error(),
              AllOf(HasSubstr("another scenario"),
                    HasSubstr("/seed: 1 there, 2 now"),
                    HasSubstr("--output")));
  arguments_.output = root_;
  EXPECT_THAT(Error(), HasSubstr("holds something else"));
  arguments_.output = root_ + "/tiny.yaml";
  EXPECT_THAT(Error(), HasSubstr("is a file; name a folder"));
  arguments_.output = root_ + "/tiny.yaml/below";
  EXPECT_THAT(Error(), HasSubstr("choose another --output"));
}

TEST_F(SimulateTest, OfTwoScenariosNamesWhatDiffersBeforeTheirDescriptions) {
  Run();
  std::string text = kTiny;
  text.replace(text.find("height_m: 10.5"), 14, "height_m: 11.0");
  WriteFileAtomically(arguments_.scenario, "description: a higher one\n" + text);
  EXPECT_THAT(Error(), HasSubstr("differs in /facade/height_m: 10.5 there, 11.0 now; "));
  WriteFileAtomically(arguments_.scenario, std::string("description: the same\n") + kTiny);
  EXPECT_THAT(Error(), HasSubstr("differs in /description: "));
}

TEST_F(SimulateTest, RefusesACameraInsideTheBuilding) {
  std::string text = kTiny;
  text.replace(text.find("distance_m: 6.0"), 15, "distance_m: 0.2");
  text.replace(text.find("num_photos: 2"), 13, "num_photos: 0");
  WriteFileAtomically(arguments_.scenario, text);
  EXPECT_THAT(Error(),
              AllOf(HasSubstr("tiny.yaml: flight: the camera of photo"), HasSubstr("distance_m")));
  EXPECT_FALSE(fs::exists(arguments_.output));
}

TEST_F(SimulateTest, HandsThePhotosToTheBagInTheOrderOfTime) {
  std::vector<RecordedPhoto> recorded;
  Run([&](const std::string& path, const Camera&, const std::vector<RecordedPhoto>& photos) {
    EXPECT_EQ(path, arguments_.output + "/flight.bag");
    recorded = photos;
  });
  ASSERT_THAT(recorded, SizeIs(5));
  EXPECT_LT(recorded[3].exposure_time, recorded[4].exposure_time);
  EXPECT_EQ(recorded[4].name, "0005_near.jpg");
  EXPECT_TRUE(fs::exists(recorded[4].file));
}

}  // namespace
}  // namespace plumb::tools
