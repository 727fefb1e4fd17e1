// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "image/float_image.h"
#include "plumbline/image/features.h"

namespace plumb {

// The decoded contents of a photo, from which grey images of any scale can be had.
// Thread-safe: immutable.
class PhotoRaster {
 public:
  virtual ~PhotoRaster() = default;

  // The photo at `eighths`/8 of its size (1 to 16), rounded up; its pixel (x, y) has
  // its centre at full-resolution pixel ((x + 0.5) 8 / eighths - 0.5, likewise y). Padding filled.
  virtual FloatImage Gray(int eighths, int num_threads) const = 0;

  // Colour around a full-resolution pixel, averaged over about 8 x 8 pixels.
  virtual Rgb ColorAt(float x_px, float y_px) const = 0;
};

struct PhotoSize {
  int width_px = 0;
  int height_px = 0;
};

// What came out of a file: a raster, or why there is none, in words for the pilot.
struct DecodedPhoto {
  std::unique_ptr<PhotoRaster> raster;
  std::string problem;
};

}  // namespace plumb
