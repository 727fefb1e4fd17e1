// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_window/bars_view.h"

#include <QPainter>
#include <algorithm>

#include "ros/calibrator_window/window_style.h"

namespace plumb::ros_adapter {
namespace {

constexpr int kNumColumns = 2;

bool IsFull(const CoverageBar& bar) { return bar.count >= bar.wanted; }

// What is not wanted has a number and no bar.
void PaintBar(const CoverageBar& bar, bool is_good, const QRect& area, QPainter* painter) {
  const int label_px = 63 * area.width() / 100;
  const QRect label = area.adjusted(0, 0, label_px - area.width(), 0);
  const int inset_px = std::max(2, area.height() / 7);
  const QRect frame = area.adjusted(label_px + inset_px, inset_px, 0, -inset_px);
  painter->setPen(kInk);
  painter->drawText(label,
                    Qt::AlignLeft | Qt::AlignVCenter,
                    painter->fontMetrics().elidedText(
                        QString::fromStdString(bar.label), Qt::ElideRight, label.width()));
  if (bar.wanted == 0) {
    painter->drawText(frame, Qt::AlignCenter, QString::number(bar.count));
    return;
  }
  const double share = std::min(1.0, static_cast<double>(bar.count) / bar.wanted);
  painter->fillRect(frame, kPaper);
  QRect filled = frame;
  filled.setWidth(static_cast<int>(share * frame.width()));
  painter->fillRect(filled, IsFull(bar) ? kGoodColor : is_good ? kSeenColor : kDoubtfulColor);
  painter->setPen(kInk);
  painter->drawRect(frame);
  painter->setPen(IsFull(bar) ? kPaper : kInk);
  painter->drawText(frame,
                    Qt::AlignCenter,
                    QString("%1%2 of %3")
                        .arg(IsFull(bar) ? QString::fromUtf8("✓ ") : QString())
                        .arg(bar.count)
                        .arg(bar.wanted));
}

}  // namespace

BarsView::BarsView(QWidget* parent) : QWidget(parent) {
  setMinimumHeight(120);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void BarsView::Show(const CalibrationCoverage& coverage, bool is_good) {
  is_good_ = is_good;
  note_ = is_good && !IsEveryBarFull(coverage) ? QString(kNotFullButGood) : QString();
  const QString rough = coverage.is_tilt_estimated || coverage.num_photos == 0 ? "" : " (rough)";
  groups_ = {{"Distance", coverage.distance},
             {"Tilt" + rough, coverage.tilt},
             {"Direction" + rough, coverage.direction},
             {"Camera turned", coverage.turn}};
  for (Group& group : groups_) {
    const auto says_nothing = [](const CoverageBar& bar) {
      return bar.wanted == 0 && bar.count == 0;
    };
    group.bars.erase(std::remove_if(group.bars.begin(), group.bars.end(), says_nothing),
                     group.bars.end());
  }
  update();
}

// Two columns of groups, each with its title above.
void BarsView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (groups_.empty()) return;
  std::size_t num_rows = 0;
  for (std::size_t i = 0; i < groups_.size(); i += kNumColumns) {
    std::size_t tallest = 0;
    for (std::size_t k = i; k < std::min(groups_.size(), i + kNumColumns); ++k) {
      tallest = std::max(tallest, groups_[k].bars.size());
    }
    num_rows += tallest + 1;
  }
  const int between_px = LetterHeight_px(*this) / 2;  // Two rows of groups.
  if (!note_.isEmpty()) ++num_rows;
  const int row_px = (height() - between_px) / static_cast<int>(std::max<std::size_t>(num_rows, 1));
  const int gap_px = LetterHeight_px(*this);
  const int column_px = (width() - gap_px) / kNumColumns;
  int top_px = 0;
  for (std::size_t i = 0; i < groups_.size(); i += kNumColumns) {
    int bottom_px = top_px;
    for (std::size_t k = i; k < std::min(groups_.size(), i + kNumColumns); ++k) {
      QRect area(static_cast<int>(k - i) * (column_px + gap_px), top_px, column_px, row_px);
      painter.setFont(FontOf(*this, 0.95, /*is_bold=*/true));
      painter.setPen(kInk);
      painter.drawText(area, Qt::AlignLeft | Qt::AlignVCenter, groups_[k].title);
      painter.setFont(FontOf(*this, 0.8));
      for (const CoverageBar& bar : groups_[k].bars) {
        area.translate(0, row_px);
        PaintBar(bar, is_good_, area, &painter);
      }
      bottom_px = std::max(bottom_px, area.bottom() + 1);
    }
    top_px = bottom_px + between_px;
  }
  painter.setPen(kInk);
  painter.drawText(QRect(0, height() - row_px, width(), row_px), Qt::AlignVCenter, note_);
}

}  // namespace plumb::ros_adapter
