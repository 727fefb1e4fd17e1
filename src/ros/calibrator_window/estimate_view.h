// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

#include "plumbline/calibration/calibration_options.h"
#include "ros/calibrator_state.h"

namespace plumb::ros_adapter {

enum class Lamp { kOff, kNotYet, kGood };

struct EstimateRow {
  QString name;
  QString value;  // With its standard deviation.
  QString bound;  // What it is held against; empty if nothing.
  Lamp lamp = Lamp::kOff;
};

// The lens with its standard deviations, and which of them are good enough.
std::vector<EstimateRow> RowsOf(const ShownEstimate& shown, const CalibrationOptions& options);

// The running estimate as a table with a lamp for each criterion.
class EstimateView : public QWidget {
 public:
  EstimateView(const CalibrationOptions& options, QWidget* parent = nullptr);

  void Show(const ShownEstimate& shown);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  const CalibrationOptions options_;
  std::vector<EstimateRow> rows_;
};

}  // namespace plumb::ros_adapter
