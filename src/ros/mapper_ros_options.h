// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/sfm/mapper_options.h"

namespace plumb::ros_adapter {

struct MapperRosOptions {
  // Where the flight is kept: session.db and photos/ are written here.
  std::string session_folder;

  // Frame of the map; scale free until georeferenced.
  std::string map_frame_id = "map";

  // Frame of the camera on tf: where the last photo that was located was taken from.
  std::string camera_frame_id = "camera_optical";

  // Frame on tf, with the map's axes, that moves as the map grows: a viewer that looks at it from
  // the direction and distance below has the whole map in view. rviz/flight.rviz does.
  std::string overview_frame_id = "map_overview";
  double overview_yaw_deg = 255.0;   // From the side of the first camera, a little to the left.
  double overview_pitch_deg = 20.0;  // A little from above.
  double overview_distance = 20.0;   // [map units: a tenth of the first median depth].
  // To each side, up and down: RViz sees 45 degrees from top to bottom, and not less across.
  double overview_half_angle_deg = 18.0;

  // Photos that wait for their features. What comes when it is full is dropped and sent again by
  // camera_ingest; a photo of 16 megapixels takes some 6 MB here.
  int max_queue = 16;

  // The map is drawn at most this often [s]: drawing takes time from mapping.
  double display_period_s = 0.5;

  // Width of the annotated photo [px].
  int annotated_width_px = 1280;

  // Points seen in fewer photos are not drawn; two are few enough for a chance match.
  int min_drawn_views = 3;

  // Steps of the mapper. A flight must not wait for its background: not deterministic.
  MapperOptions mapper = [] {
    MapperOptions options;
    options.deterministic = false;
    return options;
  }();

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(MapperRosOptions& options, Visitor&& visit) {
  visit("session_folder", options.session_folder);
  visit("map_frame_id", options.map_frame_id);
  visit("camera_frame_id", options.camera_frame_id);
  visit("overview_frame_id", options.overview_frame_id);
  visit("overview_yaw_deg", options.overview_yaw_deg);
  visit("overview_pitch_deg", options.overview_pitch_deg);
  visit("overview_distance", options.overview_distance);
  visit("overview_half_angle_deg", options.overview_half_angle_deg);
  visit("max_queue", options.max_queue);
  visit("display_period_s", options.display_period_s);
  visit("annotated_width_px", options.annotated_width_px);
  visit("min_drawn_views", options.min_drawn_views);
  visit("mapper", options.mapper);
}

}  // namespace plumb::ros_adapter
