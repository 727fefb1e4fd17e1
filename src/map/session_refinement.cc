// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "map/session_refinement.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "map/session_map.h"
#include "plumbline/common/check.h"

namespace plumb {
namespace {

constexpr char kTables[] = R"sql(
CREATE TABLE IF NOT EXISTS refinement (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  base_sequence INTEGER NOT NULL,    -- Of the map that was refined.
  lens BLOB                          -- As session.lens, if it was refined.
);
CREATE TABLE IF NOT EXISTS refined_views (
  photo INTEGER PRIMARY KEY,
  qw REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL,  -- cam_from_map.
  tx REAL NOT NULL, ty REAL NOT NULL, tz REAL NOT NULL
);
CREATE TABLE IF NOT EXISTS refined_landmarks (
  id INTEGER PRIMARY KEY,
  x REAL, y REAL, z REAL             -- In the map; null if it was left out.
);
CREATE TABLE IF NOT EXISTS refined_out_observations (
  landmark INTEGER NOT NULL, photo INTEGER NOT NULL, feature_idx INTEGER NOT NULL,
  PRIMARY KEY (landmark, photo, feature_idx)
) WITHOUT ROWID;
)sql";

bool HasTables(sqlite::Database* database) {
  return database->QueryInt("SELECT count(*) FROM sqlite_master WHERE name = 'refinement'") == 1;
}

void Clear(sqlite::Database* database) {
  database->Execute(
      "DELETE FROM refinement; DELETE FROM refined_views; DELETE FROM refined_landmarks;"
      "DELETE FROM refined_out_observations");
}

void WriteViews(sqlite::Database* database, const std::vector<ViewState>& views) {
  sqlite::Statement& insert =
      database->Prepared("INSERT INTO refined_views VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  for (const ViewState& view : views) {
    const Eigen::Quaterniond& q = view.cam_from_map.rotation;
    const Eigen::Vector3d& t = view.cam_from_map.translation;
    insert.Run(view.photo.value, q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
  }
}

void WriteLandmarks(sqlite::Database* database, const MapDelta& delta) {
  sqlite::Statement& insert =
      database->Prepared("INSERT INTO refined_landmarks VALUES (?, ?, ?, ?)");
  for (const LandmarkState& landmark : delta.landmarks_set) {
    const Eigen::Vector3d& p = landmark.position_in_map;
    insert.Run(landmark.id.value, p.x(), p.y(), p.z());
  }
  const std::optional<double> none;
  for (const LandmarkId id : delta.landmarks_removed) insert.Run(id.value, none, none, none);
}

void WriteOutObservations(sqlite::Database* database, const MapDelta& delta) {
  sqlite::Statement& insert =
      database->Prepared("INSERT INTO refined_out_observations VALUES (?, ?, ?)");
  for (const ObservationState& out : delta.observations_removed) {
    insert.Run(out.landmark.value, out.photo.value, out.feature_idx);
  }
}

std::optional<LensParameters<double>> ReadLens(sqlite::Database* database) {
  sqlite::Statement row(database, "SELECT lens FROM refinement");
  if (!row.Step()) database->Fail(SQLITE_CORRUPT);
  if (row.IsNull(0)) return std::nullopt;
  const sqlite::Blob blob = row.Bytes(0);
  LensParameters<double> lens;
  if (blob.size != sizeof(double) * lens.size()) database->Fail(SQLITE_CORRUPT);
  std::memcpy(lens.data(), blob.data, blob.size);
  return lens;
}

void MoveViews(sqlite::Database* database, std::vector<ViewState>* views) {
  std::map<std::uint32_t, ViewState*> by_photo;
  for (ViewState& view : *views) by_photo[view.photo.value] = &view;
  sqlite::Statement row(database, "SELECT photo, qw, qx, qy, qz, tx, ty, tz FROM refined_views");
  while (row.Step()) {
    const auto view = by_photo.find(static_cast<std::uint32_t>(row.Int(0)));
    if (view == by_photo.end()) database->Fail(SQLITE_CORRUPT);
    Rigid3& cam_from_map = view->second->cam_from_map;
    // Assigned, not constructed: normalising again could change the last bit.
    cam_from_map.rotation = {row.Double(1), row.Double(2), row.Double(3), row.Double(4)};
    cam_from_map.translation = {row.Double(5), row.Double(6), row.Double(7)};
  }
}

// Gives the ids of the landmarks that are left out, which go.
std::set<std::uint32_t> MoveLandmarks(sqlite::Database* database,
                                      std::vector<LandmarkState>* landmarks) {
  std::map<std::uint32_t, Eigen::Vector3d> refined;
  std::set<std::uint32_t> out;
  sqlite::Statement row(database, "SELECT id, x, y, z FROM refined_landmarks");
  while (row.Step()) {
    const auto id = static_cast<std::uint32_t>(row.Int(0));
    if (row.IsNull(1)) {
      out.insert(id);
    } else {
      refined[id] = {row.Double(1), row.Double(2), row.Double(3)};
    }
  }
  std::vector<LandmarkState> kept;
  for (LandmarkState& landmark : *landmarks) {
    if (out.count(landmark.id.value) != 0) continue;
    const auto found = refined.find(landmark.id.value);
    if (found != refined.end()) landmark.position_in_map = found->second;
    kept.push_back(landmark);
  }
  *landmarks = std::move(kept);
  return out;
}

void RemoveObservations(sqlite::Database* database,
                        const std::set<std::uint32_t>& landmarks_out,
                        std::vector<ObservationState>* observations) {
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
  std::set<Key> out;
  sqlite::Statement row(database,
                        "SELECT landmark, photo, feature_idx FROM refined_out_observations");
  while (row.Step()) {
    out.insert({static_cast<std::uint32_t>(row.Int(0)),
                static_cast<std::uint32_t>(row.Int(1)),
                static_cast<std::uint32_t>(row.Int(2))});
  }
  const auto is_out = [&](const ObservationState& observation) {
    const std::uint32_t landmark = observation.landmark.value;
    return landmarks_out.count(landmark) != 0 ||
           out.count({landmark, observation.photo.value, observation.feature_idx}) != 0;
  };
  observations->erase(std::remove_if(observations->begin(), observations->end(), is_out),
                      observations->end());
}

}  // namespace

void WriteRefinement(sqlite::Database* database, const MapDelta& delta) {
  PLUMB_CHECK(!delta.is_snapshot && delta.views_removed.empty());
  PLUMB_CHECK(delta.observations_added.empty());
  sqlite::Transaction transaction(database);
  const std::int64_t last = database->QueryInt("SELECT last_sequence FROM session").value_or(0);
  PLUMB_CHECK_EQ(std::int64_t{delta.sequence}, last + 1);
  database->Execute(kTables);
  Clear(database);
  std::optional<sqlite::Blob> lens;
  if (delta.lens) lens = sqlite::Blob{delta.lens->data(), sizeof(double) * delta.lens->size()};
  database->Prepared("INSERT INTO refinement VALUES (1, ?, ?)").Run(last, lens);
  WriteViews(database, delta.views_set);
  WriteLandmarks(database, delta);
  WriteOutObservations(database, delta);
  transaction.Commit();
}

void DeleteRefinement(sqlite::Database* database) {
  if (!HasTables(database)) return;
  sqlite::Transaction transaction(database);
  Clear(database);
  transaction.Commit();
}

bool HasRefinement(sqlite::Database* database) {
  return HasTables(database) && database->QueryInt("SELECT count(*) FROM refinement") == 1;
}

// In one transaction: another program may put a refinement in place of the one that is being read.
std::optional<MapDelta> ReadRefinedSnapshot(sqlite::Database* database) {
  const sqlite::ReadTransaction transaction(database);
  if (!HasTables(database)) return std::nullopt;
  const auto base = database->QueryInt("SELECT base_sequence FROM refinement");
  if (!base) return std::nullopt;
  MapDelta snapshot = ReadSnapshotInTransaction(database);
  if (std::int64_t{snapshot.sequence} != *base) return std::nullopt;
  if (const auto lens = ReadLens(database)) snapshot.lens = lens;
  MoveViews(database, &snapshot.views_set);
  const std::set<std::uint32_t> landmarks_out = MoveLandmarks(database, &snapshot.landmarks_set);
  RemoveObservations(database, landmarks_out, &snapshot.observations_added);
  return snapshot;
}

}  // namespace plumb
