// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rviz/next_box.h"

#include <QMouseEvent>
#include <QVBoxLayout>
#include <utility>

namespace plumb::rviz_panel {
namespace {

constexpr int kHeight_px = 108;  // Two large lines and a small one, so that it seldom grows.

// Longer than a way to a gap: smaller letters, or the rest of the panel has no room.
constexpr int kLong = 60;

QLabel* MakeLabel(const char* name, QVBoxLayout* column) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setAttribute(Qt::WA_TransparentForMouseEvents);
  column->addWidget(label);
  return label;
}

// A widget is polished anew by each call, so that it must not be one that changes nothing.
void SetStyle(const QString& style, QWidget* widget) {
  if (widget->styleSheet() != style) widget->setStyleSheet(style);
}

}  // namespace

NextBox::NextBox(std::function<void()> on_click) : on_click_(std::move(on_click)) {
  setObjectName("next");
  setMinimumHeight(kHeight_px);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 8, 10, 8);
  column->setSpacing(2);
  action_ = MakeLabel("next_action", column);
  reason_ = MakeLabel("next_reason", column);
}

void NextBox::Show(const NextStep& step) {
  const QString action = QString::fromStdString(step.action);
  action_->setText(action);
  reason_->setText(QString::fromStdString(step.reason));
  reason_->setVisible(!step.reason.empty());
  SetStyle(
      QStringLiteral("font-size: %1px; font-weight: bold;").arg(action.size() > kLong ? 20 : 27),
      action_);
  SetStyle(QStringLiteral("QWidget { background: %1; color: white; }")
               .arg(step.kind == NextStep::Kind::kGap ? "#990080" : "black"),
           this);
}

void NextBox::mouseReleaseEvent(QMouseEvent* event) {
  if (rect().contains(event->pos())) on_click_();
}

}  // namespace plumb::rviz_panel
