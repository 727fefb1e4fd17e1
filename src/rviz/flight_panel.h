// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <plumbline/Gaps.h>
#include <plumbline/Georeference.h>
#include <plumbline/PhotoVerdict.h>
#include <ros/node_handle.h>
#include <rviz/panel.h>
#include <sensor_msgs/Image.h>

#include <QButtonGroup>
#include <QDoubleSpinBox>
#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QTimer>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "rviz/flight_status.h"
#include "rviz/gap_list.h"
#include "rviz/next_box.h"

namespace rviz {
class Display;
}

namespace plumb::rviz_panel {

// For the pilot: what became of the last photo, what to do next, how far the mapper is behind, what
// the colours mean, and the other gaps. For the sun and for gloves: letters of 16 px and more, at
// least 7:1 against what is behind them; whatever is pressed is 44 px high. Lives in RViz's thread,
// in which ROS calls it back; services are asked in threads of their own.
class FlightPanel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit FlightPanel(QWidget* parent = nullptr);
  ~FlightPanel() override;

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private Q_SLOTS:
  void OnLayer(int layer);
  void OnWantedGsd();
  void OnPalette(bool is_color_blind);
  void OnWholeView();
  void OnSave();
  void OnTimer();

 private:
  // What a service answered, or that it did not.
  struct Answer {
    bool is_good = false;
    std::string text;
  };

  static constexpr char kWarningStyle[] =
      "background: #b00000; color: white; font-weight: bold; padding: 4px;";

  void BuildWindow();
  QWidget* BuildPhotos();
  QWidget* BuildLayers();
  QWidget* BuildWantedGsd();
  QWidget* BuildGaps();
  QWidget* BuildSettings();
  QWidget* BuildButtons(QStackedWidget* pages);
  void Connect();
  void SubscribeLegend();
  void ShowStatus();
  void ShowGaps();
  void ShowLayer();
  void ShowLegend();
  void LookAt(std::size_t index);
  void ShowAnswer(std::future<Answer>* answer);
  void AskDisplay(double wanted_gsd, const std::string& palette);
  rviz::Display* DisplayOf(const std::string& layer);

  void OnVerdict(const plumbline::PhotoVerdict& msg);
  void OnDiagnostics(const diagnostic_msgs::DiagnosticArray& msg);
  void OnGaps(const plumbline::Gaps& msg);
  void OnGeoreference(const plumbline::Georeference& msg);
  void OnLegend(const sensor_msgs::Image& msg);

  std::string namespace_ = "/plumbline";
  int layer_ = 0;
  FlightStatus status_;
  std::optional<plumbline::Gaps> gaps_;
  std::size_t first_listed_gap_ = 0;
  QImage legend_image_;

  ros::NodeHandle handle_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber legend_subscriber_;
  std::future<Answer> save_answer_;
  std::future<Answer> display_answer_;
  QTimer* timer_;

  QLabel* lamp_;
  NextBox* next_;
  QLabel* counts_;
  QLabel* trouble_;
  QLabel* targets_;
  QButtonGroup* layers_;
  QLabel* legend_;
  QLabel* wanted_unit_;
  QDoubleSpinBox* wanted_gsd_;
  QLabel* gaps_title_;
  GapList* gap_list_;
  QPushButton* save_;
  QLabel* answer_;
};

}  // namespace plumb::rviz_panel
