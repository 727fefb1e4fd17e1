// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QWidget>
#include <memory>

#include "ros/calibrator_state.h"

class QPainter;

namespace plumb::ros_adapter {

// The image that was looked at last, with its markers: a green ring and the ID for those that
// count, a grey one for those that were seen and do not; under it what became of it.
class PhotoView : public QWidget {
 public:
  explicit PhotoView(QWidget* parent = nullptr);

  // `idle_text` stands in the place of an image before the first one.
  void Show(std::shared_ptr<const CalibratorView> view, const QString& idle_text);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void PaintMarkers(const QRectF& target, QPainter* painter) const;
  QString CaptionText() const;
  int CaptionHeight_px() const;
  void PaintCaption(const QRect& area, QPainter* painter) const;

  std::shared_ptr<const CalibratorView> view_;
  QImage image_;
  QString idle_text_;
};

}  // namespace plumb::ros_adapter
