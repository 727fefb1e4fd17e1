// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "plumbline/geometry/rigid3.h"
#include "plumbline/georeference/survey.h"
#include "plumbline/image/photo_analysis.h"

namespace plumb {

// The metric frame `enu` of a project: east, north and up [m] in the plane that touches the CRS's
// own ellipsoid at an origin, which is on record. It is Euclidean, as the map is: a projected CRS
// is not, for it stretches lengths (UTM by up to 0.4 mm a metre) and leaves heights as they are. Of
// a local CRS it is the CRS itself, less the origin.
//
// Orthometric heights are taken for ellipsoidal ones in the shape, which errs by their difference
// over the earth's radius: 50 m are 0.4 mm in 50 m. Where only the place on earth is asked for
// (WGS 84, ecef) they are raised by EGM96, good to about a metre.
//
// All in double. Not thread-safe: PROJ's objects are not; copies share them.
class GeoFrame {
 public:
  // `crs` as in Survey; axes as in SurveyTarget. Throws std::runtime_error naming an unknown or
  // unusable CRS and the cure, or an origin that PROJ cannot place.
  GeoFrame(const std::string& crs, HeightReference heights, const Eigen::Vector3d& origin_in_crs);

  // About whole numbers near the mean of the survey's points; about zero if it is local and all
  // coordinates are below 10 km. Throws like the constructor.
  static GeoFrame Around(const Survey& survey);

  const std::string& crs() const { return crs_; }
  HeightReference heights() const { return heights_; }
  const Eigen::Vector3d& origin_in_crs() const { return origin_in_crs_; }
  bool is_local() const { return !projection_; }
  bool is_geographic() const { return is_geographic_; }  // Degrees, not metres.

  Eigen::Vector3d ToEnu(const Eigen::Vector3d& point_in_crs) const;
  Eigen::Vector3d ToCrs(const Eigen::Vector3d& point_in_enu) const;

  // Ellipsoidal height. Nothing if the frame is local or PROJ has no way there.
  std::optional<GeodeticPosition> ToWgs84(const Eigen::Vector3d& point_in_enu) const;
  std::optional<Eigen::Vector3d> FromWgs84(const GeodeticPosition& position) const;

  // To REP 105's `earth`: WGS 84, earth centred, earth fixed. Nothing if the frame is local.
  std::optional<Rigid3> EarthFromEnu() const;

 private:
  struct Projection;

  std::string crs_;
  HeightReference heights_;
  Eigen::Vector3d origin_in_crs_;
  bool is_geographic_ = false;
  std::shared_ptr<const Projection> projection_;  // Null if local.
};

}  // namespace plumb
