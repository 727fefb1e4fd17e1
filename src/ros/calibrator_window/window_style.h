// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QFont>
#include <QWidget>

namespace plumb::ros_adapter {

// Dark on light and few colours, each with a meaning: the window is read in the sun.
inline const QColor kInk(0, 0, 0);
inline const QColor kFaintInk(85, 85, 85);
inline const QColor kPaper(255, 255, 255);
inline const QColor kGround(232, 234, 237);
inline const QColor kLine(150, 150, 150);
inline const QColor kGoodColor(0, 130, 50);       // Done, enough, counts.
inline const QColor kDoubtfulColor(240, 150, 0);  // Not yet.
inline const QColor kBadColor(200, 0, 20);        // Failed, trouble.
inline const QColor kActionColor(0, 75, 190);     // What to press next.
inline const QColor kSeenColor(190, 190, 190);    // Seen but not used.

// Letters of the window [px]: they grow with it, so that it can be read from a step away.
inline int LetterHeight_px(const QWidget& widget) {
  const QSize size = widget.window()->size();
  return qBound(12, qMin(size.height() / 40, size.width() / 68), 40);
}

inline QFont FontOf(const QWidget& widget, double times = 1.0, bool is_bold = false) {
  QFont font = widget.font();
  font.setPixelSize(qMax(8, static_cast<int>(times * LetterHeight_px(widget))));
  font.setBold(is_bold);
  return font;
}

}  // namespace plumb::ros_adapter
