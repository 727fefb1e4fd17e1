// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/mesh_session.h"

#include "plumbline/common/atomic_file.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/export/folder.h"
#include "plumbline/export/mesh.h"
#include "plumbline/surface/surface_mesher.h"
#include "tools/export_folder.h"
#include "tools/session_frame.h"
#include "tools/session_map.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const SurfaceReport& report) {
  Json problems = Json::array();
  for (const SurfaceProblem& problem : report.problems) problems.push_back(Describe(problem));
  return {{"landmarks", report.num_landmarks_added},
          {"rays", report.num_rays},
          {"vertices", report.num_vertices},
          {"cells", report.num_cells},
          {"faces", report.num_faces},
          {"scene_s", report.scene_s},
          {"tetrahedra_s", report.tetrahedra_s},
          {"weights_s", report.weights_s},
          {"cut_s", report.cut_s},
          {"mesh_s", report.mesh_s},
          {"problems", problems}};
}

void Place(const SessionFrame& frame, MeshDelta* mesh) {
  for (MeshBlock& block : mesh->blocks) {
    for (MeshVertex& vertex : block.vertices) {
      vertex.position_in_map = frame.Place(vertex.position_in_map);
    }
  }
}

}  // namespace

Json MeshSession(const SurfaceOptions& options,
                 const SessionStore& store,
                 const SessionMap& map,
                 const std::string& folder) {
  const Stopwatch watch;
  SurfaceMesher mesher(options);
  const SessionFrame frame(store, map);
  SurfaceUpdate update = *mesher.Apply(map.snapshot);
  Json report = ToJson(update.report);
  report["blocks"] = update.mesh.blocks.size();
  if (update.report.num_faces == 0) {
    report["stale"] = ExportFolder(folder).DeleteStale(frame.state());
    return report;
  }
  MakeExportFolder(folder);
  std::vector<std::string> names = {"mesh.ply", "mesh.obj"};
  if (frame.georeference()) names.emplace_back("frame.json");
  ExportFolder files(folder);
  std::vector<std::string> lines = files.SetAside(names);
  Place(frame, &update.mesh);
  ExportMeshPly(update.mesh, folder + "/mesh.ply", frame.Comments());
  ExportMeshObj(update.mesh, folder + "/mesh.obj", frame.Comments());
  if (frame.georeference()) WriteFileAtomically(folder + "/frame.json", frame.Json());
  files.Add(names, frame.state());
  for (std::string& line : files.DeleteStale(frame.state())) lines.push_back(std::move(line));
  report["total_s"] = watch.Seconds();
  report["frame"] = frame.georeference()
                        ? frame.Name() + ", metres"
                        : "map, scale free; plumbline georeference with a survey gives metres";
  for (const std::string& name : names) report["files"].push_back(folder + '/' + name);
  report["stale"] = lines;
  if (!frame.outdated().empty()) report["outdated"] = frame.outdated();
  return report;
}

}  // namespace plumb::tools
