// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/export_session.h"

#include <utility>

#include "plumbline/common/atomic_file.h"
#include "plumbline/export/colmap_text.h"
#include "plumbline/export/ply.h"
#include "tools/export_folder.h"
#include "tools/session_frame.h"
#include "tools/session_map.h"

namespace plumb::tools {
namespace {

constexpr char kNoScale[] =
    "the map has no scale yet: give plumbline georeference a survey, then export again";

MapDelta Transformed(MapDelta snapshot, const Similarity3& enu_from_map) {
  for (ViewState& view : snapshot.views_set) {
    view.cam_from_map = TransformCamera(enu_from_map, view.cam_from_map);
  }
  for (LandmarkState& landmark : snapshot.landmarks_set) {
    landmark.position_in_map = enu_from_map * landmark.position_in_map;
  }
  return snapshot;
}

std::vector<LandmarkState> Placed(std::vector<LandmarkState> landmarks, const SessionFrame& frame) {
  for (LandmarkState& landmark : landmarks) {
    landmark.position_in_map = frame.Place(landmark.position_in_map);
  }
  return landmarks;
}

}  // namespace

ExportedSession ExportSession(const SessionStore& store,
                              const SessionMap& map,
                              const std::string& folder) {
  ExportedSession exported;
  const MapDelta& snapshot = map.snapshot;
  const SessionFrame frame(store, map);
  const auto& georeference = frame.georeference();
  const std::string colmap = folder + "/colmap";
  const std::string ply = folder + "/points.ply";
  std::vector<std::string> names = {
      "colmap/cameras.txt", "colmap/images.txt", "colmap/points3D.txt", "points.ply"};
  if (georeference) names.emplace_back("frame.json");
  ExportFolder files(folder);
  exported.lines = files.SetAside(names);
  if (!frame.outdated().empty()) exported.lines.push_back(frame.outdated());
  ExportColmapText(georeference ? Transformed(snapshot, georeference->enu_from_map) : snapshot,
                   store.camera(),
                   colmap);
  ExportPly(Placed(snapshot.landmarks_set, frame), ply, frame.Comments());
  if (georeference) {
    WriteFileAtomically(folder + "/frame.json", frame.Json());
    exported.lines.insert(exported.lines.end(),
                          {"wrote " + colmap + " (metres, enu about " + frame.OriginText() + ')',
                           "wrote " + ply + " (" + frame.Name() + ')',
                           "wrote " + folder + "/frame.json"});
  } else {
    exported.lines.insert(exported.lines.end(), {"wrote " + colmap, "wrote " + ply});
    if (!snapshot.views_set.empty()) exported.lacks = kNoScale;
  }
  files.Add(names, frame.state());
  for (std::string& line : files.DeleteStale(frame.state())) {
    exported.lines.push_back(std::move(line));
  }
  return exported;
}

}  // namespace plumb::tools
