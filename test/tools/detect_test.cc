// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/detect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "plumbline/common/atomic_file.h"
#include "plumbline/marker/marker_picture.h"

namespace plumb::tools {
namespace {

class DetectTest : public testing::Test {
 protected:
  DetectTest() {
    std::filesystem::create_directories(folder_);
    std::vector<std::uint8_t> picture = MarkerPicture(42, 60);
    cv::Mat photo(200, 300, CV_8U, cv::Scalar(220));
    cv::Mat(60, 60, CV_8U, picture.data()).copyTo(photo(cv::Rect(100, 80, 60, 60)));
    cv::imwrite(Folder() + "/a, b.jpg", photo);
    WriteFileAtomically(Folder() + "/broken.jpg", std::string("\xFF\xD8\xFF no photo"));
  }
  ~DetectTest() override { std::filesystem::remove_all(folder_); }

  std::string Folder() const { return folder_.string(); }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("detect_test_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(DetectTest, FindsAMarkerWhereItsPictureWasPut) {
  const DetectedPhoto photo = DetectInPhoto({}, {}, Folder(), "a, b.jpg");
  EXPECT_EQ(photo.problem, "");
  EXPECT_EQ(photo.width_px, 300);
  ASSERT_EQ(photo.markers.size(), 1U);
  EXPECT_EQ(photo.markers[0].id, 42);
  // The picture's centre is between four pixels.
  EXPECT_LT((photo.markers[0].center_px - Eigen::Vector2d(129.5, 109.5)).norm(), 0.03);
}

TEST_F(DetectTest, SaysWhyAPhotoCannotBeRead) {
  EXPECT_THAT(DetectInPhoto({}, {}, Folder(), "broken.jpg").problem,
              testing::HasSubstr("no photo"));
  EXPECT_NE(DetectInPhoto({}, {}, Folder(), "missing.jpg").problem, "");
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 300.0;
  lens[kCx] = 149.5;
  lens[kCy] = 149.5;
  const Camera camera("other", 300, 300, DistortionModel::kPlumbBob, lens);
  EXPECT_THAT(DetectInPhoto({}, camera, Folder(), "a, b.jpg").problem,
              testing::HasSubstr("300 x 200"));
}

TEST_F(DetectTest, WritesCsvWithQuotedNamesAndJsonThatReadsBack) {
  const std::vector<DetectedPhoto> photos = {DetectInPhoto({}, {}, Folder(), "a, b.jpg")};
  EXPECT_THAT(ToCsv(photos), testing::HasSubstr("\n\"a, b.jpg\",42,129.5"));
  const auto json = nlohmann::json::parse(ToJson(photos));
  const auto& marker = json["photos"][0]["markers"][0];
  EXPECT_EQ(marker["id"], 42);
  EXPECT_NEAR(marker["center_px"][0].get<double>(), photos[0].markers[0].center_px.x(), 1e-12);
  EXPECT_NEAR(marker["pixel_from_marker"][2][2].get<double>(), 1.0, 1e-12);
}

}  // namespace
}  // namespace plumb::tools
