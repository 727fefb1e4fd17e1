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

#include "rviz/target_line.h"

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
      return "background: #35d04a; color: black;";
    case Lamp::kYellow:
      return "background: #ffd400; color: black;";
    case Lamp::kRed:
      return "background: #b00000; color: white;";
    case Lamp::kDark:
      break;
  }
  return "background: #404040; color: white;";
}

// A number over the word for it.
QString Cell(const QString& number, const char* word) {
  return QStringLiteral(
             "<td align='center'><span style='font-size: 22px'><b>%1</b></span><br>%2</td>")
      .arg(number, word);
}

QString Cell(const std::optional<int>& count, const char* word) {
  return Cell(count ? QString::number(*count) : QStringLiteral("–"), word);
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
      handle_.subscribe(namespace_ + "/georeference", 1, &FlightPanel::OnGeoreference, this),
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
  const QString style = StyleOf(status_.lamp());
  if (lamp_->styleSheet() != style) lamp_->setStyleSheet(style);
  lamp_->setText(QString::fromStdString(status_.sentence()));
  const std::optional<double> behind_s = status_.seconds_behind(now_s);
  counts_->setText(
      "<table width='100%'><tr>" + Cell(status_.num_taken(now_s), "taken") +
      Cell(status_.num_accepted(now_s), "accepted") + Cell(status_.num_waiting(now_s), "waiting") +
      Cell(status_.num_refused(now_s), "refused") +
      Cell(behind_s ? QString::number(*behind_s, 'f', 1) + " s" : QStringLiteral("–"), "behind") +
      "</tr></table>");
  trouble_->setText(QString::fromStdString(status_.trouble(now_s)));
  trouble_->setVisible(!trouble_->text().isEmpty());
  const NextStep next = NextStepOf(status_, gaps_, now_s);
  next_->Show(next);
  const std::size_t first_listed = next.kind == NextStep::Kind::kGap ? 1 : 0;
  if (first_listed == first_listed_gap_) return;
  first_listed_gap_ = first_listed;
  ShowGaps();
}

void FlightPanel::OnGaps(const plumbline::Gaps& msg) {
  gaps_ = msg;
  ShowStatus();
  ShowGaps();
  wanted_unit_->setText(msg.is_metric != 0 ? QStringLiteral("Wanted GSD\n[mm per pixel]")
                                           : QStringLiteral("Wanted GSD\n[x first photos']"));
  if (wanted_gsd_->hasFocus()) return;  // It is being typed in.
  wanted_gsd_->blockSignals(true);
  wanted_gsd_->setValue(msg.wanted_gsd);
  wanted_gsd_->blockSignals(false);
}

void FlightPanel::OnGeoreference(const plumbline::Georeference& msg) {
  const TargetLine line = TargetLineOf(msg);
  targets_->setText(QString::fromStdString(line.text));
  targets_->setStyleSheet(line.is_warning ? kWarningStyle : "");
  targets_->setVisible(!line.text.empty());
}

// The one that the next step leads to is not told twice.
void FlightPanel::ShowGaps() {
  if (!gaps_) return;
  gap_list_->Show(*gaps_, first_listed_gap_);
  const bool is_any = gaps_->gaps.size() > first_listed_gap_;
  gaps_title_->setText(is_any ? QStringLiteral("Then: press to look there")
                              : QStringLiteral("No other gaps"));
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
  legend_image_ = image.copy();
  ShowLegend();
}

// A picture must not make the panel wider.
void FlightPanel::ShowLegend() {
  if (legend_image_.isNull()) return;
  legend_->setPixmap(QPixmap::fromImage(
      legend_image_.scaled(legend_->size(), Qt::KeepAspectRatio, Qt::SmoothTransformation)));
}

void FlightPanel::resizeEvent(QResizeEvent* event) {
  rviz::Panel::resizeEvent(event);
  ShowLegend();
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
  answer_->setVisible(true);
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
  answer_->setVisible(!said.text.empty());
  answer_->setStyleSheet(said.is_good ? "color: #08611c;" : "color: #b00000;");
  if (!save_answer_.valid()) save_->setEnabled(true);
}

// Looks at the gap straight on, from a little behind where its photo is to be taken.
void FlightPanel::LookAt(std::size_t index) {
  if (!gaps_ || index >= gaps_->gaps.size()) return;
  const plumbline::Gap& gap = gaps_->gaps[index];
  const geometry_msgs::Point& center = gap.center_in_map;
  const double distance = std::sqrt(std::pow(gap.camera_in_map.x - center.x, 2) +
                                    std::pow(gap.camera_in_map.y - center.y, 2) +
                                    std::pow(gap.camera_in_map.z - center.z, 2));
  rviz::ViewController* view = OrbitView(vis_manager_->getViewManager());
  view->subProp("Target Frame")->setValue(QString::fromStdString(gaps_->header.frame_id));
  view->subProp("Focal Point")->subProp("X")->setValue(center.x);
  view->subProp("Focal Point")->subProp("Y")->setValue(center.y);
  view->subProp("Focal Point")->subProp("Z")->setValue(center.z);
  view->subProp("Distance")->setValue(1.6 * distance);
  view->subProp("Yaw")->setValue(std::atan2(gap.normal_in_map.y, gap.normal_in_map.x) + 0.3);
  view->subProp("Pitch")->setValue(std::asin(std::clamp(gap.normal_in_map.z, -1.0, 1.0)) + 0.2);
}

void FlightPanel::OnWholeView() {
  gap_list_->ClearChoice();
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
