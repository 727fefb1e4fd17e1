// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/export_session.h"

#include <filesystem>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <utility>

#include "plumbline/common/atomic_file.h"
#include "plumbline/export/colmap_text.h"
#include "plumbline/export/ply.h"
#include "plumbline/georeference/georeference_file.h"
#include "tools/georeference.h"
#include "tools/session_map.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kNoScale[] =
    "the map has no scale yet: give plumbline georeference a survey, then export again";

// That of this very map; a map that has changed since is only said to have none.
std::optional<StoredGeoreference> FindGeoreference(const SessionStore& store,
                                                   const SessionMap& map,
                                                   std::vector<std::string>* lines) {
  const std::string path = GeoreferencePath(store.folder());
  if (!std::filesystem::exists(path)) return std::nullopt;
  StoredGeoreference georeference = ReadGeoreference(path);
  if (georeference.map_sequence == map.snapshot.sequence &&
      georeference.is_of_refined_map == map.is_refined) {
    return georeference;
  }
  lines->push_back(path +
                   ": is of an earlier map; run plumbline georeference again. Written in the map's "
                   "frame, scale free");
  return std::nullopt;
}

MapDelta Transformed(MapDelta snapshot, const Similarity3& enu_from_map) {
  for (ViewState& view : snapshot.views_set) {
    view.cam_from_map = TransformCamera(enu_from_map, view.cam_from_map);
  }
  for (LandmarkState& landmark : snapshot.landmarks_set) {
    landmark.position_in_map = enu_from_map * landmark.position_in_map;
  }
  return snapshot;
}

bool IsInCrs(const GeoFrame& frame) { return !frame.is_geographic(); }

// Of points in enu: less the origin, so that programs that read floats lose nothing.
std::vector<LandmarkState> InCrs(std::vector<LandmarkState> landmarks, const GeoFrame& frame) {
  for (LandmarkState& landmark : landmarks) {
    landmark.position_in_map = frame.ToCrs(landmark.position_in_map) - frame.origin_in_crs();
  }
  return landmarks;
}

std::string OriginText(const GeoFrame& frame) {
  const Eigen::Vector3d& origin = frame.origin_in_crs();
  std::ostringstream text;
  text << std::setprecision(15) << origin.x() << ' ' << origin.y() << ' ' << origin.z();
  return text.str();
}

std::vector<std::string> PlyComments(const StoredGeoreference& georeference) {
  const GeoFrame& frame = georeference.frame;
  std::vector<std::string> comments = {
      IsInCrs(frame) ? "frame: crs less offset, metres" : "frame: enu about offset, metres",
      "crs: " + frame.crs(),
      std::string("heights: ") + ToString(frame.heights()),
      "offset: " + OriginText(frame)};
  if (georeference.is_coarse) comments.emplace_back("coarse: by GPS alone, metres off");
  return comments;
}

std::string FrameJson(const StoredGeoreference& georeference) {
  const GeoFrame& frame = georeference.frame;
  const Eigen::Vector3d& origin = frame.origin_in_crs();
  const Json json = {
      {"crs", frame.crs()},
      {"heights", ToString(frame.heights())},
      {"coarse", georeference.is_coarse},
      {"offset", {origin.x(), origin.y(), origin.z()}},
      {"points.ply",
       IsInCrs(frame) ? "coordinates in crs less offset [m]" : "enu about offset [m]"},
      {"colmap", "enu about offset [m]: east, north, up in the plane that touches the ellipsoid"}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

ExportedSession ExportSession(const SessionStore& store, const std::string& folder) {
  ExportedSession exported;
  SessionMap map = ReadSessionMap(store);
  const auto georeference = FindGeoreference(store, map, &exported.lines);
  MapDelta snapshot = std::move(map.snapshot);
  if (georeference) snapshot = Transformed(std::move(snapshot), georeference->enu_from_map);
  const std::string colmap = folder + "/colmap";
  ExportColmapText(snapshot, store.camera(), colmap);
  const std::string ply = folder + "/points.ply";
  if (!georeference) {
    ExportPly(snapshot.landmarks_set, ply, {"frame: map", "scale: none, lengths are relative"});
    exported.lines.insert(exported.lines.end(), {"wrote " + colmap, "wrote " + ply});
    if (!snapshot.views_set.empty()) exported.lacks = kNoScale;
    return exported;
  }
  const GeoFrame& frame = georeference->frame;
  ExportPly(IsInCrs(frame) ? InCrs(snapshot.landmarks_set, frame) : snapshot.landmarks_set,
            ply,
            PlyComments(*georeference));
  const std::string sidecar = folder + "/frame.json";
  WriteFileAtomically(sidecar, FrameJson(*georeference));
  exported.lines.insert(
      exported.lines.end(),
      {"wrote " + colmap + " (metres, enu about " + OriginText(frame) + ')',
       "wrote " + ply + " (" + (IsInCrs(frame) ? frame.crs() + " less " : "enu about ") +
           OriginText(frame) + ')',
       "wrote " + sidecar});
  return exported;
}

}  // namespace plumb::tools
