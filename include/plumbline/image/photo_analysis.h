// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/common/timestamp.h"
#include "plumbline/image/feature_options.h"
#include "plumbline/image/features.h"

namespace plumb {

// Position by the photo's EXIF, WGS 84.
struct GeodeticPosition {
  double lat_deg = 0.0;
  double lon_deg = 0.0;
  std::optional<double> alt_m;  // As the camera wrote it; its datum is not stated in EXIF.
};

struct PhotoMetadata {
  int width_px = 0;  // Of the stored raster; a rotation flag in EXIF is not applied.
  int height_px = 0;
  int exif_orientation = 1;  // 1 upright, 2 to 8 as in EXIF 2.3.
  std::optional<double> focal_length_mm;
  std::optional<Timestamp> exposure_time;  // EXIF local time is taken as UTC.
  std::optional<GeodeticPosition> position;
};

enum class PhotoStatus { kOk, kUndecodable, kWrongSize, kTooBlurred, kTooFewFeatures };

// What is known of a photo before the map is asked.
struct PhotoAnalysis {
  PhotoStatus status = PhotoStatus::kUndecodable;
  std::string
      detail;  // If not kOk: what is wrong, in words for the pilot, without the file's name.
  std::uint64_t content_hash = 0;  // Of the bytes.
  PhotoMetadata metadata;
  double blur_px = 0.0;  // Estimated sigma of the photo's blur, in full-resolution pixels.
  FeatureSet features;   // Empty unless kOk.
  double decode_s = 0.0;
  double features_s = 0.0;
};

// Decodes a photo and finds its features. Never throws for what the bytes hold. A
// photo whose raster is not `width_px` x `height_px` is kWrongSize. Pure: the same bytes and
// options give the same result, on any number of threads. Thread-safe.
PhotoAnalysis AnalyzePhoto(const FeatureOptions& options,
                           const std::vector<std::uint8_t>& bytes,
                           int width_px,
                           int height_px);

}  // namespace plumb
