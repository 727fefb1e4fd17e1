// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/calibration/calibration_options.h"
#include "plumbline/marker/marker_detector_options.h"
#include "ros/view_choice_options.h"

namespace plumb::ros_adapter {

struct CalibratorRosOptions {
  // Where the camera leaves its photos; each is taken. Empty: no folder is watched.
  std::string photos_folder;

  // Levels of sub-folders searched for photos, as camera_ingest's.
  int max_subfolder_depth = 3;

  // A file that never gets its end marker is taken up, cut as it is, once it was not touched for
  // this long [s].
  double untouched_for_s = 5.0;

  // Topic of sensor_msgs/Image or CompressedImage, live or from a bag; which of the two, it
  // tells itself. Its sharp images of new views are taken. Empty: none.
  std::string image_topic = "~image";

  // camera.yaml and the report are written here. A calibration that lies here already is kept under
  // another name.
  std::string output_folder;

  // Goes into camera.yaml.
  std::string camera_name = "camera";

  // Service of sensor_msgs/SetCameraInfo that Commit calls. Empty: set_camera_info beside the
  // image topic, as drivers have it.
  std::string set_camera_info_service;

  // Show the window. Without it, the topic progress and the services say and do the same.
  bool window = true;

  // Images that wait to be looked at. Photos of a folder wait until there is room; what a
  // topic brings when it is full is dropped: a later one shows the same.
  int max_queue = 2;

  // Width of the picture that is shown [px].
  int picture_width_px = 1280;

  ViewChoiceOptions views;
  MarkerDetectorOptions detector;
  CalibrationOptions calibration;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(CalibratorRosOptions& options, Visitor&& visit) {
  visit("photos_folder", options.photos_folder);
  visit("max_subfolder_depth", options.max_subfolder_depth);
  visit("untouched_for_s", options.untouched_for_s);
  visit("image_topic", options.image_topic);
  visit("output_folder", options.output_folder);
  visit("camera_name", options.camera_name);
  visit("set_camera_info_service", options.set_camera_info_service);
  visit("window", options.window);
  visit("max_queue", options.max_queue);
  visit("picture_width_px", options.picture_width_px);
  visit("views", options.views);
  visit("detector", options.detector);
  visit("calibration", options.calibration);
}

}  // namespace plumb::ros_adapter
