// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

#include "plumbline/calibration/calibration_coverage.h"

namespace plumb::ros_adapter {

// Distance, tilt, direction and turn as bars: how many photos there are of how many wanted.
// Green and ticked where there are enough; grey with a note instead of orange where there are not
// and the verdict is good all the same.
class BarsView : public QWidget {
 public:
  explicit BarsView(QWidget* parent = nullptr);

  void Show(const CalibrationCoverage& coverage, bool is_good);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Group {
    QString title;
    std::vector<CoverageBar> bars;
  };

  std::vector<Group> groups_;
  bool is_good_ = false;
  QString note_;  // Under the bars; empty: none.
};

}  // namespace plumb::ros_adapter
