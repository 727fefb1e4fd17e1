// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rviz/flight_panel.h"

#include <plumbline/SetMeshDisplay.h>
#include <ros/service.h>
#include <rviz/display.h>
#include <rviz/display_group.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>
#include <sensor_msgs/image_encodings.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <pluginlib/class_list_macros.hpp>
#include <thread>

namespace plumb::rviz_panel {
namespace {

constexpr int kPeriod_ms = 200;

struct LayerName {
  const char* topic;
  const char* label;
};
constexpr LayerName kLayers[] = {
    {"gsd", "GSD"}, {"redundancy", "Redundancy"}, {"accuracy", "Accuracy"}, {"plain", "Plain"}};

// The view that has all of the map in it: as in rviz/flight.rviz.
constexpr double kWholeDistance = 20.0;
constexpr double kWholeYaw_rad = 4.450589;
constexpr double kWholePitch_rad = 0.349066;

double Now_s() { return ros::SteadyTime::now().toSec(); }

const char* StyleOf(Lamp lamp) {
  switch (lamp) {
    case Lamp::kGreen:
      return "background: #0b7a25; color: white;";
    case Lamp::kYellow:
      return "background: #ffd400; color: black;";
    case Lamp::kRed:
      return "background: #c40000; color: white;";
    case Lamp::kDark:
      break;
  }
  return "background: #404040; color: white;";
}

QString Text(const std::optional<int>& count) {
  return count ? QString::number(*count) : QStringLiteral("–");
}

// An orbiting view that is there already is kept: RViz may still have news of it in its queue.
rviz::ViewController* OrbitView(rviz::ViewManager* views) {
  const QString orbit = "rviz/Orbit";
  if (views->getCurrent() == nullptr || views->getCurrent()->getClassId() != orbit) {
    views->setCurrentViewControllerType(orbit);
  }
  return views->getCurrent();
}

// A service of a node that hangs must not hold RViz up: the thread is left to itself.
template <typename Function>
auto InThread(Function function) {
  std::packaged_task<decltype(function())()> task(std::move(function));
  auto future = task.get_future();
  std::thread(std::move(task)).detach();
  return future;
}

}  // namespace

FlightPanel::FlightPanel(QWidget* parent) : rviz::Panel(parent) {
  BuildWindow();
  timer_ = new QTimer(this);
  connect(timer_, &QTimer::timeout, this, &FlightPanel::OnTimer);
}

FlightPanel::~FlightPanel() = default;

void FlightPanel::onInitialize() {
  Connect();
  ShowLayer();
  ShowStatus();
  timer_->start(kPeriod_ms);
}

void FlightPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString name;
  int layer = layer_;
  if (config.mapGetString("Namespace", &name)) namespace_ = name.toStdString();
  if (config.mapGetInt("Layer", &layer) && layer >= 0 && layer < 4) layer_ = layer;
  Connect();
  layers_->button(layer_)->setChecked(true);
  ShowLayer();
}

void FlightPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue("Namespace", QString::fromStdString(namespace_));
  config.mapSetValue("Layer", layer_);
}

void FlightPanel::Connect() {
  subscribers_ = {
      handle_.subscribe(namespace_ + "/photo_verdict", 1000, &FlightPanel::OnVerdict, this),
      handle_.subscribe(namespace_ + "/gaps", 1, &FlightPanel::OnGaps, this),
      handle_.subscribe("/diagnostics", 100, &FlightPanel::OnDiagnostics, this)};
  SubscribeLegend();
}

void FlightPanel::SubscribeLegend() {
  legend_subscriber_ = handle_.subscribe(
      namespace_ + "/legend_" + kLayers[layer_].topic, 1, &FlightPanel::OnLegend, this);
}

void FlightPanel::OnVerdict(const plumbline::PhotoVerdict& msg) {
  status_.OnVerdict(msg);
  ShowStatus();
}

void FlightPanel::OnDiagnostics(const diagnostic_msgs::DiagnosticArray& msg) {
  status_.OnDiagnostics(msg, Now_s());
}

void FlightPanel::OnTimer() {
  ShowStatus();
  ShowAnswer(&save_answer_);
  ShowAnswer(&display_answer_);
}

void FlightPanel::ShowStatus() {
  const double now_s = Now_s();
  lamp_->setStyleSheet(StyleOf(status_.lamp()));
  lamp_->setText(QString::fromStdString(status_.sentence()));
  counts_->setText(QStringLiteral("<b>%1</b> taken &nbsp; <b>%2</b> accepted<br><b>%3</b> waiting "
                                  "&nbsp; <b>%4</b> refused")
                       .arg(Text(status_.num_taken(now_s)),
                            Text(status_.num_accepted(now_s)),
                            Text(status_.num_waiting(now_s)),
                            Text(status_.num_refused(now_s))));
  const std::optional<double> behind_s = status_.seconds_behind(now_s);
  behind_->setText(
      behind_s
          ? QStringLiteral("<b>%1 s</b> behind the camera").arg(QString::number(*behind_s, 'f', 1))
          : QStringLiteral("– s behind the camera"));
  trouble_->setText(QString::fromStdString(status_.trouble(now_s)));
  trouble_->setVisible(!trouble_->text().isEmpty());
}

void FlightPanel::OnGaps(const plumbline::Gaps& msg) {
  gaps_ = msg;
  gap_list_->clear();
  for (std::size_t i = 0; i < msg.gaps.size(); ++i) {
    gap_list_->addItem(
        QStringLiteral("%1  %2").arg(i + 1).arg(QString::fromStdString(msg.gaps[i].advice)));
  }
  gaps_title_->setText(msg.gaps.empty() ? QStringLiteral("No gaps.")
                                        : QStringLiteral("Worst gaps – click to look there"));
  wanted_unit_->setText(msg.is_metric != 0 ? QStringLiteral("mm per pixel")
                                           : QStringLiteral("x the first photos' (not metric)"));
  if (wanted_gsd_->hasFocus()) return;  // It is being typed in.
  wanted_gsd_->blockSignals(true);
  wanted_gsd_->setValue(msg.wanted_gsd);
  wanted_gsd_->blockSignals(false);
}

void FlightPanel::OnLegend(const sensor_msgs::Image& msg) {
  const bool is_whole = msg.encoding == sensor_msgs::image_encodings::RGB8 && msg.width > 0 &&
                        msg.step >= 3 * msg.width &&
                        msg.data.size() >= std::size_t{msg.step} * msg.height;
  if (!is_whole) return;
  const QImage image(msg.data.data(),
                     static_cast<int>(msg.width),
                     static_cast<int>(msg.height),
                     static_cast<int>(msg.step),
                     QImage::Format_RGB888);
  legend_->setPixmap(QPixmap::fromImage(image).scaledToWidth(std::max(200, legend_->width()),
                                                             Qt::SmoothTransformation));
}

void FlightPanel::OnLayer(int layer) {
  layer_ = layer;
  ShowLayer();
  SubscribeLegend();
  Q_EMIT configChanged();
}

// The layers are displays of RViz: one is on.
void FlightPanel::ShowLayer() {
  layers_->button(layer_)->setChecked(true);
  if (vis_manager_ == nullptr) return;
  for (int i = 0; i < 4; ++i) {
    if (rviz::Display* display = DisplayOf(kLayers[i].topic)) display->setEnabled(i == layer_);
  }
}

rviz::Display* FlightPanel::DisplayOf(const std::string& layer) {
  const QString topic = QString::fromStdString(namespace_ + "/mesh_" + layer);
  rviz::DisplayGroup* group = vis_manager_->getRootDisplayGroup();
  for (int i = 0; i < group->numDisplays(); ++i) {
    rviz::Display* display = group->getDisplayAt(i);
    if (display->getClassId() != "rviz/MarkerArray") continue;  // Others have no such topic.
    if (display->subProp("Marker Topic")->getValue().toString() == topic) return display;
  }
  return nullptr;
}

void FlightPanel::OnWantedGsd() { AskDisplay(wanted_gsd_->value(), ""); }

void FlightPanel::OnPalette(bool is_color_blind) {
  AskDisplay(0.0, is_color_blind ? "colour_blind" : "paper");
}

void FlightPanel::AskDisplay(double wanted_gsd, const std::string& palette) {
  const std::string service = namespace_ + "/set_mesh_display";
  display_answer_ = InThread([service, wanted_gsd, palette]() -> Answer {
    plumbline::SetMeshDisplay request;
    request.request.wanted_gsd = wanted_gsd;
    request.request.palette = palette;
    if (!ros::service::call(service, request)) return {false, "The mesher does not answer."};
    return {request.response.success != 0, request.response.message};
  });
}

void FlightPanel::OnSave() {
  const std::string service = namespace_ + "/finish";
  save_->setEnabled(false);
  answer_->setText(QStringLiteral("Saving …"));
  save_answer_ = InThread([service]() -> Answer {
    std_srvs::Trigger request;
    if (!ros::service::call(service, request)) return {false, "The mapper does not answer."};
    const bool is_saved = request.response.success != 0;
    return {is_saved, (is_saved ? "Saved: " : "") + request.response.message};
  });
}

void FlightPanel::ShowAnswer(std::future<Answer>* answer) {
  if (!answer->valid()) return;
  if (answer->wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const Answer said = answer->get();
  answer_->setText(QString::fromStdString(said.text));
  answer_->setStyleSheet(said.is_good ? "color: #0b7a25;" : "color: #c40000;");
  if (!save_answer_.valid()) save_->setEnabled(true);
}

// Looks at the gap straight on, from a little behind where its photo is to be taken.
void FlightPanel::OnGapClicked(int row) {
  if (row < 0 || static_cast<std::size_t>(row) >= gaps_.gaps.size()) return;
  const plumbline::Gap& gap = gaps_.gaps[static_cast<std::size_t>(row)];
  const geometry_msgs::Point& center = gap.center_in_map;
  const double distance = std::sqrt(std::pow(gap.camera_in_map.x - center.x, 2) +
                                    std::pow(gap.camera_in_map.y - center.y, 2) +
                                    std::pow(gap.camera_in_map.z - center.z, 2));
  rviz::ViewController* view = OrbitView(vis_manager_->getViewManager());
  view->subProp("Target Frame")->setValue(QString::fromStdString(gaps_.header.frame_id));
  view->subProp("Focal Point")->subProp("X")->setValue(center.x);
  view->subProp("Focal Point")->subProp("Y")->setValue(center.y);
  view->subProp("Focal Point")->subProp("Z")->setValue(center.z);
  view->subProp("Distance")->setValue(1.6 * distance);
  view->subProp("Yaw")->setValue(std::atan2(gap.normal_in_map.y, gap.normal_in_map.x) + 0.3);
  view->subProp("Pitch")->setValue(std::asin(std::clamp(gap.normal_in_map.z, -1.0, 1.0)) + 0.2);
}

void FlightPanel::OnWholeView() {
  rviz::ViewController* view = OrbitView(vis_manager_->getViewManager());
  view->subProp("Target Frame")->setValue("map_overview");
  for (const char* axis : {"X", "Y", "Z"}) {
    view->subProp("Focal Point")->subProp(axis)->setValue(0.0);
  }
  view->subProp("Distance")->setValue(kWholeDistance);
  view->subProp("Yaw")->setValue(kWholeYaw_rad);
  view->subProp("Pitch")->setValue(kWholePitch_rad);
}

}  // namespace plumb::rviz_panel

PLUGINLIB_EXPORT_CLASS(plumb::rviz_panel::FlightPanel, rviz::Panel)
