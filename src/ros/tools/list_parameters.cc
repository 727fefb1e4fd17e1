// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the parameters of each node, and of the refinement, with their defaults as JSON, for
// scripts/parameters_doc.py.
#include <iostream>

#include "plumbline/map/run_report.h"
#include "plumbline/sfm/refinement_options.h"
#include "ros/calibrator_ros_options.h"
#include "ros/camera_ingest_options.h"
#include "ros/georeferencer_ros_options.h"
#include "ros/mapper_ros_options.h"
#include "ros/marker_detector_ros_options.h"
#include "ros/mesher_ros_options.h"

int main() {
  nlohmann::ordered_json nodes;
  nodes["calibrator"] = plumb::OptionsToJson(plumb::ros_adapter::CalibratorRosOptions());
  nodes["camera_ingest"] = plumb::OptionsToJson(plumb::ros_adapter::CameraIngestOptions());
  nodes["georeferencer"] = plumb::OptionsToJson(plumb::ros_adapter::GeoreferencerRosOptions());
  nodes["mapper"] = plumb::OptionsToJson(plumb::ros_adapter::MapperRosOptions());
  nodes["marker_detector"] = plumb::OptionsToJson(plumb::ros_adapter::MarkerDetectorRosOptions());
  nodes["mesher"] = plumb::OptionsToJson(plumb::ros_adapter::MesherRosOptions());
  nodes["refinement"] = plumb::OptionsToJson(plumb::RefinementOptions());
  std::cout << nodes.dump(1) << '\n';
  return 0;
}
