// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace plumb {

// A photo's grey values at full resolution, or why there are none.
struct GrayPhoto {
  cv::Mat gray;         // CV_8UC1; empty if there is a problem. A rotation in EXIF is not applied.
  std::string problem;  // In words for the pilot, without the file's name.
};

// Never throws for what the bytes hold. num_threads 0: one for each core. Thread-safe.
GrayPhoto DecodeGrayPhoto(const std::vector<std::uint8_t>& bytes, int num_threads = 0);

}  // namespace plumb
