// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb::ros_adapter {

struct CameraIngestOptions {
  // Where the camera leaves its photos; empty: no folder is watched.
  std::string photos_folder;

  // Levels of sub-folders searched for photos. Three find those of a card by its root:
  // DCIM/100MEDIA, DCIM/PANORAMA/100_0001. 0: the folder alone.
  int max_subfolder_depth = 3;

  // Where the flight is kept: photos/ and photos.jsonl are written here.
  std::string session_folder;

  // ROS camera_info YAML of the camera. May be empty if an image topic brings its camera_info.
  std::string camera_file;

  // Topic of sensor_msgs/Image; empty: none. Each is kept as PNG, which loses nothing.
  std::string image_topic;

  // Topic of sensor_msgs/CompressedImage (jpeg or png); empty: none.
  std::string compressed_image_topic;

  // Topic of sensor_msgs/CameraInfo; asked only where camera_file is empty.
  std::string camera_info_topic = "camera_info";

  // Frame of the photos: x right, y down, z forward.
  std::string camera_frame_id = "camera_optical";

  // Photos are sent while so many nodes listen: the mapper, and the marker detector if there is
  // one.
  int min_listeners = 1;

  // The first photo waits for a recorder that listens besides them, but no longer than this [s];
  // without one the flight goes on, and it is said. 0: there is none.
  double recorder_wait_s = 0.0;

  // Photos sent and not yet answered. More keep both of the mapper's stages busy; too many
  // fill its queue.
  int max_in_flight = 4;

  // A photo without a verdict is sent again after this long [s]; ten times the slowest verdict
  // expected.
  double resend_after_s = 10.0;

  // A file that never gets its end marker is taken up, cut as it is, once it was not touched for
  // this long [s]: longer than the hiccups of a camera's link.
  double untouched_for_s = 5.0;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(CameraIngestOptions& options, Visitor&& visit) {
  visit("photos_folder", options.photos_folder);
  visit("max_subfolder_depth", options.max_subfolder_depth);
  visit("session_folder", options.session_folder);
  visit("camera_file", options.camera_file);
  visit("image_topic", options.image_topic);
  visit("compressed_image_topic", options.compressed_image_topic);
  visit("camera_info_topic", options.camera_info_topic);
  visit("camera_frame_id", options.camera_frame_id);
  visit("min_listeners", options.min_listeners);
  visit("recorder_wait_s", options.recorder_wait_s);
  visit("max_in_flight", options.max_in_flight);
  visit("resend_after_s", options.resend_after_s);
  visit("untouched_for_s", options.untouched_for_s);
}

}  // namespace plumb::ros_adapter
