// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/geo_frame.h"

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "georeference/coordinate_system.h"
#include "plumbline/common/check.h"

namespace plumb {
namespace {

constexpr double kRadPerDeg = M_PI / 180.0;

std::optional<Eigen::Vector3d> Transform(PJ* operation,
                                         PJ_DIRECTION direction,
                                         const Eigen::Vector3d& from) {
  proj_errno_reset(operation);
  const PJ_COORD to =
      proj_trans(operation, direction, proj_coord(from.x(), from.y(), from.z(), 0.0));
  const Eigen::Vector3d point(to.xyz.x, to.xyz.y, to.xyz.z);
  if (!point.allFinite()) return std::nullopt;
  return point;
}

// Columns: east, north and up in an earth-centred frame.
Eigen::Matrix3d EarthFromEnuRotation(double lon_deg, double lat_deg) {
  const double lon = lon_deg * kRadPerDeg;
  const double lat = lat_deg * kRadPerDeg;
  const Eigen::Vector3d east(-std::sin(lon), std::cos(lon), 0.0);
  const Eigen::Vector3d up(
      std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  Eigen::Matrix3d rotation;
  rotation << east, up.cross(east), up;
  return rotation;
}

}  // namespace

const char* ToString(HeightReference heights) {
  switch (heights) {
    case HeightReference::kLocal:
      return "local";
    case HeightReference::kEllipsoidal:
      return "ellipsoidal";
    case HeightReference::kOrthometric:
      return "orthometric";
    case HeightReference::kUnstated:
      return "unstated";
  }
  throw std::logic_error("ToString: no such height reference");
}

HeightReference HeightReferenceFromString(const std::string& word) {
  for (const HeightReference heights : {HeightReference::kLocal,
                                        HeightReference::kEllipsoidal,
                                        HeightReference::kOrthometric,
                                        HeightReference::kUnstated}) {
    if (word == ToString(heights)) return heights;
  }
  throw std::invalid_argument("heights \"" + word +
                              "\" are unknown; say ellipsoidal or orthometric");
}

struct GeoFrame::Projection {
  explicit Projection(const std::string& crs) : system(crs) {}

  ProjObject Pipeline(const std::string& steps) const {
    return ProjObject(proj_create(system.context(), ("+proj=pipeline" + steps).c_str()));
  }

  CoordinateSystem system;
  ProjObject enu_from_geodetic;  // Longitude, latitude [deg], height on its own ellipsoid.
  ProjObject ecef_from_wgs84;    // Longitude, latitude [deg], ellipsoidal height.
  ProjObject ellipsoidal_from_orthometric;  // Longitude, latitude [deg], height. Null: no grid.
};

GeoFrame::GeoFrame(const std::string& crs,
                   HeightReference heights,
                   const Eigen::Vector3d& origin_in_crs)
    : crs_(crs), heights_(heights), origin_in_crs_(origin_in_crs) {
  if (crs == kLocalCrs) return;
  std::shared_ptr<Projection> projection;
  try {
    projection = std::make_shared<Projection>(crs);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
  const auto origin = projection->system.ToLonLat(origin_in_crs.head<2>());
  const std::string radians = " +step +proj=unitconvert +xy_in=deg +xy_out=rad";
  if (origin) {
    const std::string ellipsoid = projection->system.EllipsoidParameters();
    std::ostringstream steps;
    steps.precision(17);
    steps << radians << " +step +proj=cart" << ellipsoid
          << " +step +proj=topocentric +lat_0=" << origin->y() << " +lon_0=" << origin->x()
          << " +h_0=" << origin_in_crs.z() << ellipsoid;
    projection->enu_from_geodetic = projection->Pipeline(steps.str());
  }
  projection->ecef_from_wgs84 = projection->Pipeline(radians + " +step +proj=cart +ellps=WGS84");
  projection->ellipsoidal_from_orthometric =
      projection->Pipeline(radians +
                           " +step +proj=vgridshift +grids=egm96_15.gtx +multiplier=1"
                           " +step +proj=unitconvert +xy_in=rad +xy_out=deg");
  if (!projection->enu_from_geodetic || !projection->ecef_from_wgs84) {
    std::ostringstream text;
    text.precision(12);
    text << '"' << crs << "\" is not defined at " << origin_in_crs.x() << ", " << origin_in_crs.y()
         << "; east comes first, then north: are they exchanged, or is it another CRS?";
    throw std::runtime_error(text.str());
  }
  is_geographic_ = projection->system.is_geographic();
  projection_ = std::move(projection);
}

GeoFrame GeoFrame::Around(const Survey& survey) {
  constexpr double kSmall_m = 10'000.0;  // A float holds millimetres up to here.
  PLUMB_CHECK(!survey.targets.empty());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double largest = 0.0;
  for (const SurveyTarget& target : survey.targets) {
    mean += target.point_in_crs / static_cast<double>(survey.targets.size());
    largest = std::max(largest, target.point_in_crs.cwiseAbs().maxCoeff());
  }
  const bool is_local = survey.crs == kLocalCrs;
  if (is_local && largest < kSmall_m) mean.setZero();
  // To 10 m; of degrees, to 0.0001, which is as much.
  const bool is_geographic = !is_local && CoordinateSystem(survey.crs).is_geographic();
  const double step = is_geographic ? 1e-4 : 10.0;
  const Eigen::Vector3d steps(step, step, 10.0);
  const Eigen::Vector3d origin = mean.cwiseQuotient(steps).array().round() * steps.array();
  return {survey.crs, survey.heights, origin};
}

Eigen::Vector3d GeoFrame::ToEnu(const Eigen::Vector3d& point_in_crs) const {
  if (is_local()) return point_in_crs - origin_in_crs_;
  const auto lon_lat = projection_->system.ToLonLat(point_in_crs.head<2>());
  std::optional<Eigen::Vector3d> point_in_enu;
  if (lon_lat) {
    point_in_enu = Transform(projection_->enu_from_geodetic.get(),
                             PJ_FWD,
                             {lon_lat->x(), lon_lat->y(), point_in_crs.z()});
  }
  if (!point_in_enu) throw std::runtime_error("a point lies where \"" + crs_ + "\" is not defined");
  return *point_in_enu;
}

Eigen::Vector3d GeoFrame::ToCrs(const Eigen::Vector3d& point_in_enu) const {
  if (is_local()) return point_in_enu + origin_in_crs_;
  const auto geodetic = Transform(projection_->enu_from_geodetic.get(), PJ_INV, point_in_enu);
  std::optional<Eigen::Vector2d> east_north;
  if (geodetic) east_north = projection_->system.FromLonLat(geodetic->head<2>());
  if (!east_north) throw std::runtime_error("a point lies where \"" + crs_ + "\" is not defined");
  return {east_north->x(), east_north->y(), geodetic->z()};
}

std::optional<GeodeticPosition> GeoFrame::ToWgs84(const Eigen::Vector3d& point_in_enu) const {
  if (is_local()) return std::nullopt;
  const auto geodetic = Transform(projection_->enu_from_geodetic.get(), PJ_INV, point_in_enu);
  if (!geodetic) return std::nullopt;
  const auto lon_lat = projection_->system.ToWgs84(geodetic->head<2>());
  if (!lon_lat) return std::nullopt;
  Eigen::Vector3d place(lon_lat->x(), lon_lat->y(), geodetic->z());
  if (heights_ != HeightReference::kEllipsoidal) {
    if (!projection_->ellipsoidal_from_orthometric) return std::nullopt;
    const auto raised = Transform(projection_->ellipsoidal_from_orthometric.get(), PJ_FWD, place);
    if (!raised) return std::nullopt;
    place = *raised;
  }
  return GeodeticPosition{place.y(), place.x(), place.z()};
}

std::optional<Eigen::Vector3d> GeoFrame::FromWgs84(const GeodeticPosition& position) const {
  if (is_local() || !position.alt_m) return std::nullopt;
  Eigen::Vector3d place(position.lon_deg, position.lat_deg, *position.alt_m);
  if (heights_ != HeightReference::kEllipsoidal) {
    if (!projection_->ellipsoidal_from_orthometric) return std::nullopt;
    const auto lowered = Transform(projection_->ellipsoidal_from_orthometric.get(), PJ_INV, place);
    if (!lowered) return std::nullopt;
    place = *lowered;
  }
  const auto lon_lat = projection_->system.FromWgs84(place.head<2>());
  if (!lon_lat) return std::nullopt;
  return Transform(
      projection_->enu_from_geodetic.get(), PJ_FWD, {lon_lat->x(), lon_lat->y(), place.z()});
}

std::optional<Rigid3> GeoFrame::EarthFromEnu() const {
  const std::optional<GeodeticPosition> origin = ToWgs84(Eigen::Vector3d::Zero());
  if (!origin) return std::nullopt;
  const auto origin_in_earth = Transform(projection_->ecef_from_wgs84.get(),
                                         PJ_FWD,
                                         {origin->lon_deg, origin->lat_deg, *origin->alt_m});
  if (!origin_in_earth) return std::nullopt;
  return Rigid3(Eigen::Quaterniond(EarthFromEnuRotation(origin->lon_deg, origin->lat_deg)),
                *origin_in_earth);
}

}  // namespace plumb
