// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/gps_alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

constexpr std::size_t kMaxPhotos = 50;

}  // namespace

GeoFrame FrameAround(const GpsPhoto& photo) {
  const auto rounded = [](double value, double step) { return step * std::round(value / step); };
  const Eigen::Vector3d origin(rounded(photo.position.lon_deg, 1e-4),
                               rounded(photo.position.lat_deg, 1e-4),
                               std::round(*photo.position.alt_m));
  return {"EPSG:4979", HeightReference::kEllipsoidal, origin};
}

RobustSimilarity AlignToGps(const GeoreferencerOptions& options,
                            const GeoFrame& frame,
                            const std::vector<GpsPhoto>& photos) {
  const double horizontal = std::pow(options.gps_sigma_horizontal_m, 2);
  const double vertical = std::pow(options.gps_sigma_vertical_m, 2);
  const std::size_t step = 1 + photos.size() / kMaxPhotos;
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < photos.size(); i += step) {
    const auto in_enu = frame.FromWgs84(photos[i].position);
    if (!in_enu) continue;
    PointPair pair;
    pair.in_source = photos[i].center_in_map;
    pair.in_target = *in_enu;
    pair.target_covariance = Eigen::Vector3d(horizontal, horizontal, vertical).asDiagonal();
    pairs.push_back(pair);
  }
  RobustSimilarityOptions robust;
  robust.max_bend_ratio = 0.0;  // What bends a map is far below GPS's error.
  robust.max_normalized_error = std::numeric_limits<double>::infinity();
  return EstimateRobustSimilarity(robust, pairs);
}

std::optional<Eigen::Vector3d> OffsetFromGps(const Similarity3& enu_from_map,
                                             const GeoFrame& frame,
                                             const std::vector<GpsPhoto>& photos) {
  std::vector<Eigen::Vector3d> offsets;
  for (const GpsPhoto& photo : photos) {
    const auto in_enu = frame.FromWgs84(photo.position);
    if (in_enu) offsets.push_back(enu_from_map * photo.center_in_map - *in_enu);
  }
  if (offsets.empty()) return std::nullopt;
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
    std::nth_element(offsets.begin(), middle, offsets.end(), [axis](const auto& a, const auto& b) {
      return a[axis] < b[axis];
    });
    median[axis] = (*middle)[axis];
  }
  return median;
}

}  // namespace plumb
