// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "plumbline/image/photo_analysis.h"

namespace plumb {

// What EXIF tells. Whatever is absent or makes no sense is left out, never guessed. The size is
// the raster's by the file's own structure, or 0 if the format is not known. Thread-safe.
PhotoMetadata ReadPhotoMetadata(const std::vector<std::uint8_t>& bytes);

}  // namespace plumb
