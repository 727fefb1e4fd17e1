// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plumb {

// The kinds of photo that are read, for messages.
constexpr char kPhotoKinds[] = "JPEG, PNG, TIFF and BMP";

// Whether a file of this name is to be taken as a photo: jpg, jpeg, png, tif, tiff or bmp in any
// case, not hidden, not a temporary file. What its bytes are, AnalyzePhoto says.
bool IsPhotoName(const std::string& name);

}  // namespace plumb
