// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Gaps.h>

#include <optional>
#include <string>

#include "rviz/flight_status.h"

namespace plumb::rviz_panel {

// What the pilot does next, and why.
struct NextStep {
  enum class Kind { kPhoto, kGap, kNothing };

  Kind kind = Kind::kNothing;
  std::string action;
  std::string reason;  // May be empty.
};

// As the map calls it, too: "G1" is the worst.
std::string GapName(std::size_t index);

// The way to a gap as a row of the list has it.
std::string WayText(const plumbline::Gap& gap);

// While the last photo is not accepted, what its hint says; else the way to the worst gap. Nothing
// for `gaps` if none were heard of. `now_s` is of the clock of `status`.
NextStep NextStepOf(const FlightStatus& status,
                    const std::optional<plumbline::Gaps>& gaps,
                    double now_s);

}  // namespace plumb::rviz_panel
