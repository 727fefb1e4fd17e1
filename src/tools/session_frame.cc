// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/session_frame.h"

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tools/export_folder.h"
#include "tools/georeference.h"

namespace plumb::tools {
namespace {

constexpr char kInCrs[] = "crs less offset, metres";
constexpr char kInEnu[] = "enu about offset, metres";

std::string TextOf(const Similarity3& similarity) {
  const Eigen::Quaterniond& q = similarity.rotation;
  const Eigen::Vector3d& t = similarity.translation;
  std::ostringstream text;
  text << std::setprecision(17) << similarity.scale << ' ' << q.w() << ' ' << q.x() << ' ' << q.y()
       << ' ' << q.z() << ' ' << t.x() << ' ' << t.y() << ' ' << t.z();
  return text.str();
}

// "key: value" of each comment that is of this form.
std::map<std::string, std::string> ValuesOf(const std::vector<std::string>& comments) {
  std::map<std::string, std::string> values;
  for (const std::string& comment : comments) {
    const std::size_t colon = comment.find(": ");
    if (colon != std::string::npos) values[comment.substr(0, colon)] = comment.substr(colon + 2);
  }
  return values;
}

// Throws std::invalid_argument.
std::vector<double> NumbersOf(const std::string& text, std::size_t count) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;) numbers.push_back(number);
  if (numbers.size() != count || !words.eof()) throw std::invalid_argument('"' + text + '"');
  return numbers;
}

// Throws std::invalid_argument.
Similarity3 ParseSimilarity(const std::string& text) {
  const std::vector<double> n = NumbersOf(text, 8);
  const Eigen::Quaterniond rotation(n[1], n[2], n[3], n[4]);
  if (!(n[0] > 0.0) || std::abs(rotation.norm() - 1.0) > 1e-3) {
    throw std::invalid_argument('"' + text + '"');
  }
  return {n[0], rotation.normalized(), {n[5], n[6], n[7]}};
}

}  // namespace

SessionFrame::SessionFrame(const SessionStore& store, const SessionMap& map) {
  const std::string path = GeoreferencePath(store.folder());
  state_ = ExportState(map.snapshot.sequence, map.is_refined, /*georeference=*/"");
  if (!std::filesystem::exists(path)) return;
  StoredGeoreference georeference = ReadGeoreference(path);
  if (georeference.map_sequence == map.snapshot.sequence &&
      georeference.is_of_refined_map == map.is_refined) {
    georeference_ = std::move(georeference);
    state_ = ExportState(map.snapshot.sequence, map.is_refined, path);
    return;
  }
  outdated_ = path +
              ": is of an earlier map; run plumbline georeference again. Written in the map's "
              "frame, scale free";
}

Eigen::Vector3d SessionFrame::Place(const Eigen::Vector3d& point_in_map) const {
  if (!georeference_) return point_in_map;
  const Eigen::Vector3d point_in_enu = georeference_->enu_from_map * point_in_map;
  if (!IsInCrs()) return point_in_enu;
  const GeoFrame& frame = georeference_->frame;
  return frame.ToCrs(point_in_enu) - frame.origin_in_crs();
}

std::string SessionFrame::OriginText() const {
  const Eigen::Vector3d& origin = georeference_->frame.origin_in_crs();
  std::ostringstream text;
  text << std::setprecision(15) << origin.x() << ' ' << origin.y() << ' ' << origin.z();
  return text.str();
}

std::vector<std::string> SessionFrame::Comments() const {
  if (!georeference_) return {"frame: map", "scale: none, lengths are relative"};
  const GeoFrame& frame = georeference_->frame;
  std::vector<std::string> comments = {std::string("frame: ") + (IsInCrs() ? kInCrs : kInEnu),
                                       "crs: " + frame.crs(),
                                       std::string("heights: ") + ToString(frame.heights()),
                                       "offset: " + OriginText(),
                                       "enu_from_map: " + TextOf(georeference_->enu_from_map)};
  if (georeference_->is_coarse) comments.emplace_back("coarse: by GPS alone, metres off");
  return comments;
}

std::string SessionFrame::Name() const {
  return (IsInCrs() ? georeference_->frame.crs() + " less " : "enu about ") + OriginText();
}

std::string SessionFrame::Json() const {
  const GeoFrame& frame = georeference_->frame;
  const Eigen::Vector3d& origin = frame.origin_in_crs();
  const std::string of_points =
      IsInCrs() ? "coordinates in crs less offset [m]" : "enu about offset [m]";
  const nlohmann::ordered_json json = {
      {"crs", frame.crs()},
      {"heights", ToString(frame.heights())},
      {"coarse", georeference_->is_coarse},
      {"offset", {origin.x(), origin.y(), origin.z()}},
      {"points.ply", of_points},
      {"mesh.ply", of_points},
      {"mesh.obj", of_points},
      {"colmap", "enu about offset [m]: east, north, up in the plane that touches the ellipsoid"}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

std::vector<Eigen::Vector3d> BroughtIntoMap(const std::string& path,
                                            const std::vector<std::string>& comments,
                                            std::vector<Eigen::Vector3d> points) {
  std::map<std::string, std::string> values = ValuesOf(comments);
  const std::string& name = values["frame"];
  if (name != kInCrs && name != kInEnu) return points;
  try {
    const std::vector<double> origin = NumbersOf(values["offset"], 3);
    const GeoFrame frame(values["crs"],
                         HeightReferenceFromString(values["heights"]),
                         {origin[0], origin[1], origin[2]});
    const Similarity3 map_from_enu = ParseSimilarity(values["enu_from_map"]).Inverse();
    for (Eigen::Vector3d& point : points) {
      if (name == kInCrs) point = frame.ToEnu(point + frame.origin_in_crs());
      point = map_from_enu * point;
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": what its header says of the frame cannot be read (" +
                             error.what() + "); run plumbline mesh again");
  }
  return points;
}

}  // namespace plumb::tools
