// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the surface of the map and colours it by quality.
#include "ros/mesher_ros.h"
#include "ros/run_node.h"

int main(int argc, char** argv) {
  using namespace plumb::ros_adapter;
  return RunNode<MesherRos, MesherRosOptions>(argc, argv, "mesher");
}
