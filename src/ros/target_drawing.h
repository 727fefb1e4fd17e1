// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Georeference.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

namespace plumb::ros_adapter {

struct TargetDrawingOptions {
  std::string map_frame_id = "map";
  double marker_diameter_m = 0.5;  // The targets are drawn as large.
  double magnification = 200.0;    // Of the arrows, but for those of wrong targets.
};

// Each target where the survey has it (or, unsurveyed or not placed yet, where the photos see it),
// an arrow towards where the model puts it, and the millimetres in words. A control point is a
// ball, a check point a cube, a wrong target is crossed out; the colours are told apart by any eye
// (Okabe & Ito, Color Universal Design, 2002). Stamped 0: the same georeference gives the same
// drawing.
visualization_msgs::MarkerArray DrawTargets(const TargetDrawingOptions& options,
                                            const plumbline::Georeference& georeference);

}  // namespace plumb::ros_adapter
