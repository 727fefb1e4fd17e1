// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_window/estimate_view.h"

#include <QPainter>
#include <algorithm>

#include "ros/calibrator_window/window_style.h"
#include "ros/calibrator_wording.h"

namespace plumb::ros_adapter {
namespace {

struct Coefficient {
  const char* name;
  LensParameter place;
};
constexpr Coefficient kCoefficients[] = {{"k1", kK1},
                                         {"k2", kK2},
                                         {"k3", kK3},
                                         {"p1", kP1},
                                         {"p2", kP2},
                                         {"k4", kK4},
                                         {"k5", kK5},
                                         {"k6", kK6}};

QString WithSigma(const LensEstimate& estimate, LensParameter parameter) {
  const auto place = static_cast<std::size_t>(parameter);
  const ValueText text = DescribeValue(estimate.camera.lens()[place], estimate.sigma[place]);
  return QString::fromUtf8("%1 ± %2").arg(QString::fromStdString(text.value),
                                          QString::fromStdString(text.sigma));
}

QString Number(double value, int digits) { return QString::fromStdString(NumberOf(value, digits)); }

Lamp LampOf(double value, double bound) { return value <= bound ? Lamp::kGood : Lamp::kNotYet; }

QString Bound(double value, double bound, int digits, const char* unit) {
  return QString("%1 %3 (max %2)").arg(Number(value, digits), Number(bound, digits), unit);
}

}  // namespace

std::vector<EstimateRow> RowsOf(const ShownEstimate& shown, const CalibrationOptions& options) {
  std::vector<EstimateRow> rows = {{"Focal length", "", "", Lamp::kOff},
                                   {"Principal point x", "", "", Lamp::kOff},
                                   {"Principal point y", "", "", Lamp::kOff},
                                   {"Distortion", "", "", Lamp::kOff}};
  if (shown.estimate == nullptr) {
    for (EstimateRow& row : rows) row.value = QString::fromUtf8("–");
    return rows;
  }
  const LensEstimate& estimate = *shown.estimate;
  rows[0].value = WithSigma(estimate, kFx) + " px";
  rows[0].bound = Bound(estimate.focal_sigma_percent, options.max_focal_sigma_percent, 3, "%");
  rows[0].lamp = LampOf(estimate.focal_sigma_percent, options.max_focal_sigma_percent);
  rows[1].value = WithSigma(estimate, kCx) + " px";
  rows[2].value = WithSigma(estimate, kCy) + " px";
  rows[1].bound = Bound(estimate.sigma[kCx], options.max_principal_sigma_px, 2, "px");
  rows[2].bound = Bound(estimate.sigma[kCy], options.max_principal_sigma_px, 2, "px");
  rows[1].lamp = LampOf(estimate.sigma[kCx], options.max_principal_sigma_px);
  rows[2].lamp = LampOf(estimate.sigma[kCy], options.max_principal_sigma_px);
  rows[3].value = QString::fromUtf8("± %1 px").arg(Number(estimate.distortion_sigma_px, 3));
  rows[3].bound = Bound(estimate.distortion_sigma_px, options.max_distortion_sigma_px, 3, "px");
  rows[3].lamp = LampOf(estimate.distortion_sigma_px, options.max_distortion_sigma_px);
  for (const Coefficient& coefficient : kCoefficients) {
    if (estimate.sigma[coefficient.place] <= 0.0) continue;  // Held.
    rows.push_back(
        {QString("  ") + coefficient.name, WithSigma(estimate, coefficient.place), "", Lamp::kOff});
  }
  return rows;
}

EstimateView::EstimateView(const CalibrationOptions& options, QWidget* parent)
    : QWidget(parent), options_(options) {
  setMinimumHeight(100);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void EstimateView::Show(const ShownEstimate& shown) {
  rows_ = RowsOf(shown, options_);
  update();
}

void EstimateView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const int row_px = std::min(height() / static_cast<int>(std::max<std::size_t>(rows_.size(), 9)),
                              3 * LetterHeight_px(*this) / 2);
  QRect area(0, 0, width(), row_px);
  for (const EstimateRow& row : rows_) {
    const double radius_px = 0.3 * row_px;
    const QPointF middle(area.left() + 0.5 * row_px, area.center().y() + 0.5);
    if (row.lamp != Lamp::kOff) {
      painter.setPen(QPen(kInk, 1.5));
      painter.setBrush(row.lamp == Lamp::kGood ? kGoodColor : kDoubtfulColor);
      painter.drawEllipse(middle, radius_px, radius_px);
    }
    painter.setPen(kInk);
    painter.setFont(FontOf(*this, 0.85, row.lamp != Lamp::kOff));
    const int name_px = 30 * width() / 100;
    const int value_px = 66 * width() / 100;
    painter.drawText(QRect(5 * row_px / 4, area.top(), name_px, row_px),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     row.name);
    painter.drawText(QRect(name_px, area.top(), value_px - name_px, row_px),
                     Qt::AlignRight | Qt::AlignVCenter,
                     row.value);
    painter.setFont(FontOf(*this, 0.75));
    painter.drawText(QRect(value_px, area.top(), width() - value_px, row_px),
                     Qt::AlignRight | Qt::AlignVCenter,
                     row.bound);
    area.translate(0, row_px);
  }
}

}  // namespace plumb::ros_adapter
