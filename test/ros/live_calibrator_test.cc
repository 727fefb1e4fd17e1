// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/live_calibrator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <opencv2/imgcodecs.hpp>

#include "test/ros/temporary_folder.h"
#include "test/support/calibration_photos.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::HasSubstr;

const std::vector<cv::Mat>& Photos() {
  static const std::vector<cv::Mat> photos = [] {
    test::CalibrationSceneOptions options;
    options.camera = test::SmallCalibrationCamera();
    options.num_photos = 6;
    return test::RenderCalibrationPhotos(options);
  }();
  return photos;
}

std::vector<std::uint8_t> Encode(const cv::Mat& photo) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", photo, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  return bytes;
}

class LiveCalibratorTest : public ::testing::Test {
 protected:
  LiveCalibratorTest() {
    options_.output_folder = folder_ / "calibration";
    options_.picture_width_px = 320;
  }

  void Start() {
    calibrator_ = std::make_unique<LiveCalibrator>(
        options_, [this](const CalibratorView& view) { OnView(view); });
  }

  void OnView(const CalibratorView& view) {
    const std::lock_guard<std::mutex> lock(mutex_);
    views_.push_back(view);
    changed_.notify_all();
  }

  // The last of `count` images that were taken or could not be.
  CalibratorView WaitForView(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    const bool is_there =
        changed_.wait_for(lock, std::chrono::minutes(2), [&] { return views_.size() >= count; });
    EXPECT_TRUE(is_there);
    return is_there ? views_[count - 1] : CalibratorView();
  }

  void TakePhotos(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      calibrator_->TakePhoto("photo" + std::to_string(i + 1) + ".png", Encode(Photos()[i]));
    }
    WaitForView(count);
  }

  TemporaryFolder folder_;
  CalibratorRosOptions options_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<CalibratorView> views_;
  std::unique_ptr<LiveCalibrator> calibrator_;  // Last: it calls back until its end.
};

TEST_F(LiveCalibratorTest, CalibratesSavesAndCommitsWhatTheFolderBrings) {
  Start();
  EXPECT_FALSE(CanCalibrate(calibrator_->state()));
  EXPECT_EQ(calibrator_->Save().kind, Outcome::Kind::kFailed);
  TakePhotos(6);
  CalibratorState state = calibrator_->state();
  EXPECT_EQ(state.progress.coverage.num_photos, 6);
  EXPECT_TRUE(state.progress.estimate.has_value());
  ASSERT_TRUE(CanCalibrate(state));

  const Outcome outcome = calibrator_->Calibrate();
  EXPECT_THAT(outcome.text, HasSubstr("Calibrated from 6 photos"));
  state = calibrator_->state();
  ASSERT_TRUE(state.result && state.result->estimate);
  const double truth_px = test::SmallCalibrationCamera().lens()[kFx];
  EXPECT_NEAR(state.result->estimate->camera.lens()[kFx], truth_px, 0.01 * truth_px);
  EXPECT_TRUE(state.is_result_current);
  EXPECT_FALSE(CanCalibrate(state));

  EXPECT_THAT(calibrator_->Save().text, HasSubstr(options_.output_folder + "/camera.yaml"));
  const Camera saved = ReadCameraYaml(options_.output_folder + "/camera.yaml");
  EXPECT_EQ(saved.lens(), state.result->estimate->camera.lens());
  EXPECT_TRUE(std::filesystem::exists(options_.output_folder + "/report.md"));

  std::optional<Camera> sent;
  const Outcome commit = calibrator_->Commit([&](const Camera& camera) -> Outcome {
    sent = camera;
    return {Outcome::Kind::kDone, "sent"};
  });
  EXPECT_EQ(commit.text, "sent");
  ASSERT_TRUE(sent.has_value());
  EXPECT_EQ(sent->lens(), saved.lens());
  EXPECT_TRUE(calibrator_->state().is_committed);
}

TEST_F(LiveCalibratorTest, APhotoAfterTheCalibrationMakesItOld) {
  Start();
  TakePhotos(4);
  calibrator_->Calibrate();
  EXPECT_TRUE(calibrator_->state().is_result_current);
  calibrator_->TakePhoto("late.png", Encode(Photos()[5]));
  WaitForView(5);
  EXPECT_FALSE(calibrator_->state().is_result_current);
  EXPECT_TRUE(CanCalibrate(calibrator_->state()));
}

TEST_F(LiveCalibratorTest, AnEarlierCalibrationIsKept) {
  std::filesystem::create_directory(options_.output_folder);
  folder_.Write("calibration/report.json", "{}");
  Start();
  TakePhotos(4);
  calibrator_->Calibrate();
  ASSERT_NE(calibrator_->Save().kind, Outcome::Kind::kFailed);
  ASSERT_NE(calibrator_->Save().kind, Outcome::Kind::kFailed);
  EXPECT_EQ(std::filesystem::file_size(options_.output_folder + "_1/report.json"), 2U);
  EXPECT_FALSE(std::filesystem::exists(options_.output_folder + "_2"));
}

TEST_F(LiveCalibratorTest, SaysWhyItCannotSave) {
  folder_.Write("calibration", "a file where the folder should be");
  Start();
  TakePhotos(4);
  calibrator_->Calibrate();
  const Outcome outcome = calibrator_->Save();
  EXPECT_EQ(outcome.kind, Outcome::Kind::kFailed);
  EXPECT_THAT(outcome.text, HasSubstr(options_.output_folder));
  EXPECT_FALSE(calibrator_->state().is_saved);
}

TEST_F(LiveCalibratorTest, APhotoThatCannotBeReadIsNamedAndTheOthersGoOn) {
  Start();
  calibrator_->TakePhoto("empty.jpg", {});
  CalibratorView view = WaitForView(1);
  EXPECT_TRUE(view.is_problem);
  EXPECT_EQ(view.name, "empty.jpg");
  EXPECT_THAT(view.note, HasSubstr("empty"));
  std::vector<std::uint8_t> cut = Encode(Photos()[0]);
  cut.resize(100);
  calibrator_->TakePhoto("cut.png", cut);
  EXPECT_TRUE(WaitForView(2).is_problem);
  calibrator_->TakePhoto("nothing.png", Encode(cv::Mat(480, 640, CV_8UC1, cv::Scalar(128))));
  view = WaitForView(3);
  EXPECT_FALSE(view.is_problem);
  EXPECT_THAT(view.note, HasSubstr("no markers"));
  calibrator_->TakePhoto("good.png", Encode(Photos()[0]));
  EXPECT_TRUE(WaitForView(4).is_taken);
  EXPECT_EQ(calibrator_->state().num_unreadable, 2U);
  EXPECT_EQ(calibrator_->state().progress.coverage.num_photos, 1);
}

TEST_F(LiveCalibratorTest, APhotoOfAnotherSizeIsToldAndCountsNot) {
  Start();
  TakePhotos(3);
  cv::Mat cropped = Photos()[3](cv::Rect(0, 0, 800, 600)).clone();
  calibrator_->TakePhoto("small.png", Encode(cropped));
  const CalibratorView view = WaitForView(4);
  EXPECT_THAT(view.note, HasSubstr("small.png"));
  EXPECT_FALSE(view.is_taken);
  EXPECT_EQ(calibrator_->state().progress.coverage.num_photos, 3);
}

TEST_F(LiveCalibratorTest, MarkersBesideTheGridAreSeenButNotUsed) {
  options_.calibration.fixed_grid = "a4";
  options_.calibration.first_id = 8;  // The photos show 0 to 15.
  Start();
  calibrator_->TakePhoto("photo.png", Encode(Photos()[0]));
  WaitForView(1);
  const auto view = calibrator_->state().view;
  ASSERT_FALSE(view->markers.empty());
  for (const SeenMarker& marker : view->markers) EXPECT_EQ(marker.is_used, marker.id >= 8);
}

// One image is held up, so that those behind it must wait or be dropped.
TEST_F(LiveCalibratorTest, DropsImagesOfAVideoThatComeTooFastAndCountsThem) {
  options_.max_queue = 1;
  Start();
  std::mutex gate;
  gate.lock();
  calibrator_->OfferImage(1.0, [&] {
    const std::lock_guard<std::mutex> wait(gate);
    return GrayPhoto{Photos()[0], ""};
  });
  std::size_t num_dropped = 0;
  for (int i = 0; i < 5; ++i) {
    const auto decode = [] { return GrayPhoto{Photos()[0], ""}; };
    num_dropped += calibrator_->OfferImage(2.0 + i, decode) ? 0 : 1;
  }
  EXPECT_GE(num_dropped, 3U);
  EXPECT_EQ(calibrator_->state().num_dropped, num_dropped);
  gate.unlock();
  EXPECT_EQ(WaitForView(1).name, "view 1");
}

TEST_F(LiveCalibratorTest, TakesOnlyNewViewsOfAVideo) {
  options_.max_queue = 20;
  Start();
  double stamp_s = 0.0;
  for (const std::size_t i : {0U, 0U, 1U, 0U, 1U, 2U}) {
    ASSERT_TRUE(calibrator_->OfferImage(stamp_s += 5.0, [i] {
      return GrayPhoto{Photos()[i], ""};
    }));
  }
  EXPECT_EQ(WaitForView(3).name, "view 3");
  EXPECT_EQ(calibrator_->state().progress.coverage.num_photos, 3);
}

TEST_F(LiveCalibratorTest, EndsWhilePhotosWait) {
  options_.max_queue = 10;
  const std::vector<std::uint8_t> bytes = Encode(Photos()[0]);
  Start();
  for (int i = 0; i < 6; ++i) calibrator_->TakePhoto(std::to_string(i) + ".png", bytes);
  calibrator_.reset();
  EXPECT_LT(views_.size(), 6U);
}

}  // namespace
}  // namespace plumb::ros_adapter
