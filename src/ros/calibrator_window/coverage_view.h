// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "plumbline/calibration/calibration_coverage.h"

namespace plumb::ros_adapter {

// Heat map over the image area: white where no marker was seen yet, the darker the more; each
// cell with its number of marker centres.
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
