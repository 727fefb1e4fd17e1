// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "tools/simulate.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CalibrateTest : public testing::Test {
 protected:
  CalibrateTest() { fs::create_directories(folder_); }
  ~CalibrateTest() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  // Nine small photos of a floor.
  void SimulateFloor() {
    WriteFileAtomically(Path("floor.yaml"),
                        std::string("description: test\nfloor: {num_photos: 9}\n"
                                    "lens: {width_px: 900, height_px: 600, cx_offset_px: 2.0, "
                                    "cy_offset_px: -1.0, wrong_corner_px: 1.0}\n"));
    SimulateArguments arguments;
    arguments.scenario = Path("floor.yaml");
    arguments.output = Path("simulated");
    arguments.no_bag = true;
    const std::atomic<bool> stop{false};
    Console console(&log_, false);
    ASSERT_EQ(Simulate(arguments, {}, stop, &console), kDone);
  }

  CalibrateOutcome Run(CalibrateArguments arguments) {
    arguments.camera_name = "test";
    Console console(&log_, false);
    return Calibrate(arguments, &console);
  }

  std::ostringstream log_;

 private:
  fs::path folder_ = fs::temp_directory_path() /
                     ("calibrate_test_" +
                      std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(CalibrateTest, FindsTheLensOfSimulatedPhotos) {
  SimulateFloor();
  CalibrateArguments arguments;
  arguments.photos = Path("simulated/photos");
  arguments.output = Path("camera.yaml");
  arguments.report = Path("report");
  arguments.keep_poor = true;
  const CalibrateOutcome outcome = Run(arguments);
  ASSERT_TRUE(outcome.result.estimate) << log_.str();
  EXPECT_TRUE(outcome.has_written);
  const Camera truth = ReadCameraYaml(Path("simulated/camera.yaml"));
  const Camera found = ReadCameraYaml(Path("camera.yaml"));
  EXPECT_NEAR(found.lens()[kFx] / truth.lens()[kFx], 1.0, 2e-3);
  EXPECT_NEAR(found.lens()[kCx], truth.lens()[kCx], 1.0);
  EXPECT_NEAR(found.lens()[kCy], truth.lens()[kCy], 1.0);
  EXPECT_EQ(found.name(), "test");
  EXPECT_TRUE(fs::exists(Path("report/report.md")));
  EXPECT_THAT(log_.str(), HasSubstr("0001.jpg: "));
  EXPECT_THAT(Describe(outcome.result).front(), HasSubstr("focal length"));
}

TEST_F(CalibrateTest, WritesNoCameraThatIsNotGood) {
  SimulateFloor();
  for (int i = 3; i <= 9; ++i)
    fs::remove(Path("simulated/photos/000" + std::to_string(i) + ".jpg"));
  WriteFileAtomically(Path("simulated/photos/broken.jpg"), std::string("no photo"));
  CalibrateArguments arguments;
  arguments.photos = Path("simulated/photos");
  arguments.output = Path("camera.yaml");
  const CalibrateOutcome outcome = Run(arguments);
  EXPECT_FALSE(outcome.has_written);
  EXPECT_FALSE(fs::exists(Path("camera.yaml")));
  EXPECT_THAT(log_.str(), HasSubstr("broken.jpg: "));
  EXPECT_THAT(outcome.result.advice, HasSubstr("from all sides"));
}

TEST_F(CalibrateTest, NamesAFolderThatIsNotThere) {
  CalibrateArguments arguments;
  arguments.photos = Path("no such folder");
  arguments.output = Path("camera.yaml");
  EXPECT_THROW(Run(arguments), std::runtime_error);
}

TEST_F(CalibrateTest, NamesAMissingFolderOfTheOutputBeforeItLooksForMarkers) {
  fs::create_directories(Path("photos"));
  WriteFileAtomically(Path("photos/broken.jpg"), std::string("no photo"));
  CalibrateArguments arguments;
  arguments.photos = Path("photos");
  for (const char* output : {"no folder/camera.yaml", "photos"}) {
    arguments.output = Path(output);
    try {
      Run(arguments);
      FAIL() << output;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(arguments.output));
    }
  }
  EXPECT_EQ(log_.str(), "");
}

}  // namespace
}  // namespace plumb::tools
