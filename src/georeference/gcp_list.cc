// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "georeference/survey_formats.h"
#include "plumbline/common/check.h"
#include "plumbline/marker/codebook.h"

namespace plumb {
namespace {

// Points by name, or by place where they have none.
using PointKey = std::tuple<std::string, double, double, double>;

struct GcpLine {
  Eigen::Vector3d point_in_crs;
  Eigen::Vector2d pixel;
  std::string photo;
  std::string name;  // Empty: none.
};

GcpLine ReadLine(const TextLine& line) {
  const std::vector<std::string> words = SplitWords(line.text);
  if (words.size() < 6) {
    throw std::invalid_argument("has " + std::to_string(words.size()) +
                                " fields; a gcp_list.txt has geo_x geo_y geo_z im_x im_y image "
                                "[gcp_name], separated by blanks");
  }
  GcpLine gcp;
  const char* names[] = {"geo_x", "geo_y", "geo_z", "im_x", "im_y"};
  for (int i = 0; i < 3; ++i) gcp.point_in_crs[i] = ParseCoordinate(words[i], names[i], false);
  for (int i = 0; i < 2; ++i) gcp.pixel[i] = ParseCoordinate(words[3 + i], names[3 + i], false);
  gcp.photo = words[5];
  if (words.size() > 6) gcp.name = words[6];
  return gcp;
}

PointKey KeyOf(const GcpLine& gcp) {
  if (!gcp.name.empty()) return {gcp.name, 0.0, 0.0, 0.0};
  return {"", gcp.point_in_crs.x(), gcp.point_in_crs.y(), gcp.point_in_crs.z()};
}

}  // namespace

bool IsCrsLine(const std::string& line) {
  const std::string word = Lowercase(line);
  for (const char* start : {"epsg:", "+proj", "wgs84 utm", "wgs 84"}) {
    if (word.rfind(start, 0) == 0) return true;
  }
  return false;
}

Survey ParseGcpList(const std::vector<TextLine>& lines, double default_sigma_m) {
  Survey survey;
  survey.crs = lines[0].text;
  survey.heights = HeightReference::kUnstated;
  std::map<PointKey, std::size_t> target_of_key;
  int next_id = MarkerCodebook::Get().size();
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].text[0] == '#') continue;
    GcpLine gcp;
    try {
      gcp = ReadLine(lines[i]);
    } catch (const std::invalid_argument& error) {
      FailAtLine(lines[i].number, error.what());
    }
    const auto [entry, is_new] = target_of_key.insert({KeyOf(gcp), survey.targets.size()});
    if (is_new) {
      const int named_id = ParseId(gcp.name);
      const bool is_marker = named_id >= 0 && named_id < MarkerCodebook::Get().size();
      const int id = is_marker ? named_id : next_id++;
      const std::string name =
          gcp.name.empty() ? "line " + std::to_string(lines[i].number) : gcp.name;
      survey.targets.push_back(
          {id, name, gcp.point_in_crs, default_sigma_m, false, lines[i].number});
    }
    const SurveyTarget& target = survey.targets[entry->second];
    if (target.point_in_crs != gcp.point_in_crs) {
      FailAtLine(lines[i].number,
                 "point " + gcp.name + " has another place than in line " +
                     std::to_string(target.line) + "; correct one of them, or its name");
    }
    survey.pointed.push_back({target.id, gcp.photo, gcp.pixel});
  }
  return survey;
}

std::string ToGcpList(const Survey& survey, const std::vector<PointedTarget>& sightings) {
  PLUMB_CHECK(survey.crs != kLocalCrs);
  std::map<int, const SurveyTarget*> control;
  for (const SurveyTarget& target : survey.targets) {
    if (!target.is_check) control[target.id] = &target;
  }
  std::ostringstream text;
  text << survey.crs << '\n';
  for (const PointedTarget& seen : sightings) {
    const auto found = control.find(seen.id);
    if (found == control.end()) continue;
    const Eigen::Vector3d& point = found->second->point_in_crs;
    text << std::setprecision(13) << point.x() << ' ' << point.y() << ' ' << point.z() << ' '
         << std::setprecision(8) << seen.pixel.x() << ' ' << seen.pixel.y() << ' ' << seen.photo
         << ' ' << seen.id << '\n';
  }
  return text.str();
}

}  // namespace plumb
