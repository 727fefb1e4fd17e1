// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_window/run_calibrator.h"

#include <ros/init.h>
#include <ros/spinner.h>

#include <QApplication>
#include <QTimer>
#include <clocale>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "ros/calibrator_ros.h"
#include "ros/calibrator_window/calibrator_window.h"
#include "ros/run_node.h"

namespace plumb::ros_adapter {
namespace {

constexpr int kLookForEnd_ms = 200;

// Qt ends the process where there is none.
void RequireDisplay() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') return;
  }
  throw IncurableError(
      "there is no display for the window: start it on a desktop, or with window:=false, where the "
      "topic progress and the services calibrate, save and commit take its place");
}

void RunWithWindow(int argc, char** argv, const CalibrationOptions& options, CalibratorRos* node) {
  RequireDisplay();
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");  // Qt takes the user's; files have points.
  ros::AsyncSpinner spinner(1);
  spinner.start();
  CalibratorWindow window([node] { return node->state(); },
                          {[node] { node->BeginCalibrate(); },
                           [node] { node->BeginSave(); },
                           [node] { node->BeginCommit(); }},
                          options);
  window.showMaximized();
  QTimer timer;  // Interrupted, or shut down by ROS.
  QObject::connect(&timer, &QTimer::timeout, &application, [&application] {
    if (!ros::ok()) application.quit();
  });
  timer.start(kLookForEnd_ms);
  QApplication::exec();
  spinner.stop();
  ros::requestShutdown();  // A driver that does not answer must not hold up the end.
}

}  // namespace

int RunCalibrator(int argc, char** argv) {
  UseUtf8InLogs();
  ros::init(argc, argv, "calibrator");
  ros::NodeHandle handle;  // Outside the try block: its end would stop logging before the catch.
  try {
    const auto options = ReadOptions<CalibratorRosOptions>(ros::NodeHandle("~"));
    CalibratorRos node(handle, options);
    if (options.window) {
      RunWithWindow(argc, argv, options.calibration, &node);
    } else {
      ros::spin();
    }
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return EX_CONFIG;
  }
  return EXIT_SUCCESS;
}

}  // namespace plumb::ros_adapter
