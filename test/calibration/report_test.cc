// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "plumbline/calibration/calibration_report.h"
#include "plumbline/common/atomic_file.h"
#include "test/calibration/calibration_checks.h"

namespace plumb {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string Text(const fs::path& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  return {bytes.begin(), bytes.end()};
}

TEST(WriteCalibrationReport, HoldsAllThatWasFound) {
  const fs::path folder = fs::path(testing::TempDir()) / "calibration_report_test" / "deep";
  fs::remove_all(folder.parent_path());
  std::vector<CalibrationPhoto> photos = test::MakeCalibrationPhotos();
  photos[3].name = "a|b.jpg";
  photos[4].markers.resize(2);
  const CalibrationResult result = CalibrateCamera(test::QuickOptions(), photos, "eye");
  ASSERT_TRUE(result.estimate);
  WriteCalibrationReport(result, folder);
  const nlohmann::json json = nlohmann::json::parse(Text(folder / "report.json"));
  EXPECT_EQ(json["verdict"], ToString(result.verdict));
  EXPECT_EQ(json["photos"].size(), photos.size());
  EXPECT_EQ(json["photos"][4]["is_used"], false);
  EXPECT_EQ(json["markers"].size(), 16U);
  EXPECT_EQ(json["findings"][0]["kind"], "too_few_markers");
  EXPECT_DOUBLE_EQ(json["estimate"]["lens"]["fx"], result.estimate->camera.lens()[kFx]);
  EXPECT_EQ(json["residuals"].size(), result.residuals.size());
  const std::string markdown = Text(folder / "report.md");
  EXPECT_THAT(markdown, HasSubstr("a\\|b.jpg"));
  EXPECT_THAT(markdown, HasSubstr("5.jpg shows fewer than 4 markers"));
  for (const char* name : {"focal_search.svg", "residuals.svg", "coverage.svg", "markers.svg"}) {
    EXPECT_THAT(Text(folder / name), HasSubstr("</svg>")) << name;
    EXPECT_THAT(markdown, HasSubstr(name));
  }
  EXPECT_EQ(ReadCameraYaml(folder / "camera.yaml").lens(), result.estimate->camera.lens());
  EXPECT_EQ(ReadCameraYaml(folder / "camera.yaml").name(), "eye");
  fs::remove_all(folder.parent_path());
}

TEST(WriteCalibrationReport, BarsAndTableTellTheSameTilts) {
  const CalibrationResult result =
      CalibrateCamera(test::QuickOptions(), test::MakeCalibrationPhotos());
  ASSERT_TRUE(result.estimate);
  std::vector<int> counts(4, 0);
  for (const CalibratedPhoto& photo : result.photos) {
    const long tilt_deg = std::lround(photo.tilt_deg);  // As the table shows it.
    if (photo.is_used) ++counts[tilt_deg < 15 ? 0 : tilt_deg < 30 ? 1 : tilt_deg <= 45 ? 2 : 3];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    EXPECT_EQ(result.coverage.tilt[i].count, counts[i]) << result.coverage.tilt[i].label;
  }
  EXPECT_TRUE(result.coverage.is_tilt_estimated);
}

TEST(WriteCalibrationReport, NamesMarkersThatAreLeftOut) {
  std::vector<CalibrationPhoto> photos = test::MakeCalibrationPhotos();
  const int id = photos[0].markers.front().id;
  for (std::size_t i = 1; i < photos.size(); ++i) {
    std::vector<MarkerDetection>& markers = photos[i].markers;
    markers.erase(std::remove_if(markers.begin(),
                                 markers.end(),
                                 [id](const MarkerDetection& marker) { return marker.id == id; }),
                  markers.end());
  }
  const CalibrationResult result = CalibrateCamera(test::QuickOptions(), photos);
  ASSERT_TRUE(result.estimate);
  EXPECT_EQ(result.photos[0].num_found, result.photos[0].num_markers + 1);
  ASSERT_EQ(result.left_out.size(), 1U);
  EXPECT_EQ(result.left_out[0].id, id);
  EXPECT_THAT(
      ToMarkdown(result),
      HasSubstr("- marker " + std::to_string(id) + ": in one photo only, " + photos[0].name));
  EXPECT_THAT(ToMarkdown(result),
              HasSubstr("| " + std::to_string(photos[0].markers.size()) + " | 1 |"));
}

TEST(WriteCalibrationReport, IsThereForAFailureToo) {
  const fs::path folder = fs::path(testing::TempDir()) / "calibration_report_test_failed";
  fs::remove_all(folder);
  WriteCalibrationReport(CalibrateCamera({}, {}), folder);
  EXPECT_THAT(Text(folder / "report.md"), HasSubstr("from all sides"));
  EXPECT_FALSE(fs::exists(folder / "camera.yaml"));
  EXPECT_THAT(Text(folder / "coverage.svg"), HasSubstr("</svg>"));
  fs::remove_all(folder);
}

TEST(WriteCalibrationReport, NamesAFolderThatCannotBeMade) {
  try {
    WriteCalibrationReport(CalibrateCamera({}, {}), "/proc/no/such");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/proc/no/such"));
  }
}

}  // namespace
}  // namespace plumb
