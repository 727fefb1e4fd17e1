// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "map/session_map.h"

#include <cstring>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

void ClearMap(sqlite::Database* database) {
  database->Execute(
      "DELETE FROM observations; DELETE FROM landmarks; DELETE FROM views;"
      "UPDATE session SET lens = NULL");
}

void Remove(sqlite::Database* database, const MapDelta& delta) {
  sqlite::Statement& remove_observation = database->Prepared(
      "DELETE FROM observations WHERE landmark = ? AND photo = ? AND feature_idx = ?");
  for (const ObservationState& gone : delta.observations_removed) {
    remove_observation.Run(gone.landmark.value, gone.photo.value, gone.feature_idx);
  }
  sqlite::Statement& remove_landmark = database->Prepared("DELETE FROM landmarks WHERE id = ?");
  for (const LandmarkId id : delta.landmarks_removed) remove_landmark.Run(id.value);
  sqlite::Statement& remove_view = database->Prepared("DELETE FROM views WHERE photo = ?");
  for (const PhotoId id : delta.views_removed) remove_view.Run(id.value);
}

// Upserts, because REPLACE would delete the row and with it all its observations.
void SetViews(sqlite::Database* database, const std::vector<ViewState>& views) {
  sqlite::Statement& set_view = database->Prepared(
      "INSERT INTO views VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT DO UPDATE SET "
      "name = excluded.name, exposure_time_ns = excluded.exposure_time_ns, qw = excluded.qw, "
      "qx = excluded.qx, qy = excluded.qy, qz = excluded.qz, tx = excluded.tx, ty = excluded.ty, "
      "tz = excluded.tz");
  for (const ViewState& view : views) {
    const Eigen::Quaterniond& q = view.cam_from_map.rotation;
    const Eigen::Vector3d& t = view.cam_from_map.translation;
    set_view.Run(view.photo.value,
                 view.name,
                 view.exposure_time.ns,
                 q.w(),
                 q.x(),
                 q.y(),
                 q.z(),
                 t.x(),
                 t.y(),
                 t.z());
  }
}

void SetLandmarks(sqlite::Database* database, const std::vector<LandmarkState>& landmarks) {
  sqlite::Statement& set_landmark = database->Prepared(
      "INSERT INTO landmarks VALUES (?, ?, ?, ?, ?) ON CONFLICT DO UPDATE SET "
      "x = excluded.x, y = excluded.y, z = excluded.z, color = excluded.color");
  for (const LandmarkState& landmark : landmarks) {
    const Eigen::Vector3d& position = landmark.position_in_map;
    const Rgb& color = landmark.color;
    set_landmark.Run(landmark.id.value,
                     position.x(),
                     position.y(),
                     position.z(),
                     color[0] << 16 | color[1] << 8 | color[2]);
  }
}

void AddObservations(sqlite::Database* database,
                     const std::vector<ObservationState>& observations) {
  sqlite::Statement& add_observation =
      database->Prepared("INSERT INTO observations VALUES (?, ?, ?, ?, ?)");
  for (const ObservationState& added : observations) {
    add_observation.Run(added.landmark.value,
                        added.photo.value,
                        added.feature_idx,
                        added.pixel.x(),
                        added.pixel.y());
  }
}

void SetLens(sqlite::Database* database, const LensParameters<double>& lens) {
  database->Prepared("UPDATE session SET lens = ?")
      .Run(sqlite::Blob{lens.data(), sizeof(double) * lens.size()});
}

PhotoId PhotoAt(const sqlite::Statement& row, int column) {
  return {static_cast<std::uint32_t>(row.Int(column))};
}

LandmarkId LandmarkAt(const sqlite::Statement& row, int column) {
  return {static_cast<std::uint32_t>(row.Int(column))};
}

void ReadSession(sqlite::Database* database, MapDelta* snapshot) {
  sqlite::Statement row(database, "SELECT last_sequence, lens FROM session");
  if (!row.Step()) database->Fail(SQLITE_CORRUPT);
  snapshot->sequence = static_cast<std::uint32_t>(row.Int(0));
  if (row.IsNull(1)) return;
  const sqlite::Blob blob = row.Bytes(1);
  LensParameters<double> lens;
  if (blob.size != sizeof(double) * lens.size()) database->Fail(SQLITE_CORRUPT);
  std::memcpy(lens.data(), blob.data, blob.size);
  snapshot->lens = lens;
}

void ReadViews(sqlite::Database* database, std::vector<ViewState>* views) {
  sqlite::Statement row(database,
                        "SELECT photo, name, exposure_time_ns, qw, qx, qy, qz, tx, ty, tz "
                        "FROM views ORDER BY photo");
  while (row.Step()) {
    ViewState view;
    view.photo = PhotoAt(row, 0);
    view.name = row.Text(1);
    view.exposure_time.ns = row.Int(2);
    // Assigned, not constructed: normalising again could change the last bit.
    view.cam_from_map.rotation = {row.Double(3), row.Double(4), row.Double(5), row.Double(6)};
    view.cam_from_map.translation = {row.Double(7), row.Double(8), row.Double(9)};
    views->push_back(view);
  }
}

void ReadLandmarks(sqlite::Database* database, std::vector<LandmarkState>* landmarks) {
  sqlite::Statement row(database, "SELECT id, x, y, z, color FROM landmarks ORDER BY id");
  while (row.Step()) {
    LandmarkState landmark;
    landmark.id = LandmarkAt(row, 0);
    landmark.position_in_map = {row.Double(1), row.Double(2), row.Double(3)};
    const std::int64_t color = row.Int(4);
    landmark.color = {static_cast<std::uint8_t>(color >> 16 & 0xff),
                      static_cast<std::uint8_t>(color >> 8 & 0xff),
                      static_cast<std::uint8_t>(color & 0xff)};
    landmarks->push_back(landmark);
  }
}

void ReadObservations(sqlite::Database* database, std::vector<ObservationState>* observations) {
  sqlite::Statement row(database,
                        "SELECT landmark, photo, feature_idx, x_px, y_px FROM observations "
                        "ORDER BY landmark, photo");
  while (row.Step()) {
    ObservationState observation;
    observation.landmark = LandmarkAt(row, 0);
    observation.photo = PhotoAt(row, 1);
    observation.feature_idx = static_cast<std::uint32_t>(row.Int(2));
    observation.pixel = {static_cast<float>(row.Double(3)), static_cast<float>(row.Double(4))};
    observations->push_back(observation);
  }
}

}  // namespace

void ApplyDelta(sqlite::Database* database, const MapDelta& delta) {
  sqlite::Transaction transaction(database);
  if (delta.is_snapshot) {
    ClearMap(database);
  } else {
    const std::int64_t last = database->QueryInt("SELECT last_sequence FROM session").value_or(0);
    PLUMB_CHECK_EQ(std::int64_t{delta.sequence}, last + 1);
  }
  Remove(database, delta);
  SetViews(database, delta.views_set);
  SetLandmarks(database, delta.landmarks_set);
  AddObservations(database, delta.observations_added);
  if (delta.lens) SetLens(database, *delta.lens);
  database->Prepared("UPDATE session SET last_sequence = ?").Run(delta.sequence);
  transaction.Commit();
}

MapDelta ReadSnapshot(sqlite::Database* database) {
  const sqlite::ReadTransaction transaction(database);
  return ReadSnapshotInTransaction(database);
}

MapDelta ReadSnapshotInTransaction(sqlite::Database* database) {
  MapDelta snapshot;
  snapshot.is_snapshot = true;
  ReadSession(database, &snapshot);
  ReadViews(database, &snapshot.views_set);
  ReadLandmarks(database, &snapshot.landmarks_set);
  ReadObservations(database, &snapshot.observations_added);
  return snapshot;
}

}  // namespace plumb
