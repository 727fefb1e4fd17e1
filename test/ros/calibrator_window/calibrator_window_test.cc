// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_window/calibrator_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QtTest>

#include "ros/calibrator_window/bars_view.h"
#include "ros/calibrator_window/estimate_view.h"
#include "ros/calibrator_window/photo_view.h"
#include "ros/calibrator_window/window_style.h"
#include "test/ros/calibrator_window/window_states.h"

namespace plumb::ros_adapter {
namespace {

using test::CalibratedState;
using test::StateAfter;

// A window over a state that the test sets, whose buttons are counted.
class CalibratorWindowTest : public ::testing::Test {
 protected:
  void Show(const CalibratorState& state) {
    state_ = state;
    window_.Refresh();
  }

  template <typename Part>
  Part* Find(const char* name) {
    Part* part = window_.findChild<Part*>(name);
    EXPECT_NE(part, nullptr) << name;
    return part;
  }
  QPushButton* Button(const char* name) { return Find<QPushButton>(name); }
  std::string Text(const char* name) { return Find<QLabel>(name)->text().toStdString(); }

  void Press(const char* name) { QTest::mouseClick(Button(name), Qt::LeftButton); }

  std::string Enabled() {
    std::string names;
    for (const char* name : {"calibrate", "save", "commit"}) {
      if (Button(name)->isEnabled()) names += std::string(names.empty() ? "" : " ") + name;
    }
    return names;
  }

  CalibratorState state_ = StateAfter(0);
  int num_calibrate_ = 0;
  int num_save_ = 0;
  int num_commit_ = 0;
  CalibratorWindow window_{
      [this] { return state_; },
      {[this] { ++num_calibrate_; }, [this] { ++num_save_; }, [this] { ++num_commit_; }},
      CalibrationOptions()};
};

TEST_F(CalibratorWindowTest, OffersNoStepBeforeThereArePhotos) {
  EXPECT_EQ(Enabled(), "");
  EXPECT_EQ(Text("advice"), state_.progress.advice);
  Press("calibrate");
  EXPECT_EQ(num_calibrate_, 0);
}

TEST_F(CalibratorWindowTest, EachStepOpensTheNext) {
  Show(StateAfter(2));
  EXPECT_EQ(Enabled(), "");
  Show(StateAfter(6));
  EXPECT_EQ(Enabled(), "calibrate");
  Press("calibrate");
  Show(CalibratedState());
  EXPECT_EQ(Enabled(), "save commit");
  Press("save");
  Press("commit");
  CalibratorState state = CalibratedState();
  state.is_saved = state.is_committed = true;
  Show(state);
  EXPECT_EQ(Enabled(), "");
  EXPECT_EQ(std::tie(num_calibrate_, num_save_, num_commit_), std::make_tuple(1, 1, 1));
}

TEST_F(CalibratorWindowTest, SaysWhenItIsDone) {
  CalibratorState state = CalibratedState();
  Show(state);
  EXPECT_THAT(Text("advice"), ::testing::HasSubstr("Press Save."));
  state.is_saved = true;
  Show(state);
  EXPECT_THAT(Text("advice"), ::testing::HasSubstr("Done: saved. Commit"));
  state.is_committed = true;
  Show(state);
  EXPECT_THAT(Text("advice"), ::testing::HasSubstr("Done: saved, and the camera has it."));
  state.is_committed = state.has_driver = false;
  Show(state);
  EXPECT_THAT(Text("advice"), ::testing::EndsWith("Done: saved."));
}

TEST_F(CalibratorWindowTest, ALongWordDoesNotTouchTheButtonsRim) {
  CalibratorState state = CalibratedState();
  state.is_saved = state.is_committed = true;
  window_.resize(1024, 600);
  window_.show();
  Show(state);
  QTest::qWait(1);
  QPushButton* button = Button("commit");
  EXPECT_GE(button->width(),
            button->fontMetrics().horizontalAdvance(button->text()) + LetterHeight_px(window_));
}

TEST_F(CalibratorWindowTest, APhotoAfterTheCalibrationOffersToCalibrateAgain) {
  CalibratorState state = CalibratedState();
  state.is_result_current = false;
  Show(state);
  EXPECT_EQ(Enabled(), "calibrate save commit");
}

TEST_F(CalibratorWindowTest, AButtonPressedTwiceActsOnce) {
  Show(StateAfter(6));
  Press("calibrate");
  Press("calibrate");
  EXPECT_EQ(num_calibrate_, 1);
  window_.Refresh();  // It has not begun, or has ended without effect: it may be pressed again.
  EXPECT_EQ(Enabled(), "calibrate");
}

TEST_F(CalibratorWindowTest, NothingCanBePressedWhileSomethingIsDone) {
  CalibratorState state = CalibratedState();
  state.is_result_current = false;
  state.busy = "Calibrating 12 photos ...";
  state.outcome = {Outcome::Kind::kDone, "Saved."};
  Show(state);
  EXPECT_EQ(Enabled(), "");
  EXPECT_EQ(Text("outcome"), state.busy);
}

TEST_F(CalibratorWindowTest, AFailedCalibrationCanBeNeitherSavedNorCommitted) {
  CalibratorState state = StateAfter(6);
  CalibrationResult result;
  result.advice = "Take more photos.";
  state.result = std::make_shared<const CalibrationResult>(result);
  state.is_result_current = true;
  state.outcome = {Outcome::Kind::kFailed, "Not calibrated: Take more photos."};
  Show(state);
  EXPECT_EQ(Enabled(), "");
  EXPECT_EQ(Text("outcome"), state.outcome.text);
}

TEST_F(CalibratorWindowTest, WhatCannotBeReliedOnIsNotCommitted) {
  CalibratorState state = CalibratedState();
  CalibrationResult result = *state.result;
  result.findings.push_back(
      {CalibrationFinding::Kind::kMoved, true, "Marker 3 has moved.", {3}, {}});
  state.result = std::make_shared<const CalibrationResult>(result);
  Show(state);
  EXPECT_EQ(Enabled(), "save");
  EXPECT_EQ(Text("findings"), "Marker 3 has moved.");
}

TEST_F(CalibratorWindowTest, WithoutADriverThereIsNothingToCommitTo) {
  CalibratorState state = CalibratedState();
  state.has_driver = false;
  Show(state);
  EXPECT_EQ(Enabled(), "save");
}

TEST_F(CalibratorWindowTest, SaysWhatKeepsPhotosAway) {
  CalibratorState state = StateAfter(0);
  state.sources = {{"/camera/image: no image yet", true}};
  state.num_dropped = 7;
  Show(state);
  EXPECT_THAT(Text("sources"), ::testing::HasSubstr("/camera/image: no image yet"));
  EXPECT_THAT(Text("sources"), ::testing::HasSubstr("7 passed over"));
  EXPECT_THAT(Find<QLabel>("sources")->styleSheet().toStdString(),
              ::testing::HasSubstr(kBadColor.name().toStdString()));
}

TEST_F(CalibratorWindowTest, FollowsTheStateByItself) {
  state_ = StateAfter(6);
  EXPECT_TRUE(QTest::qWaitFor([this] { return Button("calibrate")->isEnabled(); }));
}

TEST_F(CalibratorWindowTest, EveryWordFitsASmallScreen) {
  CalibratorState state = CalibratedState();
  state.progress.findings.push_back(
      {CalibrationFinding::Kind::kMoved, true, "Marker 3 has moved.", {3}, {}});
  window_.resize(1024, 600);
  Show(state);
  window_.show();
  EXPECT_LE(window_.minimumSizeHint().height(), 600);
  EXPECT_LE(window_.minimumSizeHint().width(), 1024);
}

int CountColor(const QImage& image, const QColor& color) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y) == color ? 1 : 0;
  }
  return count;
}

TEST(PhotoView, RingsAreGreenForMarkersThatCountAndGreyForOthers) {
  auto view = *test::ViewOf(test::MakeCalibrationPhotos().front());
  const QColor green(0, 230, 80);
  PhotoView widget;
  widget.resize(1000, 700);
  widget.Show(std::make_shared<const CalibratorView>(view), "");
  const QImage counting = widget.grab().toImage();
  for (SeenMarker& marker : view.markers) marker.is_used = false;
  widget.Show(std::make_shared<const CalibratorView>(view), "");
  const QImage seen = widget.grab().toImage();
  EXPECT_GT(CountColor(counting, green), 1000);
  EXPECT_EQ(CountColor(seen, green), 0);
  EXPECT_GT(CountColor(seen, kSeenColor), 1000);
}

TEST(PhotoView, PixelsAreWhereTheImageHasThem) {
  CalibratorView view;
  view.name = "a";
  view.width_px = 1000;
  view.height_px = 500;
  view.gray = cv::Mat(50, 100, CV_8UC1, cv::Scalar(0));  // A tenth of its size.
  SeenMarker marker{7, {}, true};
  marker.ellipse.center_px = {249.5, 124.5};
  marker.ellipse.semi_major_px = marker.ellipse.semi_minor_px = 100.0;
  view.markers = {marker};
  PhotoView widget;
  widget.resize(1000, 700);
  widget.Show(std::make_shared<const CalibratorView>(view), "");
  const QImage image = widget.grab().toImage();
  int left = image.width();
  int right = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.pixelColor(x, y) != QColor(0, 230, 80)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  EXPECT_NEAR(0.5 * (left + right + 1), 250.0, 1.0);
  EXPECT_NEAR(right + 1 - left, 200.0, 12.0);  // The ring lies outside of the marker.
}

// No letter reaches into the first or the last row under the photo.
TEST(PhotoView, ALongNoteIsShownWhole) {
  CalibratorView view;
  view.name = "0005.jpg";
  view.is_problem = true;
  view.width_px = view.height_px = 100;
  view.gray = cv::Mat(100, 100, CV_8UC1, cv::Scalar(0));
  for (int i = 0; i < 12; ++i) view.note += "Marker 10 is not where the others have it. ";
  PhotoView widget;
  widget.resize(600, 400);
  widget.Show(std::make_shared<const CalibratorView>(view), "");
  const QImage image = widget.grab().toImage();
  const int right_of_bar = 30;
  const auto is_paper = [&](int y) {
    for (int x = right_of_bar; x < image.width(); ++x) {
      if (image.pixelColor(x, y) != kPaper) return false;
    }
    return true;
  };
  int top = image.height() - 1;
  while (top > 0 && image.pixelColor(image.width() - 1, top - 1) == kPaper) --top;
  EXPECT_LT(top, image.height() - 60);
  EXPECT_TRUE(is_paper(top));
  EXPECT_TRUE(is_paper(image.height() - 1));
}

TEST(PhotoView, AnUnreadablePhotoIsAWord) {
  CalibratorView view;
  view.name = "broken.jpg";
  view.is_problem = true;
  view.note = "the file is empty";
  PhotoView widget;
  widget.resize(600, 400);
  widget.Show(std::make_shared<const CalibratorView>(view), "");
  EXPECT_GT(CountColor(widget.grab().toImage(), kBadColor), 100);
}

// A bar that is not full is orange until the verdict is good.
TEST(BarsView, AGoodVerdictLeavesNoBarOrange) {
  CalibrationCoverage coverage = MeasureCoverage(test::MakeCalibrationPhotos());
  coverage.tilt[0].count = 1;
  BarsView bars;
  bars.resize(500, 300);
  bars.Show(coverage, /*is_good=*/false);
  EXPECT_GT(CountColor(bars.grab().toImage(), kDoubtfulColor), 100);
  bars.Show(coverage, /*is_good=*/true);
  const QImage good = bars.grab().toImage();
  EXPECT_EQ(CountColor(good, kDoubtfulColor), 0);
  EXPECT_GT(CountColor(good, kSeenColor), 100);
}

TEST(IsEnough, OnlyAGoodVerdictLetsTheImagesEnd) {
  EXPECT_FALSE(IsEnough(StateAfter(0)));
  EXPECT_FALSE(IsEnough(StateAfter(6)));
  EXPECT_TRUE(IsEnough(CalibratedState()));
}

TEST(EstimateRows, ALampForEachCriterion) {
  CalibrationProgress progress;
  progress.estimate = test::EstimateWith(0.04);
  CalibratorState state;
  state.progress = progress;
  CalibrationOptions options;
  options.max_principal_sigma_px = 0.6;  // Met by y, not by x.
  const std::vector<EstimateRow> rows = RowsOf(EstimateToShow(state), options);
  ASSERT_GE(rows.size(), 4U);
  EXPECT_EQ(rows[0].lamp, Lamp::kGood);
  EXPECT_EQ(rows[0].value.toStdString(), "1361.70 ± 0.54 px");
  EXPECT_EQ(rows[1].lamp, Lamp::kNotYet);
  EXPECT_EQ(rows[2].lamp, Lamp::kGood);
  EXPECT_EQ(rows[3].lamp, Lamp::kGood);
}

// For the eye: PLUMBLINE_PICTURES=dir keeps what the window looks like.
TEST_F(CalibratorWindowTest, LooksDifferentAtEachStage) {
  const QString folder = qEnvironmentVariable("PLUMBLINE_PICTURES");
  QImage before;
  int number = 0;
  for (const CalibratorState& state : {StateAfter(0), StateAfter(5), CalibratedState()}) {
    Show(state);
    const QImage picture = window_.grab().toImage();
    EXPECT_NE(picture, before);
    before = picture;
    if (!folder.isEmpty()) picture.save(QString("%1/window_%2.png").arg(folder).arg(++number));
  }
}

}  // namespace
}  // namespace plumb::ros_adapter
