// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "plumbline/georeference/georeference.h"

namespace plumb {

// Of the form
//   { "source", "coarse", "map_sequence",
//     "enu_from_map": { "scale", "rotation_wxyz", "translation_m" }, "earth_from_map": the same,
//     "frame": { "crs", "heights", "origin_in_crs", "origin_wgs84": { "lat_deg", … } },
//     "control", "check": { "count", "mean_mm", "median_mm", "max_mm", "rms_mm" }, "bend_sigma_mm",
//     "targets": [ { "id", "name", "role", "state", "photos", "photos_used", "rms_error_px",
//                    "point_in_map", "residual_mm", "error_mm", "sigma_mm" } ],
//     "marker_diameter_m", "gps": { "photos", "scale_ratio", … }, "findings": [ … ] }
// where what is not known is null. Numbers read back to the last bit.
nlohmann::ordered_json ToJson(const Georeference& georeference);

// What an export needs.
struct StoredGeoreference {
  bool is_coarse = false;
  std::uint32_t map_sequence = 0;
  bool is_of_refined_map = false;  // "refined", which the session's tools add.
  Similarity3 enu_from_map;
  GeoFrame frame;
};

// Throws std::runtime_error naming the file, the fault and the cure.
StoredGeoreference ReadGeoreference(const std::string& path);

}  // namespace plumb
