// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <proj.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

namespace plumb {

struct ProjDeleter {
  void operator()(PJ* object) const { proj_destroy(object); }
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, ProjDeleter>;
using ProjObject = std::unique_ptr<PJ, ProjDeleter>;

// For which a CRS was made [deg]; west may be greater than east, across the date line.
struct CrsArea {
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;
  std::string name;

  bool Contains(const Eigen::Vector2d& lon_lat_deg) const;
};

// A CRS of PROJ's data base, with what leads from its coordinates to longitude and latitude on its
// own ellipsoid and on WGS 84. Not thread-safe.
class CoordinateSystem {
 public:
  // EPSG codes, with or without "EPSG:", two joined by '+'; PROJ strings; "WGS84 UTM 33N" as
  // OpenDroneMap writes it. Throws std::invalid_argument naming an unknown or unusable CRS and
  // the cure, without the file's name.
  explicit CoordinateSystem(const std::string& name);

  bool is_geographic() const { return is_geographic_; }
  // Whether it says by itself what its heights are, and if so, whether from the sea level.
  bool states_heights() const { return states_heights_; }
  bool is_orthometric() const { return is_orthometric_; }
  const std::optional<CrsArea>& area() const { return area_; }
  PJ_CONTEXT* context() const { return context_.get(); }

  // Parameters of a PROJ step on its ellipsoid: " +a=… +rf=…" (" +b=…" of a sphere).
  std::string EllipsoidParameters() const;

  // East (longitude [deg]), north (latitude [deg]) to longitude, latitude [deg] on its own
  // ellipsoid, and back. Nothing where it is not defined.
  std::optional<Eigen::Vector2d> ToLonLat(const Eigen::Vector2d& east_north) const;
  std::optional<Eigen::Vector2d> FromLonLat(const Eigen::Vector2d& lon_lat_deg) const;

  // Between longitude, latitude [deg] on its own datum and on WGS 84.
  std::optional<Eigen::Vector2d> ToWgs84(const Eigen::Vector2d& lon_lat_deg) const;
  std::optional<Eigen::Vector2d> FromWgs84(const Eigen::Vector2d& lon_lat_deg) const;

 private:
  void ReadHeights(const PJ* whole, const std::string& name);
  void ReadUnits(const PJ* horizontal, const std::string& name);
  ProjObject Operation(const PJ* source, const PJ* target, const std::string& name) const;

  ProjContext context_;  // Outlives what was made with it.
  ProjObject lon_lat_from_crs_;
  ProjObject wgs84_from_lon_lat_;
  ProjObject ellipsoid_;
  bool is_geographic_ = false;
  bool states_heights_ = false;
  bool is_orthometric_ = false;
  std::optional<CrsArea> area_;
};

}  // namespace plumb
