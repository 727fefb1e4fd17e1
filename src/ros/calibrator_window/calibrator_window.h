// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTimer>
#include <QWidget>
#include <functional>

#include "plumbline/calibration/calibration_options.h"
#include "ros/calibrator_state.h"

class QLabel;
class QPushButton;

namespace plumb::ros_adapter {

class BarsView;
class CoverageView;
class EstimateView;
class PhotoView;

// What the buttons do. None may wait.
struct CalibratorActions {
  std::function<void()> calibrate;
  std::function<void()> save;
  std::function<void()> commit;
};

// The calibrator's window: on top what to do next; left the last image with its markers; right
// coverage of the image, of distance and tilt, and the running estimate; below three large buttons
// and what became of the last one pressed. Asks for the state some times a second; never waits.
// Names of the parts, for tests: advice, findings, sources, outcome, calibrate, save, commit.
class CalibratorWindow : public QWidget {
 public:
  using ReadState = std::function<CalibratorState()>;

  CalibratorWindow(ReadState read_state,
                   CalibratorActions actions,
                   const CalibrationOptions& options);

  // Shows the state as it is now.
  void Refresh();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QPushButton* AddButton(const char* name, const QString& text, std::function<void()> action);
  QWidget* MakeFoot();
  void ShowAdvice(const CalibratorState& state);
  void ShowSources(const CalibratorState& state);
  void ShowOutcome(const CalibratorState& state);
  void ShowButtons(const CalibratorState& state);
  void ScaleLetters();

  const ReadState read_state_;
  const CalibratorActions actions_;
  QLabel* advice_ = nullptr;
  QLabel* findings_ = nullptr;
  PhotoView* photo_ = nullptr;
  CoverageView* coverage_ = nullptr;
  BarsView* bars_ = nullptr;
  EstimateView* estimate_ = nullptr;
  QLabel* sources_ = nullptr;
  QLabel* outcome_ = nullptr;
  QPushButton* calibrate_ = nullptr;
  QPushButton* save_ = nullptr;
  QPushButton* commit_ = nullptr;
  QTimer timer_;
};

}  // namespace plumb::ros_adapter
