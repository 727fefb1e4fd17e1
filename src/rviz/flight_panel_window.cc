// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How the panel looks.
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "rviz/flight_panel.h"

namespace plumb::rviz_panel {
namespace {

// Black on white, and letters that are read at arm's length in the sun.
const char* const kStyle =
    "QWidget { background: white; color: black; font-size: 16px; }"
    "QPushButton { border: 2px solid black; border-radius: 4px; padding: 4px; font-weight: bold;"
    " min-height: 38px; }"
    "QPushButton:checked { background: black; color: white; }"
    "QPushButton:pressed { background: #404040; color: white; }"
    "QPushButton:disabled { color: #505050; border-color: #505050; }"
    "QListWidget { border: 2px solid black; }"
    "QScrollBar:vertical { width: 44px; border: 1px solid black; background: white; }"
    "QScrollBar::handle:vertical { background: #505050; min-height: 44px; margin: 2px; }"
    "QScrollBar::add-line, QScrollBar::sub-line { height: 0; }"
    "QDoubleSpinBox { border: 2px solid black; padding: 4px; font-size: 20px; font-weight: bold;"
    " min-height: 34px; }";

constexpr int kLamp_px = 56;
constexpr int kLegend_px = 88;
constexpr int kStepButton_px = 56;

QLabel* MakeLabel(const char* name, const char* style = "") {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setStyleSheet(style);
  label->setWordWrap(true);
  return label;
}

QPushButton* MakeButton(const char* name, const char* text) {
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  return button;
}

}  // namespace

void FlightPanel::BuildWindow() {
  setStyleSheet(kStyle);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(6);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(BuildPhotos());
  column->addWidget(BuildLayers());
  auto* pages = new QStackedWidget;
  pages->addWidget(BuildGaps());
  pages->addWidget(BuildSettings());
  column->addWidget(pages, /*stretch=*/1);
  column->addWidget(BuildButtons(pages));
  answer_ = MakeLabel("answer", "font-weight: bold;");
  answer_->setVisible(false);
  column->addWidget(answer_);
}

QWidget* FlightPanel::BuildPhotos() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  auto* lamp_frame = new QWidget;  // Its own sheet: the lamp's changes with each photo.
  auto* lamp_column = new QVBoxLayout(lamp_frame);
  lamp_column->setContentsMargins(0, 0, 0, 0);
  lamp_frame->setStyleSheet("font-size: 24px; font-weight: bold; padding: 4px 8px;");
  lamp_ = MakeLabel("lamp");
  lamp_->setMinimumHeight(kLamp_px);
  lamp_->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  lamp_column->addWidget(lamp_);
  column->addWidget(lamp_frame);
  next_ = new NextBox([this] { LookAt(0); });
  column->addWidget(next_);
  counts_ = MakeLabel("counts");
  trouble_ = MakeLabel("trouble", kWarningStyle);
  targets_ = MakeLabel("targets");
  targets_->setVisible(false);
  for (QLabel* label : {trouble_, counts_, targets_}) column->addWidget(label);
  return box;
}

QWidget* FlightPanel::BuildLayers() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  layers_ = new QButtonGroup(this);
  const char* const names[] = {"gsd", "redundancy", "accuracy", "plain"};
  const char* const labels[] = {"GSD", "Redundancy", "Accuracy", "Plain"};
  for (int i = 0; i < 4; ++i) {
    QPushButton* button = MakeButton(names[i], labels[i]);
    button->setCheckable(true);
    layers_->addButton(button, i);
    row->addWidget(button);
  }
  connect(layers_, &QButtonGroup::idClicked, this, &FlightPanel::OnLayer);
  column->addLayout(row);
  legend_ = MakeLabel("legend");
  legend_->setFixedHeight(kLegend_px);
  legend_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  legend_->setAlignment(Qt::AlignCenter);
  column->addWidget(legend_);
  return box;
}

// The arrows of a spin box are too small for a glove.
QWidget* FlightPanel::BuildWantedGsd() {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  wanted_unit_ = MakeLabel("wanted_unit");
  row->addWidget(wanted_unit_, /*stretch=*/1);
  wanted_gsd_ = new QDoubleSpinBox;
  wanted_gsd_->setObjectName("wanted_gsd");
  wanted_gsd_->setRange(0.1, 1000.0);
  wanted_gsd_->setDecimals(1);
  wanted_gsd_->setSingleStep(0.5);
  wanted_gsd_->setKeyboardTracking(false);
  wanted_gsd_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  wanted_gsd_->setAlignment(Qt::AlignCenter);
  connect(wanted_gsd_,
          QOverload<double>::of(&QDoubleSpinBox::valueChanged),
          this,
          &FlightPanel::OnWantedGsd);
  QPushButton* finer = MakeButton("finer", "−");
  QPushButton* coarser = MakeButton("coarser", "+");
  connect(finer, &QPushButton::clicked, wanted_gsd_, &QDoubleSpinBox::stepDown);
  connect(coarser, &QPushButton::clicked, wanted_gsd_, &QDoubleSpinBox::stepUp);
  for (QPushButton* button : {finer, coarser}) button->setFixedWidth(kStepButton_px);
  row->addWidget(finer);
  row->addWidget(wanted_gsd_);
  row->addWidget(coarser);
  return box;
}

QWidget* FlightPanel::BuildGaps() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  gaps_title_ = MakeLabel("gaps_title", "font-weight: bold;");
  gaps_title_->setText("No mesh yet");
  column->addWidget(gaps_title_);
  gap_list_ = new GapList([this](std::size_t index) { LookAt(index); });
  column->addWidget(gap_list_, /*stretch=*/1);
  return box;
}

// What is seldom touched in flight is behind the gaps.
QWidget* FlightPanel::BuildSettings() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addWidget(BuildWantedGsd());
  QPushButton* color_blind = MakeButton("colour_blind", "Colours for the colour-blind");
  color_blind->setCheckable(true);
  connect(color_blind, &QPushButton::toggled, this, &FlightPanel::OnPalette);
  column->addWidget(color_blind);
  column->addStretch();
  return box;
}

QWidget* FlightPanel::BuildButtons(QStackedWidget* pages) {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  QPushButton* whole = MakeButton("whole_view", "Whole map");
  connect(whole, &QPushButton::clicked, this, &FlightPanel::OnWholeView);
  QPushButton* settings = MakeButton("settings", "Settings");
  settings->setCheckable(true);
  connect(settings, &QPushButton::toggled, pages, [pages](bool is_on) {
    pages->setCurrentIndex(is_on ? 1 : 0);
  });
  save_ = MakeButton("save", "Save");
  connect(save_, &QPushButton::clicked, this, &FlightPanel::OnSave);
  for (QPushButton* button : {whole, settings, save_}) row->addWidget(button);
  return box;
}

}  // namespace plumb::rviz_panel
