// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_window/calibrator_window.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStringList>
#include <QVBoxLayout>
#include <utility>

#include "ros/calibrator_window/bars_view.h"
#include "ros/calibrator_window/coverage_view.h"
#include "ros/calibrator_window/estimate_view.h"
#include "ros/calibrator_window/photo_view.h"
#include "ros/calibrator_window/window_style.h"

namespace plumb::ros_adapter {
namespace {

constexpr int kRefresh_ms = 100;
constexpr const char* kCommitted = "Committed ✓";  // The longest word on a button.
constexpr int kMaxFindings = 2;                    // More would leave no room for the photo.

void Paint(QWidget* widget, const QColor& ground, const QColor& ink, const QString& more = {}) {
  const QString style =
      QString("background: %1; color: %2; %3").arg(ground.name(), ink.name(), more);
  if (widget->styleSheet() != style) widget->setStyleSheet(style);
}

QLabel* MakeLabel(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setTextFormat(Qt::PlainText);
  return label;
}

QColor ColorOf(Outcome::Kind kind) {
  switch (kind) {
    case Outcome::Kind::kDone:
      return kGoodColor;
    case Outcome::Kind::kDoubtful:
      return kInk;
    case Outcome::Kind::kFailed:
      return kBadColor;
  }
  return kInk;
}

bool IsSaidByAdvice(const CalibrationFinding& finding, const std::string& advice) {
  return finding.kind == CalibrationFinding::Kind::kTooFewPhotos || finding.text == advice;
}

// What to press once the photos are good enough. To commit is up to the pilot.
std::string NextStep(const CalibratorState& state) {
  if (!IsEnough(state)) return {};
  if (!state.is_result_current) return " Press Calibrate.";
  if (!state.is_saved) return " Press Save.";
  if (state.is_committed) return " Done: saved, and the camera has it.";
  if (!CanCommit(state)) return " Done: saved.";
  return " Done: saved. Commit gives it to the camera's driver too.";
}

// A button that does nothing now is flat and grey; the next step is filled.
void PaintButton(QPushButton* button, bool is_next) {
  const QColor ground = !button->isEnabled() ? kGround : (is_next ? kActionColor : kPaper);
  const QColor ink = !button->isEnabled() ? kLine : (is_next ? kPaper : kInk);
  const QColor rim = button->isEnabled() ? kInk : kLine;
  Paint(button, ground, ink, QString("border: 3px solid %1; border-radius: 10px;").arg(rim.name()));
}

}  // namespace

CalibratorWindow::CalibratorWindow(ReadState read_state,
                                   CalibratorActions actions,
                                   const CalibrationOptions& options)
    : read_state_(std::move(read_state)), actions_(std::move(actions)) {
  setWindowTitle("Plumbline: camera calibration");
  setAutoFillBackground(true);
  setPalette(QPalette(kInk, kGround, kPaper, kInk, kLine, kInk, kInk, kPaper, kGround));
  advice_ = MakeLabel("advice");
  findings_ = MakeLabel("findings");
  sources_ = MakeLabel("sources");
  outcome_ = MakeLabel("outcome");
  photo_ = new PhotoView;
  coverage_ = new CoverageView;
  bars_ = new BarsView;
  estimate_ = new EstimateView(options);

  auto* left = new QVBoxLayout;
  left->addWidget(photo_, 1);
  left->addWidget(sources_);
  auto* right = new QVBoxLayout;
  right->setSpacing(10);
  right->addWidget(coverage_, 6);
  right->addWidget(bars_, 5);
  right->addWidget(estimate_, 4);
  auto* middle = new QHBoxLayout;
  middle->setSpacing(14);
  middle->addLayout(left, 11);
  middle->addLayout(right, 9);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(10, 10, 10, 10);
  all->addWidget(advice_);
  all->addWidget(findings_);
  all->addLayout(middle, 1);
  all->addWidget(MakeFoot());
  resize(1280, 800);
  QObject::connect(&timer_, &QTimer::timeout, this, [this] { Refresh(); });
  timer_.start(kRefresh_ms);
  Refresh();
}

QWidget* CalibratorWindow::MakeFoot() {
  auto* foot = new QWidget;
  auto* row = new QHBoxLayout(foot);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(14);
  calibrate_ = AddButton("calibrate", "Calibrate", actions_.calibrate);
  save_ = AddButton("save", "Save", actions_.save);
  commit_ = AddButton("commit", "Commit", actions_.commit);
  for (QPushButton* button : {calibrate_, save_, commit_}) row->addWidget(button);
  row->addWidget(outcome_, 1);
  return foot;
}

// Pressed twice is done once: it stays off until the next state is shown.
QPushButton* CalibratorWindow::AddButton(const char* name,
                                         const QString& text,
                                         std::function<void()> action) {
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setFocusPolicy(Qt::StrongFocus);
  QObject::connect(button, &QPushButton::clicked, this, [button, action = std::move(action)] {
    button->setEnabled(false);
    action();
  });
  return button;
}

void CalibratorWindow::Refresh() {
  const CalibratorState state = read_state_();
  ShowAdvice(state);
  QString idle = "Waiting for the first image.";
  for (const SourceNote& source : state.sources) {
    idle += "\n\n" + QString::fromStdString(source.text);
  }
  photo_->Show(state.view, idle);
  const ShownEstimate shown = EstimateToShow(state);
  coverage_->Show(*shown.coverage);
  bars_->Show(*shown.coverage, IsEnough(state));
  estimate_->Show(shown);
  ShowSources(state);
  ShowButtons(state);
  ShowOutcome(state);
}

void CalibratorWindow::ShowAdvice(const CalibratorState& state) {
  const ShownEstimate shown = EstimateToShow(state);
  const bool is_good = shown.verdict == CalibrationVerdict::kGood;
  advice_->setText(QString::fromStdString(*shown.advice + NextStep(state)));
  Paint(advice_, is_good ? kGoodColor : kInk, kPaper, "padding: 8px;");
  QStringList lines;
  bool is_serious = false;
  for (const CalibrationFinding& finding : *shown.findings) {
    if (lines.size() == kMaxFindings) break;
    if (IsSaidByAdvice(finding, *shown.advice)) continue;
    lines << QString::fromStdString(finding.text);
    is_serious |= finding.is_serious;
  }
  findings_->setText(lines.join("\n"));
  findings_->setVisible(!lines.isEmpty());
  Paint(findings_,
        is_serious ? kBadColor : QColor(255, 224, 130),
        is_serious ? kPaper : kInk,
        "padding: 6px;");
}

void CalibratorWindow::ShowSources(const CalibratorState& state) {
  QStringList lines;
  bool is_trouble = false;
  for (const SourceNote& source : state.sources) {
    lines << QString::fromStdString(source.text);
    is_trouble |= source.is_trouble;
  }
  QStringList counts;
  counts << QString("%1 taken").arg(state.progress.coverage.num_photos);
  if (state.num_waiting > 0) counts << QString("%1 waiting").arg(state.num_waiting);
  if (state.num_dropped > 0) counts << QString("%1 passed over").arg(state.num_dropped);
  if (state.num_unreadable > 0) counts << QString("%1 unreadable").arg(state.num_unreadable);
  lines << counts.join(", ");
  sources_->setText(lines.join(is_trouble ? "\n" : "; "));
  Paint(sources_, kGround, is_trouble ? kBadColor : kInk);
}

void CalibratorWindow::ShowOutcome(const CalibratorState& state) {
  const bool is_busy = !state.busy.empty();
  outcome_->setText(QString::fromStdString(is_busy ? state.busy : state.outcome.text));
  Paint(outcome_, kGround, is_busy ? kActionColor : ColorOf(state.outcome.kind));
}

void CalibratorWindow::ShowButtons(const CalibratorState& state) {
  const bool is_good = IsEnough(state);
  calibrate_->setEnabled(CanCalibrate(state));
  save_->setEnabled(CanSave(state));
  commit_->setEnabled(CanCommit(state));
  save_->setText(state.result && state.is_saved ? QString::fromUtf8("Saved ✓") : "Save");
  commit_->setText(state.result && state.is_committed ? QString::fromUtf8(kCommitted) : "Commit");
  PaintButton(calibrate_, is_good && !state.is_result_current);
  PaintButton(save_, is_good && state.is_result_current && !state.is_saved);
  PaintButton(commit_, is_good && state.is_result_current && state.is_saved);
}

void CalibratorWindow::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  ScaleLetters();
}

void CalibratorWindow::ScaleLetters() {
  advice_->setFont(FontOf(*this, 1.35, /*is_bold=*/true));
  findings_->setFont(FontOf(*this, 0.95));
  sources_->setFont(FontOf(*this, 0.85));
  outcome_->setFont(FontOf(*this, 1.0, /*is_bold=*/true));
  for (QPushButton* button : {calibrate_, save_, commit_}) {
    button->setFont(FontOf(*this, 1.3, /*is_bold=*/true));
    const int word_px = button->fontMetrics().horizontalAdvance(QString::fromUtf8(kCommitted)) +
                        2 * LetterHeight_px(*this);
    button->setMinimumSize(word_px, 7 * LetterHeight_px(*this) / 2);
  }
}

}  // namespace plumb::ros_adapter
