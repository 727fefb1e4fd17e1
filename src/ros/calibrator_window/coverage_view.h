// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "plumbline/calibration/calibration_coverage.h"

namespace plumb::ros_adapter {

// Heat map over the image area: white where no marker was seen yet, pale where only a marker's face
// reached, the darker the more centres; their number is in the cell.
class CoverageView : public QWidget {
 public:
  explicit CoverageView(QWidget* parent = nullptr);

  void Show(const CalibrationCoverage& coverage);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  CalibrationCoverage coverage_;
};

}  // namespace plumb::ros_adapter
