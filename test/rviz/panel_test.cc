// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Drives the panel as a pilot would, in an RViz with rviz/flight.rviz: what is published must
// be read on it, what is pressed must be done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plumbline/Georeference.h>
#include <plumbline/SetMeshDisplay.h>
#include <ros/ros.h>
#include <rviz/display.h>
#include <rviz/display_group.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>
#include <std_srvs/Trigger.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QRegularExpression>
#include <QtTest/QTest>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "rviz/flight_panel.h"

namespace plumb::rviz_panel {
namespace {

constexpr int kDeadline_ms = 60000;
constexpr int kGlove_px = 44;

class PanelTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    frame_ = new rviz::VisualizationFrame;
    frame_->setShowChooseNewMaster(false);
    frame_->initialize(PLUMBLINE_SOURCE_DIR "/rviz/flight.rviz");
    frame_->show();
    panel_ = frame_->findChild<FlightPanel*>();
  }

  // Before the application ends, whose widgets they are.
  static void TearDownTestSuite() { delete frame_; }

  void SetUp() override {
    ASSERT_NE(panel_, nullptr) << "RViz did not load plumbline/Flight";
    verdicts_ = handle_.advertise<plumbline::PhotoVerdict>("/plumbline/photo_verdict", 10);
    gaps_ = handle_.advertise<plumbline::Gaps>("/plumbline/gaps", 1, true);
    diagnostics_ = handle_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
    legend_ = handle_.advertise<sensor_msgs::Image>("/plumbline/legend_redundancy", 1, true);
    WaitFor([&] { return verdicts_.getNumSubscribers() > 0; }, "a listener");
  }

  static int FontSizeOf(const QWidget* widget) { return widget->fontInfo().pixelSize(); }

  // Of a word below its number in the table.
  static std::string CountOf(const char* word) {
    const QRegularExpression cell(QString("<b>([^<]*)</b></span><br>%1<").arg(word));
    return cell.match(Find<QLabel>("counts")->text()).captured(1).toStdString();
  }

  // Relative luminance and contrast: WCAG 2.1, https://www.w3.org/TR/WCAG21/#dfn-contrast-ratio.
  static double Luminance(QRgb color) {
    const auto linear = [](int value) {
      const double share = value / 255.0;
      return share <= 0.03928 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(qRed(color)) + 0.7152 * linear(qGreen(color)) +
           0.0722 * linear(qBlue(color));
  }

  // As it is drawn: the largest contrast to what most of the widget shows. The inside of a letter
  // of 16 px is one pixel wide at least.
  static double ContrastOf(QWidget* widget) {
    const QImage image = widget->grab(widget->rect().adjusted(4, 4, -4, -4)).toImage();
    std::map<QRgb, int> counts;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) ++counts[image.pixel(x, y)];
    }
    const auto ground = std::max_element(
        counts.begin(), counts.end(), [](auto& a, auto& b) { return a.second < b.second; });
    double contrast = 1.0;
    for (const auto& [color, count] : counts) {
      const double one = Luminance(color) + 0.05;
      const double other = Luminance(ground->first) + 0.05;
      contrast = std::max(contrast, std::max(one, other) / std::min(one, other));
    }
    return contrast;
  }

  // Whatever of the panel has words on it now.
  static void ExpectLegible() {
    for (QWidget* widget : panel_->findChildren<QWidget*>()) {
      const auto* label = qobject_cast<QLabel*>(widget);
      const auto* button = qobject_cast<QPushButton*>(widget);
      const bool has_words = (label != nullptr && !label->text().isEmpty()) || button != nullptr;
      if (!widget->isVisible() || !has_words) continue;
      const std::string name = widget->objectName().toStdString();
      EXPECT_GE(ContrastOf(widget), 7.0) << name;
      EXPECT_GE(FontSizeOf(widget), 16) << name;
    }
  }

  // RViz runs meanwhile.
  static void WaitFor(const std::function<bool()>& condition, const char* what) {
    QElapsedTimer timer;
    timer.start();
    while (!condition()) {
      QApplication::processEvents(QEventLoop::AllEvents, 50);
      ros::spinOnce();
      ASSERT_LT(timer.elapsed(), kDeadline_ms) << "waited in vain for " << what;
    }
  }

  template <typename Widget>
  static Widget* Find(const char* name) {
    return panel_->findChild<Widget*>(name);
  }

  static std::string TextOf(const char* label) { return Find<QLabel>(label)->text().toStdString(); }

  static void Press(const char* button) {
    QTest::mouseClick(Find<QPushButton>(button), Qt::LeftButton);
  }

  static bool IsShown(const std::string& layer) {
    rviz::DisplayGroup* group = frame_->getManager()->getRootDisplayGroup();
    for (int i = 0; i < group->numDisplays(); ++i) {
      rviz::Display* display = group->getDisplayAt(i);
      if (display->getClassId() != "rviz/MarkerArray") continue;
      const QString topic = display->subProp("Marker Topic")->getValue().toString();
      if (topic.toStdString() == "/plumbline/mesh_" + layer) return display->isEnabled();
    }
    ADD_FAILURE() << "no display of " << layer;
    return false;
  }

  void Publish(std::uint32_t sequence,
               const std::string& status,
               const std::string& reason,
               const std::string& hint) {
    plumbline::PhotoVerdict verdict;
    verdict.sequence = sequence;
    verdict.name = "photo" + std::to_string(sequence) + ".jpg";
    verdict.status = status;
    verdict.reason = reason;
    verdict.hint = hint;
    verdicts_.publish(verdict);
  }

  static plumbline::Gaps TwoGaps() {
    plumbline::Gaps gaps;
    gaps.header.frame_id = "map";
    gaps.is_metric = 1;
    gaps.wanted_gsd = 4.0;
    gaps.gaps.resize(2);
    gaps.gaps[0].problem = "Only 1 photo sees it";
    gaps.gaps[0].way = "3.0 m right";
    gaps.gaps[0].camera_in_map.y = -10.0;
    gaps.gaps[0].normal_in_map.y = -1.0;
    gaps.gaps[1].problem = "Too coarse";
    gaps.gaps[1].center_in_map.x = 7.0;
    gaps.gaps[1].normal_in_map.y = -1.0;
    gaps.gaps[1].camera_in_map.x = 7.0;
    gaps.gaps[1].camera_in_map.y = -5.0;
    return gaps;
  }

  static rviz::VisualizationFrame* frame_;
  static FlightPanel* panel_;
  ros::NodeHandle handle_;
  ros::Publisher verdicts_;
  ros::Publisher gaps_;
  ros::Publisher diagnostics_;
  ros::Publisher legend_;
};

rviz::VisualizationFrame* PanelTest::frame_ = nullptr;
FlightPanel* PanelTest::panel_ = nullptr;

TEST_F(PanelTest, TheLampTellsWhatBecameOfTheLastPhoto) {
  Publish(1, plumbline::PhotoVerdict::ACCEPTED, "none", "");
  WaitFor([] { return TextOf("lamp") == "photo1.jpg accepted"; }, "green");
  EXPECT_THAT(Find<QLabel>("lamp")->styleSheet().toStdString(), testing::HasSubstr("#35d04a"));
  ExpectLegible();
  Publish(2, plumbline::PhotoVerdict::REFUSED, "too_blurred", "Fly slower.");
  WaitFor([] { return TextOf("lamp") == "photo2.jpg REFUSED: too blurred"; }, "red");
  EXPECT_THAT(Find<QLabel>("lamp")->styleSheet().toStdString(), testing::HasSubstr("#b00000"));
  ExpectLegible();
  // An older photo, tried again, changes nothing.
  Publish(1, plumbline::PhotoVerdict::ACCEPTED, "none", "");
  Publish(3, plumbline::PhotoVerdict::WAITING, "none", "too far; take another");
  WaitFor([] { return TextOf("lamp") == "photo3.jpg waits for a partner"; }, "yellow");
  ExpectLegible();
}

// A photo that was not accepted comes first, then the worst gap.
TEST_F(PanelTest, TheNextStepIsTheLargestButTheLamp) {
  Publish(4, plumbline::PhotoVerdict::WAITING, "none", "too far; take another");
  WaitFor([] { return TextOf("next_action") == "Take another"; }, "the hint");
  EXPECT_EQ(TextOf("next_reason"), "Too far");
  gaps_.publish(TwoGaps());
  auto* list = Find<QListWidget>("gaps");
  WaitFor([&] { return list->count() == 2; }, "both gaps in the list");
  EXPECT_EQ(list->item(0)->text().toStdString(), "G1  3.0 m right");
  Publish(5, plumbline::PhotoVerdict::ACCEPTED, "none", "");
  WaitFor([] { return TextOf("next_action") == "Fly 3.0 m right"; }, "the worst gap");
  EXPECT_EQ(TextOf("next_reason"), "G1: Only 1 photo sees it");
  EXPECT_EQ(list->count(), 1);  // It is not told twice.
  EXPECT_EQ(list->item(0)->text().toStdString(), "G2  photo from right here");
  ExpectLegible();
  const int size = FontSizeOf(Find<QLabel>("next_action"));
  for (const QLabel* label : panel_->findChildren<QLabel*>()) {
    const QString name = label->objectName();
    if (name == "lamp" || name == "next_action") continue;
    EXPECT_GT(size, FontSizeOf(label)) << name.toStdString();
  }
  QTest::mouseClick(Find<QFrame>("next"), Qt::LeftButton);
  rviz::ViewController* view = frame_->getManager()->getViewManager()->getCurrent();
  EXPECT_NEAR(view->subProp("Distance")->getValue().toDouble(), 16.0, 1e-5);
  gaps_.publish(plumbline::Gaps());
  WaitFor([] { return TextOf("next_action") == "No gaps: fly on, or save"; }, "no gaps");
}

TEST_F(PanelTest, NoRowOfTheListIsCut) {
  Publish(6, plumbline::PhotoVerdict::ACCEPTED, "none", "");
  plumbline::Gaps gaps = TwoGaps();
  gaps.gaps.resize(10, gaps.gaps[0]);
  for (plumbline::Gap& gap : gaps.gaps) gap.way = "12.0 m right, 10.5 m down, 2.4 m closer";
  gaps_.publish(gaps);
  auto* list = Find<QListWidget>("gaps");
  WaitFor([&] { return list->count() == 9; }, "nine gaps");
  EXPECT_LE(frame_->minimumSizeHint().height(), 768);  // Of a small laptop.
  for (const int height_px : {768, 831, 1000}) {
    frame_->resize(1600, height_px);
    WaitFor([&] { return frame_->height() == height_px; }, "the window's size");
    QApplication::processEvents();
    const int row_px = list->visualItemRect(list->item(0)).height();
    EXPECT_GE(row_px, kGlove_px);
    EXPECT_EQ(list->viewport()->height() % row_px, 0) << height_px;
    EXPECT_GE(list->viewport()->height(), 2 * row_px);
    EXPECT_LE(list->geometry().bottom(), list->parentWidget()->height());
  }
  EXPECT_GE(list->viewport()->height() / list->visualItemRect(list->item(0)).height(), 4);
}

TEST_F(PanelTest, WhatIsPressedIsLargeEnoughForAGlove) {
  Find<QPushButton>("settings")->setChecked(true);
  QApplication::processEvents();
  int num_seen = 0;
  for (const QWidget* widget : panel_->findChildren<QWidget*>()) {
    if (!widget->isVisible()) continue;
    const bool is_pressed = qobject_cast<const QPushButton*>(widget) != nullptr ||
                            qobject_cast<const QDoubleSpinBox*>(widget) != nullptr ||
                            widget->objectName() == "next";
    if (!is_pressed) continue;
    ++num_seen;
    EXPECT_GE(widget->height(), kGlove_px) << widget->objectName().toStdString();
    EXPECT_GE(widget->width(), kGlove_px) << widget->objectName().toStdString();
  }
  EXPECT_EQ(num_seen, 12);
  ExpectLegible();
  Find<QPushButton>("settings")->setChecked(false);
}

TEST_F(PanelTest, CountsAndDelayAreWhatTheNodesSay) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(3);
  const auto add = [](const char* key, const char* value, auto* status) {
    diagnostic_msgs::KeyValue pair;
    pair.key = key;
    pair.value = value;
    status->values.push_back(pair);
  };
  array.status[0].hardware_id = "camera_ingest";
  add("photos taken", "12", &array.status[0]);
  add("seconds behind the camera", "1.26", &array.status[0]);
  array.status[1].hardware_id = "mapper";
  add("photos accepted", "8", &array.status[1]);
  add("photos refused", "1", &array.status[1]);
  add("photos waiting", "0", &array.status[1]);
  array.status[2].hardware_id = "mesher";
  gaps_.publish(TwoGaps());
  WaitFor([] { return TextOf("next_action") == "Fly 3.0 m right"; }, "the worst gap");
  diagnostics_.publish(array);
  WaitFor([] { return CountOf("behind") == "1.3 s"; }, "the delay");
  EXPECT_EQ(CountOf("taken"), "12");
  EXPECT_EQ(CountOf("accepted"), "8");
  EXPECT_EQ(CountOf("waiting"), "3");
  EXPECT_EQ(CountOf("refused"), "1");
  EXPECT_FALSE(Find<QLabel>("trouble")->isVisible());

  array.status[1].level = diagnostic_msgs::DiagnosticStatus::ERROR;
  array.status[1].message = "the disk is full";
  diagnostics_.publish(array);
  WaitFor([] { return TextOf("trouble") == "mapper: the disk is full"; }, "the trouble");
  EXPECT_TRUE(Find<QLabel>("trouble")->isVisible());
  ExpectLegible();
  // Nobody speaks any more: no old figure stays.
  WaitFor([] { return CountOf("behind") == "–"; }, "the silence");
  EXPECT_THAT(TextOf("trouble"), testing::HasSubstr("is silent"));
  EXPECT_EQ(TextOf("next_action"), "Fly on as planned");  // No old advice, either.

  // Another flight, on a session that has photos.
  diagnostics_.publish(array);
  WaitFor([] { return CountOf("taken") == "12"; }, "the nodes again");
  // A verdict may come before its photo is counted.
  Publish(20, plumbline::PhotoVerdict::ACCEPTED, "none", "");
  WaitFor([] { return TextOf("lamp") == "photo20.jpg accepted"; }, "a verdict");
  diagnostics_.publish(array);
  WaitFor([] { return TextOf("trouble") == "mapper: the disk is full"; }, "the nodes");
  EXPECT_EQ(TextOf("lamp"), "photo20.jpg accepted");
  array.status[0].values[0].value = "2";
  array.status[1].values[0].value = "2";
  array.status[1].level = diagnostic_msgs::DiagnosticStatus::OK;
  diagnostics_.publish(array);
  WaitFor([] { return TextOf("lamp") == "Going on: 2 photos in the map"; }, "another flight");
  Publish(3, plumbline::PhotoVerdict::ACCEPTED, "none", "");
  WaitFor([] { return TextOf("lamp") == "photo3.jpg accepted"; }, "its first photo");
}

TEST_F(PanelTest, ALayerIsChosenByAPress) {
  for (const char* layer : {"redundancy", "accuracy", "plain", "gsd"}) {
    Press(layer);
    for (const char* other : {"gsd", "redundancy", "accuracy", "plain"}) {
      EXPECT_EQ(IsShown(other), std::string(other) == layer) << other;
    }
  }
}

TEST_F(PanelTest, TheLegendIsThatOfTheLayer) {
  Press("redundancy");
  sensor_msgs::Image image;
  image.encoding = "rgb8";
  image.width = 4;
  image.height = 1;
  image.step = 12;
  image.data = {255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0};
  legend_.publish(image);
  const auto middle = [] {
    const QPixmap pixmap = Find<QLabel>("legend")->pixmap(Qt::ReturnByValue);
    if (pixmap.isNull()) return QColor(Qt::black);
    return pixmap.toImage().pixelColor(pixmap.width() / 2, pixmap.height() / 2);
  };
  WaitFor([&] { return middle() == QColor(255, 0, 0); }, "the legend");
  image.data.resize(3);  // Cut short: not looked at.
  legend_.publish(image);
  image.data = {0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0, 255};
  legend_.publish(image);
  WaitFor([&] { return middle() == QColor(0, 0, 255); }, "the next legend");
}

TEST_F(PanelTest, AClickOnAGapLooksThere) {
  Publish(7, plumbline::PhotoVerdict::WAITING, "none", "Take another.");
  gaps_.publish(TwoGaps());
  auto* list = Find<QListWidget>("gaps");
  WaitFor([&] { return list->count() == 2; }, "two gaps");
  const QRect second = list->visualItemRect(list->item(1));
  QTest::mouseClick(list->viewport(), Qt::LeftButton, Qt::NoModifier, second.center());
  rviz::ViewController* view = frame_->getManager()->getViewManager()->getCurrent();
  EXPECT_NEAR(view->subProp("Focal Point")->subProp("X")->getValue().toDouble(), 7.0, 1e-5);
  EXPECT_NEAR(view->subProp("Distance")->getValue().toDouble(), 8.0, 1e-5);
  EXPECT_EQ(view->subProp("Target Frame")->getValue().toString(), "map");
  Press("whole_view");
  view = frame_->getManager()->getViewManager()->getCurrent();
  EXPECT_EQ(view->subProp("Target Frame")->getValue().toString(), "map_overview");
  EXPECT_TRUE(list->selectedItems().isEmpty());
  EXPECT_NEAR(view->subProp("Focal Point")->subProp("X")->getValue().toDouble(), 0.0, 1e-5);
}

TEST_F(PanelTest, ALineTellsHowTheModelFitsTheSurvey) {
  ros::Publisher places =
      handle_.advertise<plumbline::Georeference>("/plumbline/georeference", 1, true);
  auto* line = Find<QLabel>("targets");
  EXPECT_FALSE(line->isVisible());
  plumbline::Georeference place;
  place.source = plumbline::Georeference::GPS;
  places.publish(place);
  WaitFor([] { return TextOf("targets") == "Placed by GPS alone: metres off"; }, "GPS");
  EXPECT_TRUE(line->isVisible());
  place.source = plumbline::Georeference::NONE;
  place.survey = "survey.csv";
  places.publish(place);
  WaitFor([] { return TextOf("targets") == "Targets: too few seen yet to place the map"; }, "few");
  place.source = plumbline::Georeference::TARGETS;
  place.num_control = 5;
  place.control_mean_mm = 0.94;
  place.num_check = 2;
  place.check_mean_mm = 3.06;
  places.publish(place);
  WaitFor([] { return TextOf("targets") == "Targets: 5 control 0.9 mm, 2 check 3.1 mm"; }, "fit");
  ExpectLegible();
  place.targets.resize(5);
  for (std::size_t i = 0; i < 5; ++i) {
    place.targets[i].name = i == 1 ? "corner" : std::to_string(i);
    place.targets[i].state =
        i == 0 ? plumbline::TargetResidual::GOOD : plumbline::TargetResidual::WRONG;
  }
  places.publish(place);
  WaitFor([] { return TextOf("targets") == "WRONG targets, left out: corner, T2, T3 ..."; },
          "wrong");
  ExpectLegible();
  places.publish(plumbline::Georeference());
  WaitFor([&] { return !line->isVisible(); }, "nothing to tell");
}

TEST_F(PanelTest, TheWantedGsdAndThePaletteReachTheMesher) {
  std::vector<plumbline::SetMeshDisplay::Request> asked;
  const ros::ServiceServer server = handle_.advertiseService<plumbline::SetMeshDisplay::Request,
                                                             plumbline::SetMeshDisplay::Response>(
      "/plumbline/set_mesh_display",
      [&](plumbline::SetMeshDisplay::Request& request,
          plumbline::SetMeshDisplay::Response& response) {
        asked.push_back(request);
        response.success = request.wanted_gsd < 100.0 ? 1 : 0;
        response.message = "wanted_gsd_mm is too large";
        return true;
      });
  auto* wanted = Find<QDoubleSpinBox>("wanted_gsd");
  wanted->setValue(2.5);
  WaitFor([&] { return asked.size() == 1; }, "the wish");
  EXPECT_EQ(asked[0].wanted_gsd, 2.5);
  EXPECT_EQ(asked[0].palette, "");
  Press("settings");
  Press("colour_blind");
  WaitFor([&] { return asked.size() == 2; }, "the palette");
  EXPECT_EQ(asked[1].wanted_gsd, 0.0);
  EXPECT_EQ(asked[1].palette, "colour_blind");
  Press("coarser");
  WaitFor([&] { return asked.size() == 3; }, "the coarser wish");
  EXPECT_EQ(asked[2].wanted_gsd, 3.0);
  Press("settings");
  wanted->setValue(500.0);
  WaitFor([] { return TextOf("answer") == "wanted_gsd_mm is too large"; }, "the refusal");
  ExpectLegible();
}

TEST_F(PanelTest, SaveFinishesTheFlightAndSaysWhatCameOfIt) {
  Press("save");  // Nobody there.
  WaitFor([] { return TextOf("answer") == "The mapper does not answer."; }, "no answer");
  EXPECT_TRUE(Find<QPushButton>("save")->isEnabled());
  bool is_full = true;
  const ros::ServiceServer server =
      handle_.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
          "/plumbline/finish",
          [&](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
            response.success = is_full ? 0 : 1;
            response.message = is_full ? "not saved: the disk is full" : "12 accepted";
            return true;
          });
  Press("save");
  EXPECT_FALSE(Find<QPushButton>("save")->isEnabled());
  WaitFor([] { return TextOf("answer") == "not saved: the disk is full"; }, "the failure");
  is_full = false;
  Press("save");
  WaitFor([] { return TextOf("answer") == "Saved: 12 accepted"; }, "the answer");
  EXPECT_TRUE(Find<QPushButton>("save")->isEnabled());
}

}  // namespace
}  // namespace plumb::rviz_panel

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "panel_test", ros::init_options::AnonymousName);
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
