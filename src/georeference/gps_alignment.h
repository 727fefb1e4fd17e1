// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/georeference/geo_frame.h"
#include "plumbline/georeference/georeferencer_options.h"
#include "plumbline/georeference/robust_similarity.h"

namespace plumb {

// A located photo and where GPS says it was taken.
struct GpsPhoto {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();
  GeodeticPosition position;  // With a height.
};

// A frame about the first photo, to 0.0001 deg and whole metres.
GeoFrame FrameAround(const GpsPhoto& photo);

// enu_from_map that fits the photos' positions best, or why there is none; photos that are off by
// far more than GPS is are left out. At most 50 photos, evenly spread, are used: the error that
// all share does not fall with their number.
RobustSimilarity AlignToGps(const GeoreferencerOptions& options,
                            const GeoFrame& frame,
                            const std::vector<GpsPhoto>& photos);

// Median over the photos, axis by axis, of the position by `enu_from_map` less that by GPS. Nothing
// if no photo has a place in the frame.
std::optional<Eigen::Vector3d> OffsetFromGps(const Similarity3& enu_from_map,
                                             const GeoFrame& frame,
                                             const std::vector<GpsPhoto>& photos);

}  // namespace plumb
