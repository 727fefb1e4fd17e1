// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/mesh_session.h"

#include <filesystem>

#include "plumbline/common/stopwatch.h"
#include "plumbline/export/mesh.h"
#include "plumbline/surface/surface_mesher.h"
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

}  // namespace

Json MeshSession(const SurfaceOptions& options,
                 const SessionStore& store,
                 const std::string& folder) {
  const Stopwatch watch;
  SurfaceMesher mesher(options);
  const SurfaceUpdate update = *mesher.Apply(ReadSessionMap(store).snapshot);
  Json report = ToJson(update.report);
  report["blocks"] = update.mesh.blocks.size();
  std::filesystem::create_directories(folder);
  const std::string ply = folder + "/mesh.ply";
  const std::string obj = folder + "/mesh.obj";
  ExportMeshPly(update.mesh, ply);
  ExportMeshObj(update.mesh, obj);
  report["total_s"] = watch.Seconds();
  report["files"] = {ply, obj};
  return report;
}

}  // namespace plumb::tools
