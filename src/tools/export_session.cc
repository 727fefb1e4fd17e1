// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/export_session.h"

#include "plumbline/export/colmap_text.h"
#include "plumbline/export/ply.h"

namespace plumb::tools {

std::vector<std::string> ExportSession(const SessionStore& store, const std::string& folder) {
  const MapDelta snapshot = store.Snapshot();
  const std::string colmap = folder + "/colmap";
  ExportColmapText(snapshot, store.camera(), colmap);
  const std::string ply = folder + "/points.ply";
  ExportPly(snapshot.landmarks_set, ply);
  return {colmap, ply};
}

}  // namespace plumb::tools
