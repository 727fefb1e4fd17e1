// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "map/session_schema.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace plumb {
namespace {

// Grows whenever a table changes its meaning; kept in SQLite's user_version.
constexpr int kSchemaVersion = 1;

constexpr int kApplicationId = 0x504c4d42;  // "PLMB", in the database's header.

// Blobs are little-endian and packed. Observations are clustered by landmark: that is how
// they are removed, and one tree costs half of two.
constexpr char kSchema[] = R"sql(
CREATE TABLE session (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  camera_yaml TEXT NOT NULL,         -- ROS camera_info, as given when the session was made.
  last_sequence INTEGER NOT NULL,    -- Of the last MapDelta applied.
  lens BLOB                          -- fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6 as float64, if refined.
);
CREATE TABLE photos (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,                -- File in photos/.
  source_name TEXT NOT NULL,
  num_bytes INTEGER NOT NULL,
  exposure_time_ns INTEGER,          -- Since the epoch, UTC; from here on null until analysed.
  status TEXT,
  detail TEXT,
  content_hash INTEGER,
  width_px INTEGER,
  height_px INTEGER,
  exif_orientation INTEGER,
  focal_length_mm REAL,
  exif_time_ns INTEGER,
  lat_deg REAL,
  lon_deg REAL,
  alt_m REAL,
  blur_px REAL,
  decode_s REAL,
  features_s REAL
);
CREATE TABLE verdicts (
  id INTEGER PRIMARY KEY AUTOINCREMENT,  -- In the order they were given.
  photo INTEGER NOT NULL REFERENCES photos (id),
  attempt INTEGER NOT NULL,
  status TEXT NOT NULL,
  reason TEXT NOT NULL,
  hint TEXT NOT NULL,
  num_matches INTEGER NOT NULL,
  num_inliers INTEGER NOT NULL,
  median_error_px REAL NOT NULL,
  decode_s REAL NOT NULL,
  features_s REAL NOT NULL,
  retrieval_s REAL NOT NULL,
  matching_s REAL NOT NULL,
  pose_s REAL NOT NULL,
  verdict_s REAL NOT NULL,
  expand_s REAL NOT NULL,
  bundle_s REAL NOT NULL
);
CREATE INDEX verdicts_by_photo ON verdicts (photo, id);
CREATE VIEW latest_verdicts AS
  SELECT * FROM verdicts WHERE id IN (SELECT max(id) FROM verdicts GROUP BY photo);
CREATE TABLE features (
  photo INTEGER PRIMARY KEY REFERENCES photos (id),
  num_features INTEGER NOT NULL,
  keypoints BLOB NOT NULL,           -- x_px y_px scale_px orientation_rad as float32.
  descriptors BLOB NOT NULL,         -- 128 bytes each.
  colors BLOB NOT NULL               -- r g b bytes.
);
CREATE TABLE views (
  photo INTEGER PRIMARY KEY REFERENCES photos (id),
  name TEXT NOT NULL,
  exposure_time_ns INTEGER NOT NULL,
  qw REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL,  -- cam_from_map.
  tx REAL NOT NULL, ty REAL NOT NULL, tz REAL NOT NULL
);
CREATE TABLE landmarks (
  id INTEGER PRIMARY KEY,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,  -- In the map.
  color INTEGER NOT NULL             -- r * 65536 + g * 256 + b.
);
CREATE TABLE observations (
  landmark INTEGER NOT NULL REFERENCES landmarks (id) ON DELETE CASCADE,
  photo INTEGER NOT NULL REFERENCES views (photo) ON DELETE CASCADE,
  feature_idx INTEGER NOT NULL,
  x_px REAL NOT NULL, y_px REAL NOT NULL,
  PRIMARY KEY (landmark, photo, feature_idx)
) WITHOUT ROWID;
)sql";

void CheckIsSession(sqlite::Database* database) {
  if (database->QueryInt("PRAGMA application_id") != kApplicationId) {
    throw std::runtime_error(database->path() +
                             ": is not a Plumbline session; move the file away or choose another "
                             "session folder");
  }
  const std::int64_t version = database->QueryInt("PRAGMA user_version").value_or(0);
  if (version != kSchemaVersion) {
    throw std::runtime_error(
        database->path() + ": has session schema " + std::to_string(version) +
        ", this program knows " + std::to_string(kSchemaVersion) +
        "; use the Plumbline that made the session or choose another session folder");
  }
}

bool IsEmpty(sqlite::Database* database) {
  return database->QueryInt("SELECT count(*) FROM sqlite_master") == 0;
}

void CheckIsSameCamera(const std::string& path, const Camera& stored, const Camera& given) {
  std::ostringstream difference;
  difference.precision(12);
  const auto compare = [&](const char* what, double of_session, double now) {
    if (of_session == now || difference.tellp() > 0) return;
    difference << what << ' ' << of_session << ", now " << now;
  };
  static constexpr const char* kLensNames[kNumLensParameters] = {
      "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  compare("width", stored.width_px(), given.width_px());
  compare("height", stored.height_px(), given.height_px());
  for (int i = 0; i < kNumLensParameters; ++i) {
    compare(kLensNames[i],
            stored.lens()[static_cast<std::size_t>(i)],
            given.lens()[static_cast<std::size_t>(i)]);
  }
  if (difference.tellp() == 0) return;
  throw std::runtime_error(
      path + ": the session was made with another camera (" + difference.str() +
      "); use the camera file it was made with or, if that one was wrong, another "
      "session folder");
}

void CreateTables(sqlite::Database* database, const Camera& camera) {
  // Feature blobs fill pages of 16 KiB better than the default 4 KiB.
  database->Execute("PRAGMA page_size = 16384; PRAGMA journal_mode = WAL");
  sqlite::Transaction transaction(database);
  database->Execute("PRAGMA application_id = " + std::to_string(kApplicationId) +
                    "; PRAGMA user_version = " + std::to_string(kSchemaVersion));
  database->Execute(kSchema);
  sqlite::Statement(database,
                    "INSERT INTO session (id, camera_yaml, last_sequence) VALUES (1, ?, 0)")
      .Run(ToCameraYaml(camera));
  transaction.Commit();
}

}  // namespace

void PrepareSession(sqlite::Database* database, const Camera& camera) {
  if (IsEmpty(database)) CreateTables(database, camera);
  CheckIsSameCamera(database->path(), ReadSessionCamera(database), camera);
}

Camera ReadSessionCamera(sqlite::Database* database) {
  CheckIsSession(database);
  sqlite::Statement statement(database, "SELECT camera_yaml FROM session");
  if (!statement.Step()) database->Fail(SQLITE_CORRUPT);
  return ParseCameraYaml(statement.Text(0), database->path());
}

}  // namespace plumb
