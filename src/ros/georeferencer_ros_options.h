// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/georeference/georeferencer_options.h"

namespace plumb::ros_adapter {

struct GeoreferencerRosOptions {
  // Survey of the targets, an absolute path; empty: none yet. The service load_survey sets this and
  // the next two.
  std::string survey_file;

  // Coordinate reference system instead of the survey's own word, e.g. EPSG:31256 or local.
  std::string survey_crs;

  // What its heights count from instead of its own word: ellipsoidal or orthometric.
  std::string survey_heights;

  // Frame of the map.
  std::string map_frame_id = "map";

  // Frame on tf, east, north, up about the georeference's origin [m].
  std::string enu_frame_id = "enu";

  // Frame on tf, WGS 84, earth centred (REP 105) [m].
  std::string earth_frame_id = "earth";

  // Hand the targets to the mapper, whose background bundles they then hold.
  bool sends_control_points = true;

  // The arrows at good targets are drawn so many times as long as the residuals are; those at wrong
  // ones as long as they are.
  double residual_magnification = 200.0;

  // The georeference itself.
  GeoreferencerOptions georeferencer;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(GeoreferencerRosOptions& options, Visitor&& visit) {
  visit("survey_file", options.survey_file);
  visit("survey_crs", options.survey_crs);
  visit("survey_heights", options.survey_heights);
  visit("map_frame_id", options.map_frame_id);
  visit("enu_frame_id", options.enu_frame_id);
  visit("earth_frame_id", options.earth_frame_id);
  visit("sends_control_points", options.sends_control_points);
  visit("residual_magnification", options.residual_magnification);
  visit("georeferencer", options.georeferencer);
}

}  // namespace plumb::ros_adapter
