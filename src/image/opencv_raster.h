// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/photo_raster.h"

namespace plumb {

// Decodes any format OpenCV reads, of 8 or 16 bits, grey or colour; an alpha channel is ignored.
// 16 bits are scaled to 8 by their full range, floats from [0, 1].
DecodedPhoto DecodeWithOpenCv(const std::vector<std::uint8_t>& bytes);

}  // namespace plumb
