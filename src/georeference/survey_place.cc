// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/survey_place.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/median.h"
#include "georeference/finding_text.h"
#include "georeference/survey_text.h"

namespace plumb {
namespace {

constexpr double kEarthRadius_m = 6371e3;
constexpr double kDegree_rad = M_PI / 180.0;
constexpr double kMetresPerKilometre = 1000.0;

template <typename Values, typename Coordinate>
double MedianCoordinate(const Values& values, const Coordinate& coordinate) {
  std::vector<double> numbers;
  numbers.reserve(values.size());
  for (const auto& value : values) numbers.push_back(coordinate(value));
  return MedianOf(std::move(numbers));
}

// Along the earth taken as a ball, to half a per cent (the haversine formula).
double DistanceOnEarth_m(const GeodeticPosition& a, const GeodeticPosition& b) {
  const double half_lat = 0.5 * (b.lat_deg - a.lat_deg) * kDegree_rad;
  const double half_lon = 0.5 * (b.lon_deg - a.lon_deg) * kDegree_rad;
  const double square = std::pow(std::sin(half_lat), 2) + std::cos(a.lat_deg * kDegree_rad) *
                                                              std::cos(b.lat_deg * kDegree_rad) *
                                                              std::pow(std::sin(half_lon), 2);
  return 2.0 * kEarthRadius_m * std::asin(std::min(1.0, std::sqrt(square)));
}

// Of a point of a CRS from a position; nothing where the CRS is not defined.
std::optional<double> DistanceOf_m(const GeoFrame& frame,
                                   const Eigen::Vector3d& point_in_crs,
                                   const GeodeticPosition& position) {
  try {
    const auto place = frame.ToWgs84(frame.ToEnu(point_in_crs));
    if (place) return DistanceOnEarth_m(*place, position);
  } catch (const std::runtime_error&) {
  }
  return std::nullopt;
}

// The EPSG code of the same grid of UTM zones in which `position` lies; empty if `crs` is none.
std::string ZoneAt(const std::string& crs, const GeodeticPosition& position) {
  std::string code = Lowercase(crs);
  if (code.rfind("epsg:", 0) == 0) code = code.substr(5);
  // WGS 84 north and south, ETRS 89, NAD 83: two digits of the zone behind.
  const std::string grid = code.substr(0, 3);
  const bool is_known = grid == "326" || grid == "327" || grid == "258" || grid == "269";
  if (code.size() != 5 || !is_known || ParseId(code) < 0) return {};
  const int zone = std::clamp(1 + static_cast<int>((position.lon_deg + 180.0) / 6.0), 1, 60);
  const bool is_worldwide = grid == "326" || grid == "327";
  const std::string name = !is_worldwide ? grid : position.lat_deg < 0.0 ? "327" : "326";
  return "EPSG:" + name + (zone < 10 ? "0" : "") + std::to_string(zone);
}

// Whether the survey would lie at `position` in another CRS.
bool IsThereIn(const std::string& crs,
               HeightReference heights,
               const Eigen::Vector3d& point_in_crs,
               const GeodeticPosition& position,
               double max_distance_m) {
  try {
    const GeoFrame frame(crs, heights, point_in_crs);
    const auto distance_m = DistanceOf_m(frame, point_in_crs, position);
    return distance_m && *distance_m <= max_distance_m;
  } catch (const std::runtime_error&) {
    return false;
  }
}

Finding ElsewhereFinding(const std::string& cure,
                         const std::string& code,
                         const Survey& survey,
                         double distance_m) {
  return {Finding::Severity::kError,
          code,
          Text(survey.source,
               ": lies ",
               distance_m / kMetresPerKilometre,
               " km from where the photos' GPS is",
               cure)};
}

}  // namespace

std::optional<Finding> FindElsewhere(double max_distance_m,
                                     const Survey& survey,
                                     const GeoFrame& frame,
                                     const std::vector<GeodeticPosition>& positions) {
  if (frame.is_local() || positions.empty()) return std::nullopt;
  GeodeticPosition gps;
  gps.lat_deg = MedianCoordinate(positions, [](const auto& position) { return position.lat_deg; });
  gps.lon_deg = MedianCoordinate(positions, [](const auto& position) { return position.lon_deg; });
  Eigen::Vector3d point;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = MedianCoordinate(
        survey.targets, [axis](const auto& target) { return target.point_in_crs[axis]; });
  }
  const auto distance_m = DistanceOf_m(frame, point, gps);
  if (!distance_m || *distance_m <= max_distance_m) return std::nullopt;

  const auto exchanged_m = DistanceOf_m(frame, {point.y(), point.x(), point.z()}, gps);
  if (exchanged_m && *exchanged_m <= max_distance_m) {
    return ElsewhereFinding(
        ", but not with its first two coordinates exchanged: exchange them, east comes first, then "
        "north",
        "swapped_axes",
        survey,
        *distance_m);
  }
  const std::string zone = ZoneAt(survey.crs, gps);
  if (!zone.empty() && IsThereIn(zone, survey.heights, point, gps, max_distance_m)) {
    return ElsewhereFinding(
        ", but not as " + zone + ": give that CRS instead of \"" + survey.crs + '"',
        "survey_elsewhere",
        survey,
        *distance_m);
  }
  return ElsewhereFinding(": give the CRS it was measured in instead of \"" + survey.crs +
                              "\", or the survey of this site; if the photos' GPS is wrong, raise "
                              "max_gps_distance_m",
                          "survey_elsewhere",
                          survey,
                          *distance_m);
}

}  // namespace plumb
