// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Says where on earth the map is, by surveyed markers or by the photos' GPS.
#include "ros/georeferencer_ros.h"
#include "ros/run_node.h"

int main(int argc, char** argv) {
  using namespace plumb::ros_adapter;
  return RunNode<GeoreferencerRos, GeoreferencerRosOptions>(argc, argv, "georeferencer");
}
