// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the coded markers of each photo.
#include "ros/marker_detector_ros.h"
#include "ros/run_node.h"

int main(int argc, char** argv) {
  using namespace plumb::ros_adapter;
  return RunNode<MarkerDetectorRos, MarkerDetectorRosOptions>(argc, argv, "marker_detector");
}
