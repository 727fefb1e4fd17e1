// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/marker_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

class WriteMarkerSheetTest : public testing::Test {
 protected:
  WriteMarkerSheetTest() { std::filesystem::create_directories(folder_); }
  ~WriteMarkerSheetTest() override { std::filesystem::remove_all(folder_); }

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string Text(const std::string& path) {
    const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
    return {bytes.begin(), bytes.end()};
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("marker_sheet_test_" +
       std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST(LayOutGrid, EveryMarkerHasItsCellOnThePageAndItsQuietZoneInTheCell) {
  for (const Paper paper : {Paper::kA4, Paper::kA3}) {
    for (const Arrangement arrangement : {Arrangement::kFixed, Arrangement::kLoose}) {
      const MarkerSheet sheet = LayOutGrid(paper, arrangement, 7);
      EXPECT_GE(sheet.cell_mm, kSidePerDiameter * sheet.diameter_mm);
      ASSERT_EQ(sheet.markers.size(), 16U);
      std::set<int> ids;
      for (const PrintedMarker& marker : sheet.markers) {
        ids.insert(marker.id);
        EXPECT_LT(marker.page, sheet.num_pages);
        const Eigen::Array2d center = marker.center_mm.array();
        EXPECT_TRUE((center >= 0.5 * sheet.cell_mm).all());
        EXPECT_TRUE((center <= sheet.page_mm.array() - 0.5 * sheet.cell_mm).all());
        for (const PrintedMarker& other : sheet.markers) {
          if (other.page != marker.page || other.id == marker.id) continue;
          EXPECT_GE((other.center_mm - marker.center_mm).norm(), sheet.cell_mm - 1e-9);
        }
      }
      EXPECT_EQ(ids.size(), 16U);
      EXPECT_EQ(*ids.begin(), 7);
    }
  }
}

TEST(LayOutGrid, FixedIsOnePageAndLooseIsLarger) {
  const MarkerSheet fixed = LayOutGrid(Paper::kA4, Arrangement::kFixed, 0);
  const MarkerSheet loose = LayOutGrid(Paper::kA4, Arrangement::kLoose, 0);
  EXPECT_EQ(fixed.num_pages, 1);
  EXPECT_EQ(loose.num_pages, 4);
  EXPECT_GT(loose.diameter_mm, 1.9 * fixed.diameter_mm);
  EXPECT_TRUE(loose.has_cut_lines);
}

TEST(LayOutGrid, RefusesIdsBeyondTheCodebook) {
  const int last = MarkerCodebook::Get().size() - 16;
  EXPECT_NO_THROW(LayOutGrid(Paper::kA4, Arrangement::kFixed, last));
  EXPECT_THROW(LayOutGrid(Paper::kA4, Arrangement::kFixed, last + 1), std::invalid_argument);
  EXPECT_THROW(LayOutGrid(Paper::kA4, Arrangement::kFixed, -1), std::invalid_argument);
}

TEST(LayOutTarget, RefusesUnknownIdsAndSizes) {
  EXPECT_THROW(LayOutTarget(1000, 500.0), std::invalid_argument);
  EXPECT_THROW(LayOutTarget(0, 0.0), std::invalid_argument);
  EXPECT_THROW(LayOutTarget(0, std::nan("")), std::invalid_argument);
}

TEST_F(WriteMarkerSheetTest, ASvgIsAsLargeAsThePage) {
  const std::string path = Path("target.svg");
  EXPECT_THAT(WriteMarkerSheet(LayOutTarget(3, 500.0), path), testing::ElementsAre(path));
  // 625 mm are 1771.65 points.
  EXPECT_THAT(Text(path), testing::HasSubstr("width=\"1771.653543pt\""));
}

TEST_F(WriteMarkerSheetTest, APdfHoldsAllPagesAndSvgsOneEach) {
  const MarkerSheet sheet = LayOutGrid(Paper::kA4, Arrangement::kLoose, 0);
  EXPECT_EQ(WriteMarkerSheet(sheet, Path("loose.pdf")).size(), 1U);
  EXPECT_THAT(Text(Path("loose.pdf")), testing::StartsWith("%PDF"));
  const std::vector<std::string> paths = WriteMarkerSheet(sheet, Path("loose.svg"));
  ASSERT_EQ(paths.size(), 4U);
  for (const std::string& path : paths) EXPECT_THAT(Text(path), testing::HasSubstr("</svg>"));
}

TEST_F(WriteMarkerSheetTest, RefusesOtherEndingsAndFoldersThatAreNotThere) {
  EXPECT_THROW(WriteMarkerSheet(LayOutTarget(3, 500.0), Path("a.png")), std::runtime_error);
  EXPECT_THROW(WriteMarkerSheet(LayOutTarget(3, 500.0), Path("none/a.pdf")), std::runtime_error);
}

}  // namespace
}  // namespace plumb
