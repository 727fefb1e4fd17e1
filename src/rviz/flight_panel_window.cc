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
    "QWidget { background: white; color: black; font-size: 17px; }"
    "QPushButton { border: 2px solid black; border-radius: 4px; padding: 7px; font-weight: bold; }"
    "QPushButton:checked { background: black; color: white; }"
    "QPushButton:pressed { background: #505050; color: white; }"
    "QPushButton:disabled { color: #707070; border-color: #707070; }"
    "QListWidget { border: 2px solid black; font-size: 16px; }"
    "QListWidget::item { padding: 5px; border-bottom: 1px solid #a0a0a0; }"
    "QListWidget::item:selected { background: black; color: white; }"
    "QDoubleSpinBox { border: 2px solid black; padding: 4px; font-weight: bold; }"
    "QCheckBox::indicator { width: 22px; height: 22px; }";

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
  column->setSpacing(8);
  column->addWidget(BuildPhotos());
  column->addWidget(BuildLayers());
  column->addWidget(BuildGaps(), /*stretch=*/1);
  save_ = MakeButton("save", "Save");
  connect(save_, &QPushButton::clicked, this, &FlightPanel::OnSave);
  column->addWidget(save_);
  answer_ = MakeLabel("answer");
  column->addWidget(answer_);
}

QWidget* FlightPanel::BuildPhotos() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  auto* lamp_frame = new QWidget;  // Its own sheet: the lamp's changes with each photo.
  auto* lamp_column = new QVBoxLayout(lamp_frame);
  lamp_column->setContentsMargins(0, 0, 0, 0);
  lamp_frame->setStyleSheet("font-size: 22px; font-weight: bold; padding: 10px;");
  lamp_ = MakeLabel("lamp");
  lamp_->setMinimumHeight(96);
  lamp_->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  lamp_column->addWidget(lamp_);
  column->addWidget(lamp_frame);
  counts_ = MakeLabel("counts", "font-size: 22px;");
  behind_ = MakeLabel("behind", "font-size: 22px;");
  trouble_ = MakeLabel("trouble", "background: #c40000; color: white; font-weight: bold;");
  for (QLabel* label : {counts_, behind_, trouble_}) column->addWidget(label);
  return box;
}

QWidget* FlightPanel::BuildLayers() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
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
  legend_->setMinimumHeight(64);
  column->addWidget(legend_);
  auto* wanted = new QHBoxLayout;
  wanted->addWidget(new QLabel("Wanted GSD"));
  wanted_gsd_ = new QDoubleSpinBox;
  wanted_gsd_->setObjectName("wanted_gsd");
  wanted_gsd_->setRange(0.1, 1000.0);
  wanted_gsd_->setDecimals(1);
  wanted_gsd_->setSingleStep(0.5);
  wanted_gsd_->setKeyboardTracking(false);
  connect(wanted_gsd_,
          QOverload<double>::of(&QDoubleSpinBox::valueChanged),
          this,
          &FlightPanel::OnWantedGsd);
  wanted->addWidget(wanted_gsd_);
  wanted_unit_ = MakeLabel("wanted_unit");
  wanted->addWidget(wanted_unit_, /*stretch=*/1);
  column->addLayout(wanted);
  is_color_blind_ = new QCheckBox("Colours for the colour-blind");
  is_color_blind_->setObjectName("colour_blind");
  connect(is_color_blind_, &QCheckBox::toggled, this, &FlightPanel::OnPalette);
  column->addWidget(is_color_blind_);
  return box;
}

QWidget* FlightPanel::BuildGaps() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  gaps_title_ = MakeLabel("gaps_title", "font-weight: bold;");
  gaps_title_->setText("No mesh yet.");
  column->addWidget(gaps_title_);
  gap_list_ = new QListWidget;
  gap_list_->setObjectName("gaps");
  gap_list_->setWordWrap(true);
  gap_list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  connect(gap_list_, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
    OnGapClicked(gap_list_->row(item));
  });
  column->addWidget(gap_list_, /*stretch=*/1);
  QPushButton* whole = MakeButton("whole_view", "Show the whole map");
  connect(whole, &QPushButton::clicked, this, &FlightPanel::OnWholeView);
  column->addWidget(whole);
  return box;
}

}  // namespace plumb::rviz_panel
