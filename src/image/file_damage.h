// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

constexpr char kCutOff[] =
    "the file ends in the middle of the picture; copy it from the camera again, or take it again";

// What is wrong with the file around the pixels, in words for the pilot: the checksums of a PNG,
// the extents of a PNG, BMP or TIFF. Empty if nothing is, and for other kinds. The decoders of
// these kinds would tell it to standard error alone.
std::string FindFileDamage(const std::vector<std::uint8_t>& bytes);

}  // namespace plumb
