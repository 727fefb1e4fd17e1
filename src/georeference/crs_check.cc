// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/crs_check.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "georeference/coordinate_system.h"

namespace plumb {
namespace {

bool IsInArea(const CoordinateSystem& system, const Eigen::Vector2d& east_north) {
  if (system.is_geographic() && std::abs(east_north.y()) > 90.0) return false;
  const auto lon_lat = system.ToLonLat(east_north);
  return lon_lat && system.area()->Contains(*lon_lat);
}

void SettleHeights(const CoordinateSystem& system, Survey* survey) {
  if (!system.states_heights()) return;
  const HeightReference of_crs =
      system.is_orthometric() ? HeightReference::kOrthometric : HeightReference::kEllipsoidal;
  if (survey->heights != HeightReference::kUnstated && survey->heights != of_crs) {
    throw std::invalid_argument("heights are said to be " + std::string(ToString(survey->heights)) +
                                ", but those of \"" + survey->crs + "\" are " + ToString(of_crs) +
                                "; correct one of them");
  }
  survey->heights = of_crs;
}

[[noreturn]] void RefusePlace(const CoordinateSystem& system,
                              const Survey& survey,
                              const SurveyTarget& outside) {
  std::ostringstream text;
  text << "line " << outside.line << ": id " << outside.name << " lies outside of \"" << survey.crs
       << "\" (" << system.area()->name.substr(0, 60) << "; " << system.area()->west << " to "
       << system.area()->east << " deg east, " << system.area()->south << " to "
       << system.area()->north << " deg north)";
  const auto is_in_area_exchanged = [&](const SurveyTarget& target) {
    return IsInArea(system, {target.point_in_crs.y(), target.point_in_crs.x()});
  };
  const auto& targets = survey.targets;
  if (std::all_of(targets.begin(), targets.end(), is_in_area_exchanged)) {
    text << ", but would lie inside with its first two coordinates exchanged: exchange them, east "
            "comes first, then north";
  } else {
    text << ": correct the point, or give the CRS it was measured in";
  }
  throw std::invalid_argument(text.str());
}

}  // namespace

void CheckCrs(std::optional<bool> has_degree_columns, Survey* survey) {
  if (survey->crs == kLocalCrs) {
    if (has_degree_columns.value_or(false)) {
      throw std::invalid_argument(
          "columns lon_deg and lat_deg need a geographic CRS; add a line \"# crs: EPSG:4326\"");
    }
    survey->heights = HeightReference::kLocal;
    return;
  }
  const CoordinateSystem system(survey->crs);
  if (has_degree_columns.value_or(system.is_geographic()) != system.is_geographic()) {
    throw std::invalid_argument(
        '"' + survey->crs +
        (*has_degree_columns
             ? "\" counts in metres: name the columns x_m and y_m, or give the CRS "
               "that counts in degrees"
             : "\" counts in degrees: name the columns lon_deg and lat_deg, or give "
               "the CRS that counts in metres"));
  }
  SettleHeights(system, survey);
  if (!system.area()) return;
  for (const SurveyTarget& target : survey->targets) {
    if (!IsInArea(system, target.point_in_crs.head<2>())) RefusePlace(system, *survey, target);
  }
}

}  // namespace plumb
