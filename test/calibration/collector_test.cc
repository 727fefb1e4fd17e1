// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "plumbline/calibration/calibration_collector.h"
#include "test/calibration/calibration_checks.h"

namespace plumb {
namespace {

using test::QuickOptions;

TEST(CalibrationCollector, SaysWhatToPhotographUntilItIsEnough) {
  CalibrationCollector collector(QuickOptions());
  EXPECT_EQ(collector.progress().num_photos, 0);
  EXPECT_FALSE(collector.progress().advice.empty());
  const test::CalibrationSceneOptions scene;
  CalibrationProgress progress;
  double first_sigma = 0.0;
  for (const CalibrationPhoto& photo : test::MakeCalibrationPhotos(scene)) {
    progress = collector.Add(photo);
    EXPECT_FALSE(progress.advice.empty());
    EXPECT_EQ(progress.last_photo, photo.name);
    EXPECT_THAT(progress.last_photo_note, testing::HasSubstr("marker"));
    if (progress.num_photos < 3) {
      EXPECT_FALSE(progress.estimate);
    }
    if (progress.estimate && first_sigma == 0.0) {
      first_sigma = progress.estimate->focal_sigma_percent;
    }
  }
  EXPECT_EQ(progress.num_photos, 12);
  ASSERT_TRUE(progress.estimate);
  EXPECT_LT(progress.estimate->focal_sigma_percent, 0.5 * first_sigma);
  EXPECT_EQ(progress.verdict, CalibrationVerdict::kGood) << progress.advice;
  // The running estimate is the whole calibration's.
  const CalibrationResult whole = collector.Calibrate("camera");
  ASSERT_TRUE(whole.estimate);
  EXPECT_NEAR(whole.estimate->camera.lens()[kFx],
              progress.estimate->camera.lens()[kFx],
              0.2 * whole.estimate->sigma[kFx]);
}

TEST(CalibrationCollector, TakesPhotosOutAndReplacesThem) {
  const std::vector<CalibrationPhoto> photos = test::MakeCalibrationPhotos();
  CalibrationCollector collector(QuickOptions());
  collector.Add(photos[0]);
  collector.Add(photos[1]);
  EXPECT_EQ(collector.Add(photos[1]).num_photos, 2);
  EXPECT_EQ(collector.Remove(photos[0].name).num_photos, 1);
  EXPECT_EQ(collector.Remove("no such photo").num_photos, 1);
  ASSERT_EQ(collector.photos().size(), 1U);
  EXPECT_EQ(collector.photos()[0].name, photos[1].name);
  collector.Clear();
  EXPECT_EQ(collector.progress().num_photos, 0);
  EXPECT_TRUE(collector.photos().empty());
}

TEST(CalibrationCollector, SaysOfAPhotoWhyItDoesNotCount) {
  std::vector<CalibrationPhoto> photos = test::MakeCalibrationPhotos();
  CalibrationCollector collector(QuickOptions());
  collector.Add(photos[0]);
  collector.Add(photos[1]);
  photos[2].width_px = 100;
  EXPECT_THAT(collector.Add(photos[2]).last_photo_note, testing::HasSubstr("2000 x 1333"));
}

// Run under a thread sanitizer by hand; here it must not crash, lose photos or wait for ever.
TEST(CalibrationCollector, MayBeAskedWhileItEstimates) {
  const std::vector<CalibrationPhoto> photos = test::MakeCalibrationPhotos();
  CalibrationCollector collector(QuickOptions());
  std::atomic<bool> is_done{false};
  std::thread asker([&] {
    int last = 0;
    while (!is_done) {
      const int now = collector.progress().num_photos;
      EXPECT_GE(now, last);
      last = now;
      std::this_thread::yield();
    }
  });
  std::thread adder([&] { collector.Add(photos[0]); });
  collector.Add(photos[1]);
  adder.join();
  collector.Add(photos[2]);
  is_done = true;
  asker.join();
  EXPECT_EQ(collector.progress().num_photos, 3);
}

}  // namespace
}  // namespace plumb
