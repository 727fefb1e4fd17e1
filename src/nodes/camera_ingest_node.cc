// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes up the camera's photos, keeps them in the session and publishes them.
#include "ros/camera_ingest.h"
#include "ros/run_node.h"

int main(int argc, char** argv) {
  using namespace plumb::ros_adapter;
  return RunNode<CameraIngest, CameraIngestOptions>(argc, argv, "camera_ingest");
}
