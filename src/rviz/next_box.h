// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>
#include <QLabel>
#include <functional>

#include "rviz/next_step.h"

namespace plumb::rviz_panel {

// The next step in large letters; in the ink of the gaps on the map if it leads to one.
class NextBox : public QFrame {
 public:
  explicit NextBox(std::function<void()> on_click);

  void Show(const NextStep& step);

 protected:
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  std::function<void()> on_click_;
  QLabel* action_;
  QLabel* reason_;
};

}  // namespace plumb::rviz_panel
