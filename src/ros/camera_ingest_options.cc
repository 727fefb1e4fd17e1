// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/camera_ingest_options.h"

#include <filesystem>

#include "plumbline/common/options.h"
#include "ros/absolute_path.h"

namespace plumb::ros_adapter {
namespace {

// Whether `path` is `folder` or in it, by their names.
bool IsWithin(const std::string& path, const std::string& folder) {
  const std::filesystem::path inner = (std::filesystem::path(path) / "").lexically_normal();
  const std::filesystem::path outer = (std::filesystem::path(folder) / "").lexically_normal();
  return inner.string().rfind(outer.string(), 0) == 0;
}

}  // namespace

std::vector<std::string> CameraIngestOptions::Problems() const {
  ProblemList problems;
  const bool has_topic = !image_topic.empty() || !compressed_image_topic.empty();
  problems.Require(!session_folder.empty(), "session_folder", "given", session_folder);
  RequireAbsolute("session_folder", session_folder, &problems);
  RequireAbsolute("photos_folder", photos_folder, &problems);
  RequireAbsolute("camera_file", camera_file, &problems);
  problems.Require(photos_folder.empty() || !IsWithin(photos_folder, session_folder),
                   "photos_folder",
                   "outside the session folder, which keeps the photos taken up",
                   photos_folder);
  problems.Require(!photos_folder.empty() || has_topic,
                   "photos_folder",
                   "given unless image_topic or compressed_image_topic is",
                   photos_folder);
  problems.Require(!camera_file.empty() || (photos_folder.empty() && !camera_info_topic.empty()),
                   "camera_file",
                   "given unless photos come by an image topic with camera_info_topic alone",
                   camera_file);
  problems.Require(
      max_subfolder_depth >= 0, "max_subfolder_depth", "0 or more", max_subfolder_depth);
  problems.Require(!camera_frame_id.empty(), "camera_frame_id", "given", camera_frame_id);
  problems.Require(recorder_wait_s >= 0.0, "recorder_wait_s", "0 or more", recorder_wait_s);
  problems.Require(min_listeners >= 1, "min_listeners", "at least 1", min_listeners);
  problems.Require(max_in_flight >= 1, "max_in_flight", "at least 1", max_in_flight);
  problems.Require(resend_after_s > 0.0, "resend_after_s", "positive", resend_after_s);
  problems.Require(untouched_for_s > 0.0, "untouched_for_s", "positive", untouched_for_s);
  return problems.Take();
}

}  // namespace plumb::ros_adapter
