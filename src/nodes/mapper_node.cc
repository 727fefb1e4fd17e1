// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the map from the photos and answers each with a verdict.
#include "ros/mapper_ros.h"
#include "ros/run_node.h"

int main(int argc, char** argv) {
  using namespace plumb::ros_adapter;
  return RunNode<MapperRos, MapperRosOptions>(argc, argv, "mapper");
}
