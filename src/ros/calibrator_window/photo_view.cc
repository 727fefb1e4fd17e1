// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_window/photo_view.h"

#include <QFontMetrics>
#include <QPainter>
#include <utility>

#include "ros/calibrator_window/window_style.h"

namespace plumb::ros_adapter {
namespace {

QImage ToQImage(const cv::Mat& gray) {
  if (gray.empty()) return {};
  const QImage shared(
      gray.data, gray.cols, gray.rows, static_cast<int>(gray.step), QImage::Format_Grayscale8);
  return shared.copy();
}

// The largest place for an image of this size, in the middle of the area.
QRectF Fit(const QSizeF& size, const QRectF& area) {
  QRectF target(QPointF(), size.scaled(area.size(), Qt::KeepAspectRatio));
  target.moveCenter(area.center());
  return target;
}

QColor ColorOf(const CalibratorView& view) {
  if (view.is_problem) return kBadColor;
  return view.is_taken ? kGoodColor : kFaintInk;
}

constexpr int kCaptionFlags = Qt::AlignVCenter | Qt::TextWordWrap;

QFont CaptionFont(const QWidget& widget) { return FontOf(widget, 1.0, /*is_bold=*/true); }

// Of the letters, beside the coloured bar.
QRect CaptionArea(const QRect& area, int letter_px) {
  return area.adjusted(letter_px, 0, -letter_px / 2, 0);
}

}  // namespace

PhotoView::PhotoView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(320, 240);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void PhotoView::Show(std::shared_ptr<const CalibratorView> view, const QString& idle_text) {
  if (view == view_ && idle_text == idle_text_) return;
  if (view != view_) image_ = view ? ToQImage(view->gray) : QImage();
  view_ = std::move(view);
  idle_text_ = idle_text;
  update();
}

void PhotoView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  const int caption_px = view_ ? CaptionHeight_px() : 0;
  const QRect area = rect().adjusted(0, 0, 0, -caption_px);
  painter.fillRect(area, QColor(40, 40, 40));
  if (!image_.isNull()) {
    const QRectF target = Fit(QSizeF(view_->width_px, view_->height_px), area);
    painter.drawImage(target, image_);
    painter.setClipRect(area);
    PaintMarkers(target, &painter);
    painter.setClipping(false);
  } else {
    painter.setPen(kPaper);
    painter.setFont(FontOf(*this, 1.3));
    const int margin_px = 2 * LetterHeight_px(*this);
    painter.drawText(area.adjusted(margin_px, margin_px, -margin_px, -margin_px),
                     Qt::AlignCenter | Qt::TextWordWrap,
                     view_ ? QString::fromStdString(view_->note) : idle_text_);
  }
  if (view_) PaintCaption(rect().adjusted(0, area.height(), 0, 0), &painter);
}

// Rings and IDs are drawn at the window's resolution, on a dark rim, to be seen on any ground.
void PhotoView::PaintMarkers(const QRectF& target, QPainter* painter) const {
  const double scale = target.width() / view_->width_px;
  const double pen_px = qMax(2.5, LetterHeight_px(*this) / 6.0);
  painter->setBrush(Qt::NoBrush);
  painter->setFont(FontOf(*this, 1.0, /*is_bold=*/true));
  for (const SeenMarker& marker : view_->markers) {
    const QColor color = marker.is_used ? QColor(0, 230, 80) : kSeenColor;
    painter->save();
    // Pixel (0, 0) of the image has its centre there.
    painter->translate(target.x() + scale * (marker.ellipse.center_px.x() + 0.5),
                       target.y() + scale * (marker.ellipse.center_px.y() + 0.5));
    painter->save();
    painter->rotate(marker.ellipse.angle_rad * 180.0 / M_PI);
    const QPointF radii(scale * marker.ellipse.semi_major_px + pen_px,
                        scale * marker.ellipse.semi_minor_px + pen_px);
    for (const auto& [ink, width_px] : {std::pair(kInk, 2.0 * pen_px), std::pair(color, pen_px)}) {
      painter->setPen(QPen(ink, width_px));
      painter->drawEllipse(QPointF(), radii.x(), radii.y());
    }
    painter->restore();
    const QString id = QString::number(marker.id);
    QRectF label = painter->fontMetrics().boundingRect(id);
    label.moveCenter(QPointF());
    label.adjust(-pen_px, 0.0, pen_px, 0.0);
    painter->fillRect(label, QColor(0, 0, 0, 190));
    painter->setPen(color);
    painter->drawText(label, Qt::AlignCenter, id);
    painter->restore();
  }
}

QString PhotoView::CaptionText() const {
  const QString name = QString::fromStdString(view_->name);
  return view_->note.empty() ? name : name + ": " + QString::fromStdString(view_->note);
}

// Of two lines, so that the photo seldom jumps, or of as many as there are; half is the photo's.
int PhotoView::CaptionHeight_px() const {
  const int letter_px = LetterHeight_px(*this);
  const QRect lines =
      QFontMetrics(CaptionFont(*this))
          .boundingRect(
              QRect(0, 0, CaptionArea(rect(), letter_px).width(), 0), kCaptionFlags, CaptionText());
  return qMin(qMax(5 * letter_px / 2, lines.height() + letter_px / 2), height() / 2);
}

void PhotoView::PaintCaption(const QRect& area, QPainter* painter) const {
  const int letter_px = LetterHeight_px(*this);
  painter->fillRect(area, kPaper);
  painter->fillRect(QRect(area.topLeft(), QSize(letter_px / 2, area.height())), ColorOf(*view_));
  painter->setPen(ColorOf(*view_));
  painter->setFont(CaptionFont(*this));
  painter->drawText(CaptionArea(area, letter_px), kCaptionFlags, CaptionText());
}

}  // namespace plumb::ros_adapter
