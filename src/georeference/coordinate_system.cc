// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/coordinate_system.h"

#include <cmath>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace plumb {
namespace {

// As PROJ wants it.
std::string NameForProj(const std::string& name) {
  static const std::regex code("([0-9]+)(\\+[0-9]+)?");
  static const std::regex utm("WGS ?84[ /]+UTM[ a-z]+([0-9]+) ?([NS])", std::regex::icase);
  std::smatch match;
  if (std::regex_match(name, match, code)) return "EPSG:" + name;
  if (std::regex_match(name, match, utm)) {
    const bool is_south = match[2] == "S" || match[2] == "s";
    const std::string zone = match[1];
    return (is_south ? "EPSG:327" : "EPSG:326") + (zone.size() == 1 ? "0" + zone : zone);
  }
  const bool is_bare_string = name.find("+proj=") == 0 && name.find("+type=") == std::string::npos;
  return is_bare_string ? name + " +type=crs" : name;
}

std::optional<Eigen::Vector2d> Transform(PJ* operation,
                                         PJ_DIRECTION direction,
                                         const Eigen::Vector2d& from) {
  proj_errno_reset(operation);
  const PJ_COORD to = proj_trans(operation, direction, proj_coord(from.x(), from.y(), 0.0, 0.0));
  if (!std::isfinite(to.xy.x) || !std::isfinite(to.xy.y)) return std::nullopt;
  return Eigen::Vector2d(to.xy.x, to.xy.y);
}

std::optional<CrsArea> AreaOf(PJ_CONTEXT* context, const PJ* crs) {
  constexpr double kUnknown = -1000.0;  // proj_get_area_of_use's word for it.
  CrsArea area;
  const char* name = nullptr;
  const bool is_known =
      proj_get_area_of_use(context, crs, &area.west, &area.south, &area.east, &area.north, &name);
  if (!is_known || area.west == kUnknown) return std::nullopt;
  if (name != nullptr) area.name = name;
  return area;
}

// Without the height's part and without a transformation to WGS 84 that is tied to it.
ProjObject HorizontalPart(PJ_CONTEXT* context, const PJ* crs) {
  ProjObject part(proj_get_type(crs) == PJ_TYPE_COMPOUND_CRS ? proj_crs_get_sub_crs(context, crs, 0)
                                                             : proj_clone(context, crs));
  if (part && proj_get_type(part.get()) == PJ_TYPE_BOUND_CRS) {
    part.reset(proj_get_source_crs(context, part.get()));
  }
  return part;
}

}  // namespace

bool CrsArea::Contains(const Eigen::Vector2d& lon_lat_deg) const {
  // Sites near the border of an area are surveyed in its CRS too.
  constexpr double kMarginDeg = 0.5;
  const double lon = lon_lat_deg.x();
  const double lat = lon_lat_deg.y();
  if (lat < south - kMarginDeg || lat > north + kMarginDeg) return false;
  const bool is_east = lon >= west - kMarginDeg;
  const bool is_west = lon <= east + kMarginDeg;
  return west <= east ? is_east && is_west : is_east || is_west;
}

CoordinateSystem::CoordinateSystem(const std::string& name) : context_(proj_context_create()) {
  proj_log_level(context_.get(), PJ_LOG_NONE);
  const ProjObject whole(proj_create(context_.get(), NameForProj(name).c_str()));
  if (!whole || !proj_is_crs(whole.get())) {
    throw std::invalid_argument(
        '"' + name +
        "\" is no coordinate reference system that PROJ knows; give its EPSG code, e.g. "
        "EPSG:31256, or \"local\"");
  }
  ReadHeights(whole.get(), name);
  const ProjObject horizontal = HorizontalPart(context_.get(), whole.get());
  ReadUnits(horizontal.get(), name);
  area_ = AreaOf(context_.get(), horizontal.get());
  const ProjObject geodetic(proj_crs_get_geodetic_crs(context_.get(), horizontal.get()));
  if (geodetic) ellipsoid_.reset(proj_get_ellipsoid(context_.get(), geodetic.get()));
  if (!geodetic || !ellipsoid_) {
    throw std::invalid_argument('"' + name + "\" has no ellipsoid; give another CRS, or \"local\"");
  }
  lon_lat_from_crs_ = Operation(horizontal.get(), geodetic.get(), name);
  const ProjObject wgs84(proj_create(context_.get(), "EPSG:4326"));
  wgs84_from_lon_lat_ = Operation(geodetic.get(), wgs84.get(), name);
}

void CoordinateSystem::ReadHeights(const PJ* whole, const std::string& name) {
  const PJ_TYPE type = proj_get_type(whole);
  if (type == PJ_TYPE_VERTICAL_CRS || type == PJ_TYPE_GEOCENTRIC_CRS) {
    throw std::invalid_argument(
        '"' + name +
        "\" does not count east, north and height; give a projected CRS, e.g. EPSG:31256");
  }
  is_orthometric_ = type == PJ_TYPE_COMPOUND_CRS;
  states_heights_ = is_orthometric_ || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

void CoordinateSystem::ReadUnits(const PJ* horizontal, const std::string& name) {
  const ProjObject axes(proj_crs_get_coordinate_system(context_.get(), horizontal));
  if (!axes) {
    throw std::invalid_argument('"' + name + "\" has no axes; give another CRS, or \"local\"");
  }
  is_geographic_ = proj_cs_get_type(context_.get(), axes.get()) == PJ_CS_TYPE_ELLIPSOIDAL;
  double factor = 0.0;
  const char* unit = nullptr;
  proj_cs_get_axis_info(
      context_.get(), axes.get(), 0, nullptr, nullptr, nullptr, &factor, &unit, nullptr, nullptr);
  const double wanted = is_geographic_ ? M_PI / 180.0 : 1.0;
  if (std::abs(factor / wanted - 1.0) < 1e-9) return;
  std::ostringstream text;
  text << '"' << name << "\" counts in " << (unit != nullptr ? unit : "another unit") << " of "
       << factor << (is_geographic_ ? " rad" : " m")
       << "; convert the points to a CRS that counts in metres";
  throw std::invalid_argument(text.str());
}

ProjObject CoordinateSystem::Operation(const PJ* source,
                                       const PJ* target,
                                       const std::string& name) const {
  const ProjObject operation(
      proj_create_crs_to_crs_from_pj(context_.get(), source, target, nullptr, nullptr));
  ProjObject normalized(
      operation ? proj_normalize_for_visualization(context_.get(), operation.get()) : nullptr);
  if (normalized) return normalized;
  throw std::invalid_argument("PROJ knows no way from \"" + name +
                              "\" to longitude and latitude; give another CRS, or \"local\"");
}

std::string CoordinateSystem::EllipsoidParameters() const {
  double semi_major_m = 0.0;
  double inverse_flattening = 0.0;
  proj_ellipsoid_get_parameters(
      context_.get(), ellipsoid_.get(), &semi_major_m, nullptr, nullptr, &inverse_flattening);
  std::ostringstream text;
  text.precision(17);
  text << " +a=" << semi_major_m;
  if (inverse_flattening > 0.0) {
    text << " +rf=" << inverse_flattening;
  } else {
    text << " +b=" << semi_major_m;
  }
  return text.str();
}

std::optional<Eigen::Vector2d> CoordinateSystem::ToLonLat(const Eigen::Vector2d& east_north) const {
  return Transform(lon_lat_from_crs_.get(), PJ_FWD, east_north);
}

std::optional<Eigen::Vector2d> CoordinateSystem::FromLonLat(
    const Eigen::Vector2d& lon_lat_deg) const {
  return Transform(lon_lat_from_crs_.get(), PJ_INV, lon_lat_deg);
}

std::optional<Eigen::Vector2d> CoordinateSystem::ToWgs84(const Eigen::Vector2d& lon_lat_deg) const {
  return Transform(wgs84_from_lon_lat_.get(), PJ_FWD, lon_lat_deg);
}

std::optional<Eigen::Vector2d> CoordinateSystem::FromWgs84(
    const Eigen::Vector2d& lon_lat_deg) const {
  return Transform(wgs84_from_lon_lat_.get(), PJ_INV, lon_lat_deg);
}

}  // namespace plumb
