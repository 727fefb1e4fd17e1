// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "plumbline/marker/marker_detector.h"
#include "test/support/photo_mosaic.h"

namespace plumb::test {
namespace {

// Of the first, taken for blurred markers, two spots on a mirror axis once had IDs.
TEST(DetectMarkers, SeesNoneInPhotosWithout) {
  const char* given = std::getenv("PLUMBLINE_DATA");
  const std::filesystem::path data =
      given != nullptr ? given : PLUMBLINE_SOURCE_DIR "/../shared/data";
  if (!std::filesystem::exists(data)) {
    GTEST_SKIP() << data << " is absent: set PLUMBLINE_DATA";
  }
  for (const std::string name : {"Herz-Jesus-P8/photos/0000.jpg",
                                 "fountain-P11/photos/0004.jpg",
                                 "sceaux/photos/100_7100.JPG",
                                 "south_building/photos/P1180141.JPG"}) {
    SCOPED_TRACE(name);
    const cv::Mat gray =
        cv::imread((data / name).string(), cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    ASSERT_FALSE(gray.empty());
    EXPECT_THAT(DetectMarkers({}, gray), testing::IsEmpty());
    // Twice as high, or high and wide: the mirror axes run through.
    const cv::Size size(std::max(gray.cols, 2048), gray.rows + std::min(gray.rows, 1024));
    EXPECT_THAT(DetectMarkers({}, Mosaic(gray, size)), testing::IsEmpty());
  }
}

}  // namespace
}  // namespace plumb::test
