// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plumb::ros_adapter {

// The whole of the calibrator's main: with `~window` the node and its window in one process, which
// ends when the window is closed; else the node alone. What stops it is said as FATAL. Gives
// EX_CONFIG (78) for what another start would not cure.
int RunCalibrator(int argc, char** argv);

}  // namespace plumb::ros_adapter
