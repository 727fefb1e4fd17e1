// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_window/coverage_view.h"

#include <QPainter>
#include <cmath>

#include "ros/calibrator_window/window_style.h"

namespace plumb::ros_adapter {
namespace {

// So many centres in a cell are shown in the darkest colour.
constexpr int kManyCenters = 6;

const QColor kTouchedColor(222, 243, 225);

QColor ColorOf(int count, bool is_touched) {
  if (count == 0) return is_touched ? kTouchedColor : kPaper;
  const double share = std::min(1.0, static_cast<double>(count) / kManyCenters);
  const auto mix = [share](int pale, int dark) {
    return static_cast<int>(std::lround(pale + share * (dark - pale)));
  };
  return {mix(190, 0), mix(232, 100), mix(196, 40)};
}

}  // namespace

CoverageView::CoverageView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(200, 120);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void CoverageView::Show(const CalibrationCoverage& coverage) {
  coverage_ = coverage;
  update();
}

void CoverageView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const int title_px = 3 * LetterHeight_px(*this) / 2;
  painter.setPen(kInk);
  painter.setFont(FontOf(*this, 1.0, /*is_bold=*/true));
  painter.drawText(QRect(5 * title_px / 6, 0, width(), title_px),
                   Qt::AlignLeft | Qt::AlignVCenter,
                   QString("Touched: %1 % of the image. Numbers: centres")
                       .arg(std::lround(100.0 * coverage_.image_share)));
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(kInk, 1.5));
  painter.setBrush(coverage_.image_share >= kWantedImageShare ? kGoodColor : kDoubtfulColor);
  painter.drawEllipse(QPointF(0.4 * title_px, 0.5 * title_px), 0.27 * title_px, 0.27 * title_px);
  painter.setBrush(Qt::NoBrush);
  painter.setRenderHint(QPainter::Antialiasing, false);
  const bool is_known = coverage_.width_px > 0 && coverage_.num_cols > 0;
  const QSizeF shape = is_known ? QSizeF(coverage_.width_px, coverage_.height_px) : QSizeF(3, 2);
  QRectF target(QPointF(), shape.scaled(QSizeF(width(), height() - title_px), Qt::KeepAspectRatio));
  target.moveCenter(QPointF(width() / 2.0, title_px + (height() - title_px) / 2.0));
  painter.fillRect(target, kPaper);
  if (is_known) {
    const QSizeF cell(target.width() / coverage_.num_cols, target.height() / coverage_.num_rows);
    painter.setFont(FontOf(*this, 0.75));
    const bool has_numbers = cell.height() > painter.fontMetrics().height() &&
                             cell.width() > painter.fontMetrics().horizontalAdvance("00");
    for (int row = 0; row < coverage_.num_rows; ++row) {
      for (int col = 0; col < coverage_.num_cols; ++col) {
        const int count = coverage_.CentersInCell(col, row);
        const QRectF area(
            QPointF(target.x() + col * cell.width(), target.y() + row * cell.height()), cell);
        painter.fillRect(area, ColorOf(count, coverage_.IsCellTouched(col, row)));
        painter.setPen(kLine);
        painter.drawRect(area);
        if (count == 0 || !has_numbers) continue;
        painter.setPen(2 * count > kManyCenters ? kPaper : kInk);
        painter.drawText(area, Qt::AlignCenter, QString::number(count));
      }
    }
  }
  painter.setPen(QPen(kInk, 2.0));
  painter.drawRect(target);
}

}  // namespace plumb::ros_adapter
