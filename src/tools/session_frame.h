// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/georeference/georeference_file.h"
#include "plumbline/map/session_store.h"
#include "tools/session_map.h"

namespace plumb::tools {

// The frame in which a session's points and mesh are exported: with a georeference of this very map
// the survey's CRS less the frame's origin (enu about it, if the CRS counts in degrees), so that no
// coordinate is large; otherwise the map's.
class SessionFrame {
 public:
  // Throws std::runtime_error naming a georeference that cannot be read.
  SessionFrame(const SessionStore& store, const SessionMap& map);

  const std::optional<StoredGeoreference>& georeference() const { return georeference_; }

  // That there is a georeference, but of an earlier map, and the cure; empty otherwise.
  const std::string& outdated() const { return outdated_; }

  // ExportState of what is exported in it.
  const std::string& state() const { return state_; }

  // A point of the map as it is exported.
  Eigen::Vector3d Place(const Eigen::Vector3d& point_in_map) const;

  // For a file's header, a line each: the frame, and all that leads back to the map.
  std::vector<std::string> Comments() const;

  // For a person, e.g. "EPSG:31256 less -68110 212350 360". Precondition: georeferenced.
  std::string Name() const;
  std::string OriginText() const;

  // frame.json, which lies beside the exported files. Precondition: georeferenced.
  std::string Json() const;

 private:
  bool IsInCrs() const { return !georeference_->frame.is_geographic(); }

  std::optional<StoredGeoreference> georeference_;
  std::string outdated_;
  std::string state_;
};

// The inverse of Place, by the comments of the file at `path`; without a word of the frame they are
// points of the map already. Throws std::runtime_error naming the file and the cure.
std::vector<Eigen::Vector3d> BroughtIntoMap(const std::string& path,
                                            const std::vector<std::string>& comments,
                                            std::vector<Eigen::Vector3d> points);

}  // namespace plumb::tools
