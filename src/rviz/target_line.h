// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Georeference.h>

#include <string>

namespace plumb::rviz_panel {

// How well the model fits the survey, in a line.
struct TargetLine {
  std::string text;
  bool is_warning = false;
};

// Wrong targets by their names; else control and check points apart. Empty while nothing places
// the model and nothing was surveyed.
TargetLine TargetLineOf(const plumbline::Georeference& georeference);

}  // namespace plumb::rviz_panel
