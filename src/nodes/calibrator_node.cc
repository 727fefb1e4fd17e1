// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrates a camera while photos of coded markers are taken, and says what to photograph next.
#include "ros/calibrator_window/run_calibrator.h"

int main(int argc, char** argv) { return plumb::ros_adapter::RunCalibrator(argc, argv); }
