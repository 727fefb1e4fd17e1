// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/quality/gaps.h"
#include "plumbline/quality/quality_options.h"
#include "plumbline/surface/surface_options.h"

namespace plumb::ros_adapter {

struct MesherRosOptions {
  // Frame of the mesh and the map.
  std::string map_frame_id = "map";

  // Colours: paper (blue poor, red good) or colour_blind (dark blue poor, yellow good).
  std::string palette = "paper";

  // Length of the map's unit, where it is known beforehand; 0: not known until the topic
  // metres_per_map_unit tells it.
  double metres_per_map_unit = 0.0;

  // Gaps, legends and refused photos are told at most this often [s]; the mesh at once.
  double display_period_s = 0.5;

  // Deltas of the map that wait for the mesher; one that comes when it is full is caught up with
  // by get_map.
  int max_queue = 64;

  SurfaceOptions surface;
  QualityOptions quality;
  GapOptions gaps;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The first two cameras are a unit apart: less than a millimetre or more than a kilometre is no
// flight before a facade. 0: not known.
bool IsScaleOrUnknown(double metres_per_map_unit);

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(MesherRosOptions& options, Visitor&& visit) {
  visit("map_frame_id", options.map_frame_id);
  visit("palette", options.palette);
  visit("metres_per_map_unit", options.metres_per_map_unit);
  visit("display_period_s", options.display_period_s);
  visit("max_queue", options.max_queue);
  visit("surface", options.surface);
  visit("quality", options.quality);
  visit("gaps", options.gaps);
}

}  // namespace plumb::ros_adapter
