// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace plumb {

// Grey picture (0 black, 255 white) of a marker with its quiet zone, row by row, every pixel the
// mean of its area; the marker's diameter is side_px / kSidePerDiameter. Throws
// std::invalid_argument if there is no such ID or side_px is not in 8 .. 8192.
std::vector<std::uint8_t> MarkerPicture(int id, int side_px);

}  // namespace plumb
