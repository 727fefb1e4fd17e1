// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "image/photo_raster.h"

namespace plumb {

bool IsJpeg(const std::vector<std::uint8_t>& bytes);

// From the header alone; nothing if it is damaged.
std::optional<PhotoSize> ReadJpegSize(const std::vector<std::uint8_t>& bytes);

// Undoes the entropy coding once, through libjpeg; the pixels of each scale are then made from the
// frequencies as asked for. A file that is cut off or damaged is a problem; stray bytes between
// segments, which some cameras write, are not. No raster and no problem: a JPEG that is not
// in grey or YCbCr.
DecodedPhoto DecodeJpeg(const std::vector<std::uint8_t>& bytes);

}  // namespace plumb
