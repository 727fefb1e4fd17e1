// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Drives the panel as a pilot would, in an RViz with rviz/flight.rviz: what is published must
// be read on it, what is pressed must be done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
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
#include <QtTest/QTest>
#include <functional>

#include "rviz/flight_panel.h"

namespace plumb::rviz_panel {
namespace {

constexpr int kDeadline_ms = 60000;

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
    gaps.gaps[0].advice = "Only 1 photo sees it. Fly 3.0 m right.";
    gaps.gaps[1].advice = "Too coarse.";
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
  WaitFor([] { return TextOf("lamp") == "photo1.jpg accepted."; }, "green");
  EXPECT_THAT(Find<QLabel>("lamp")->styleSheet().toStdString(), testing::HasSubstr("#0b7a25"));
  Publish(2, plumbline::PhotoVerdict::REFUSED, "too_blurred", "Fly slower.");
  WaitFor([] { return TextOf("lamp") == "photo2.jpg REFUSED: too blurred. Fly slower."; }, "red");
  EXPECT_THAT(Find<QLabel>("lamp")->styleSheet().toStdString(), testing::HasSubstr("#c40000"));
  Publish(1,
          plumbline::PhotoVerdict::ACCEPTED,
          "none",
          "");  // An older photo, tried again, changes nothing.
  Publish(3, plumbline::PhotoVerdict::WAITING, "none", "Take another.");
  WaitFor([] { return TextOf("lamp") == "photo3.jpg waits. Take another."; }, "yellow");
}

TEST_F(PanelTest, CountsAndDelayAreWhatTheNodesSay) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(2);
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
  diagnostics_.publish(array);
  WaitFor([] { return TextOf("behind") == "<b>1.3 s</b> behind the camera"; }, "the delay");
  EXPECT_THAT(TextOf("counts"), testing::HasSubstr("<b>12</b> taken"));
  EXPECT_THAT(TextOf("counts"), testing::HasSubstr("<b>8</b> accepted"));
  EXPECT_THAT(TextOf("counts"), testing::HasSubstr("<b>3</b> waiting"));
  EXPECT_THAT(TextOf("counts"), testing::HasSubstr("<b>1</b> refused"));
  EXPECT_FALSE(Find<QLabel>("trouble")->isVisible());

  array.status[1].level = diagnostic_msgs::DiagnosticStatus::ERROR;
  array.status[1].message = "the disk is full";
  diagnostics_.publish(array);
  WaitFor([] { return TextOf("trouble") == "mapper: the disk is full"; }, "the trouble");
  EXPECT_TRUE(Find<QLabel>("trouble")->isVisible());
  // Nobody speaks any more: no old figure stays.
  WaitFor([] { return TextOf("behind") == "– s behind the camera"; }, "the silence");
  EXPECT_THAT(TextOf("trouble"), testing::HasSubstr("is silent"));
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
  gaps_.publish(TwoGaps());
  auto* list = Find<QListWidget>("gaps");
  WaitFor([&] { return list->count() == 2; }, "two gaps");
  EXPECT_EQ(list->item(0)->text().toStdString(), "1  Only 1 photo sees it. Fly 3.0 m right.");
  const QRect second = list->visualItemRect(list->item(1));
  QTest::mouseClick(list->viewport(), Qt::LeftButton, Qt::NoModifier, second.center());
  rviz::ViewController* view = frame_->getManager()->getViewManager()->getCurrent();
  EXPECT_NEAR(view->subProp("Focal Point")->subProp("X")->getValue().toDouble(), 7.0, 1e-5);
  EXPECT_NEAR(view->subProp("Distance")->getValue().toDouble(), 8.0, 1e-5);
  EXPECT_EQ(view->subProp("Target Frame")->getValue().toString(), "map");
  Press("whole_view");
  view = frame_->getManager()->getViewManager()->getCurrent();
  EXPECT_EQ(view->subProp("Target Frame")->getValue().toString(), "map_overview");
  EXPECT_NEAR(view->subProp("Focal Point")->subProp("X")->getValue().toDouble(), 0.0, 1e-5);
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
  QTest::mouseClick(Find<QCheckBox>("colour_blind"), Qt::LeftButton, {}, QPoint(10, 10));
  WaitFor([&] { return asked.size() == 2; }, "the palette");
  EXPECT_EQ(asked[1].wanted_gsd, 0.0);
  EXPECT_EQ(asked[1].palette, "colour_blind");
  wanted->setValue(500.0);
  WaitFor([] { return TextOf("answer") == "wanted_gsd_mm is too large"; }, "the refusal");
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
