// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "plumbline/camera/camera.h"
#include "plumbline/map/session_store.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr char kCameraYaml[] =
    "image_width: 300\nimage_height: 200\ncamera_name: test\n"
    "camera_matrix: {rows: 3, cols: 3, data: [300, 0, 149.5, 0, 300, 99.5, 0, 0, 1]}\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n";

// Runs subcommands as the shell would.
class CommandsTest : public testing::Test {
 protected:
  CommandsTest() {
    std::string pattern = testing::TempDir() + "commands_XXXXXX";
    root_ = ::mkdtemp(pattern.data());
    fs::create_directory(root_ / "photos");
    std::ofstream(root_ / "camera.yaml") << kCameraYaml;
  }
  ~CommandsTest() override { fs::remove_all(root_); }

  std::string Path(const std::string& name) const { return (root_ / name).string(); }

  void WritePhoto(const std::string& name, int width_px, int height_px) const {
    cv::imwrite(Path("photos/" + name), cv::Mat(height_px, width_px, CV_8U, cv::Scalar(128)));
  }

  ExitCode Run(const std::string& line) {
    CLI::App app("", "plumbline");
    ExitCode exit_code = kFailed;
    AddCheckCommand(&app, &exit_code);
    AddDetectCommand(&app, &exit_code);
    AddMarkersCommand(&app, &exit_code);
    AddMeshCommand(&app, &exit_code);
    AddExportCommand(&app, &exit_code);
    AddEvaluateCommand(&app, &exit_code);
    AddGeoreferenceCommand(&app, &exit_code);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    error_.clear();
    try {
      app.parse(line);
    } catch (const std::exception& error) {
      error_ = error.what();
    }
    out_ = testing::internal::GetCapturedStdout();
    error_ += testing::internal::GetCapturedStderr();
    return exit_code;
  }

  fs::path root_;
  std::string out_;
  std::string error_;  // What was said on standard error, or thrown.
};

TEST_F(CommandsTest, DetectSaysToTheShellWhetherAnyPhotoCouldBeSearched) {
  const std::string line = "detect --photos " + Path("photos") + " --camera " + Path("camera.yaml");
  WritePhoto("other_size.png", 200, 300);
  std::ofstream(root_ / "photos" / "broken.jpg") << "no photo";
  EXPECT_EQ(Run(line), kNothingLocated);
  EXPECT_THAT(error_, HasSubstr("none of the photos could be searched"));
  WritePhoto("without_markers.png", 300, 200);
  EXPECT_EQ(Run(line), kDone);
  EXPECT_THAT(error_, HasSubstr("without_markers.png: 0 markers"));
}

TEST_F(CommandsTest, CheckSaysToTheShellWhetherAnyPhotoIsUsable) {
  const std::string line = "check --photos " + Path("photos") + " --camera " + Path("camera.yaml");
  std::ofstream(root_ / "photos" / "broken.jpg") << "no photo";
  EXPECT_EQ(Run(line), kNothingLocated);
  EXPECT_THAT(out_, HasSubstr("\"usable\":false"));
  EXPECT_THAT(error_, HasSubstr("none of the photos is usable"));
  cv::Mat noise(50, 75, CV_8U);
  cv::randu(noise, 0, 255);
  cv::Mat textured;
  cv::resize(noise, textured, {300, 200}, 0.0, 0.0, cv::INTER_NEAREST);
  cv::imwrite(Path("photos/textured.png"), textured);
  EXPECT_EQ(Run(line), kDone);
  EXPECT_THAT(out_, HasSubstr("\"usable\":true"));
}

TEST_F(CommandsTest, AnEmptySessionIsSaidToBeEmptyAndWhatToDo) {
  std::ofstream(root_ / "poses.csv") << "photo,qw,qx,qy,qz,center_x_m,center_y_m,center_z_m\n";
  const std::string session = Path("session");
  const Camera camera = ReadCameraYaml(Path("camera.yaml"));
  SessionStore(session, camera);
  const auto expect_refusal = [&](const std::string& words) {
    const std::string evaluate = "evaluate --truth " + Path("poses.csv");
    for (const std::string& command : std::vector<std::string>{"mesh", "export", evaluate}) {
      EXPECT_EQ(Run(command + " --session " + session), kNothingLocated) << command;
      EXPECT_THAT(error_, HasSubstr(words)) << command;
      EXPECT_THAT(error_, HasSubstr("run plumbline reconstruct --session " + session)) << command;
      EXPECT_EQ(out_, "") << command;
    }
    EXPECT_EQ(Run("georeference --session " + session), kFailed);
    EXPECT_THAT(error_, HasSubstr(words));
  };
  expect_refusal("holds no photo yet");
  {
    SessionStore store(session, camera);
    for (std::uint32_t i = 0; i < 3; ++i) {
      store.SavePhoto({i}, std::to_string(i) + ".jpg", {1, 2, 3});
    }
  }
  expect_refusal("none of its 3 photos is located; photos that overlap are needed");
  {
    SessionStore store(session, camera);
    for (std::uint32_t i = 0; i < 2; ++i) {
      PhotoVerdict verdict;
      verdict.photo = {i};
      verdict.status = VerdictStatus::kRefused;
      verdict.reason = RefusalReason::kTooBlurred;
      store.SaveVerdict(verdict);
    }
  }
  expect_refusal("none of its 3 photos is located, 2 refused, most as too_blurred");
  EXPECT_FALSE(fs::exists(session + "/export"));
}

TEST_F(CommandsTest, EvaluateWantsATruthForAMesh) {
  SessionStore(Path("session"), ReadCameraYaml(Path("camera.yaml")));
  EXPECT_EQ(Run("evaluate --session " + Path("session") + " --truth poses.csv --mesh mesh.ply"),
            kFailed);
  EXPECT_THAT(error_, HasSubstr("--mesh: nothing to compare it with; give --surface, --laser"));
}

TEST_F(CommandsTest, HelpNamesTheExitCodes) {
  for (const char* command : {"mesh", "georeference", "export", "evaluate", "markers"}) {
    CLI::App app("", "plumbline");
    ExitCode exit_code = kFailed;
    AddMarkersCommand(&app, &exit_code);
    AddMeshCommand(&app, &exit_code);
    AddExportCommand(&app, &exit_code);
    AddEvaluateCommand(&app, &exit_code);
    AddGeoreferenceCommand(&app, &exit_code);
    EXPECT_THAT(app.get_subcommand(command)->get_footer(), HasSubstr(kExitCodes)) << command;
  }
}

TEST_F(CommandsTest, MarkersSaysWhatIsWrongInItsOwnWords) {
  Run("markers sheet --paper a5 --output " + Path("a.pdf"));
  EXPECT_EQ(error_, "--paper: \"a5\" is not known; use a3 or a4");
  Run("markers target --id 100000 --output " + Path("a.pdf"));
  EXPECT_THAT(error_, HasSubstr(", there is no 100000"));
  Run("markers target --id 7 --output " + Path("absent/a.pdf"));
  EXPECT_THAT(error_, HasSubstr("there is no folder " + Path("absent") + "; make it"));
  Run("markers target --id 7 --output " + Path("camera.yaml/a.pdf"));
  EXPECT_THAT(error_, HasSubstr("is a file: choose another folder"));
  EXPECT_EQ(Run("markers sheet --paper A3 --arrangement LOOSE --output " + Path("a.pdf")), kDone);
  EXPECT_THAT(out_, HasSubstr("calibration markers 0 to 15"));
}

}  // namespace
}  // namespace plumb::tools
