// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumb {

// What a survey's third coordinate counts from.
enum class HeightReference {
  kLocal,        // The zero of a local survey.
  kEllipsoidal,  // The ellipsoid, as a satellite receiver without a geoid model gives it.
  kOrthometric,  // The sea level of a national height system.
  kUnstated      // The file does not say; taken as orthometric, as most national surveys are.
};

// "local", "ellipsoidal", "orthometric", "unstated", and the inverse, which throws
// std::invalid_argument naming an unknown word.
const char* ToString(HeightReference heights);
HeightReference HeightReferenceFromString(const std::string& word);

// The name of a survey's coordinates that belong to no coordinate reference system.
constexpr char kLocalCrs[] = "local";

// A marker whose centre was measured on site. Coordinates in the survey's CRS, east (or longitude
// [deg]) first, then north (or latitude), then height, whatever order the CRS's own axes have.
struct SurveyTarget {
  int id = -1;       // Of the marker.
  std::string name;  // As the file has it.
  Eigen::Vector3d point_in_crs = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;   // Of each coordinate.
  bool is_check = false;  // Kept out of the adjustment, to check it with. Otherwise control.
  int line = 0;           // Of the file, from 1.
};

// A target that a person pointed at in a photo.
struct PointedTarget {
  int id = -1;
  std::string photo;                                // File name.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // Raw; (0, 0) is the top-left pixel's centre.
};

struct Survey {
  std::string source;           // The file, for messages.
  std::string crs = kLocalCrs;  // Or as PROJ knows it, e.g. "EPSG:31256" or "EPSG:31256+5778".
  HeightReference heights = HeightReference::kLocal;
  std::vector<SurveyTarget> targets;   // By id; each once.
  std::vector<PointedTarget> pointed;  // Of a gcp_list.txt; empty otherwise.
};

// What the caller knows better than the file. Empty: as the file says.
struct SurveyReading {
  std::string crs;
  std::string heights;             // A word of ToString(HeightReference).
  double default_sigma_m = 0.005;  // Of points whose file gives none: a total station's.
};

// Reads a survey by what is in it: CSV, or OpenDroneMap's gcp_list.txt, whose first line is a CRS.
//   CSV  A header line names the columns id, x_m, y_m, z_m (lon_deg, lat_deg, z_m if the CRS is
//        geographic), and, if there, sigma_m and role (control or check), in any order; without
//        a header they are in this order. Separated by comma, semicolon (with a decimal comma, if
//        need be) or tabulator. Lines "# crs: EPSG:31256" and "# heights: orthometric" say what the
//        coordinates are; other lines that begin with '#' are comments. No CRS: local.
//   ODM  Lines of geo_x geo_y geo_z im_x im_y image [gcp_name]. A name that is a whole number is
//        the marker's id; other points get ids beyond all markers'.
// A byte order mark and CR LF are taken. Throws std::runtime_error naming the file, the number and
// fault of a bad line, and the cure: not a number, an id that no marker has or that stands twice, a
// sigma_m above 0.5 m (written in millimetres), an unknown CRS or one that does not count in metres
// or degrees, coordinates outside its area (which also says if exchanged axes would lie inside), no
// target at all.
Survey ReadSurvey(const std::string& path, const SurveyReading& reading = {});

// The same from text; `source` names it in errors.
Survey ParseSurvey(const std::string& text,
                   const std::string& source,
                   const SurveyReading& reading = {});

// OpenDroneMap's gcp_list.txt of the survey's control points and where the photos show them
// (OpenDroneMap documentation, "Ground Control Points"); its pixels count as ours. Check points are
// left out: OpenDroneMap would adjust to them. Precondition: the CRS is not local, which the
// format has no word for.
std::string ToGcpList(const Survey& survey, const std::vector<PointedTarget>& sightings);

}  // namespace plumb
