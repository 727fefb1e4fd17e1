// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Gaps.h>

#include <QListWidget>
#include <QWidget>
#include <cstddef>
#include <functional>

namespace plumb::rviz_panel {

// The gaps, a row of two lines each: the way there, and what is wrong. Rows are as high as a finger
// in a glove needs them, and none is ever cut: the list is as many rows high as there is room for.
class GapList : public QWidget {
 public:
  // `on_click` gets the index of the gap.
  explicit GapList(std::function<void(std::size_t)> on_click);

  // Those from `first` on.
  void Show(const plumbline::Gaps& gaps, std::size_t first);

  // The view is of none of them any more.
  void ClearChoice() { list_->clearSelection(); }

  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void FitRows();

  QListWidget* list_;
};

}  // namespace plumb::rviz_panel
