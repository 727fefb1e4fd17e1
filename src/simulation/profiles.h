// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulation/solids.h"

namespace plumb {

// Cross sections of mouldings; all start and end `kEmbedded_m` behind the surface they sit on.
constexpr double kEmbedded_m = 0.01;

// A band between two storeys: fillet, cyma, fillet, weathered top.
Profile StringCourseProfile(double height_m, double out_m);
// The main cornice: bed mould, corona with its drip, cymatium.
Profile MainCorniceProfile(double height_m, double out_m);
// A window's surround, from the opening outwards: two fasciae and an ogee.
Profile ArchitraveProfile(double width_m, double out_m);
// A window sill: drip, round nose, sloping top.
Profile SillProfile(double height_m, double out_m);
// The small cornice of a hood or pediment.
Profile HoodProfile(double height_m, double out_m);
// Plinth face with a chamfer on top.
Profile PlinthProfile(double height_m, double out_m);
// A bracket under a balcony or hood, seen from the side: a scroll.
Profile BracketProfile(double height_m, double out_m);
// The flat ring of a window's frame or sash: width inwards, front at `out` = 0.
Profile FrameProfile(double width_m, double depth_m);

}  // namespace plumb
