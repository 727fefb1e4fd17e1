// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/session_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "map/session_lock.h"
#include "map/session_map.h"
#include "map/session_photos.h"
#include "map/session_refinement.h"
#include "map/session_schema.h"
#include "map/sqlite.h"

namespace plumb {
namespace {

std::string DatabasePath(const std::string& folder) { return folder + "/session.db"; }

std::string ExistingDatabasePath(const std::string& folder) {
  std::error_code error;
  if (std::filesystem::is_regular_file(DatabasePath(folder), error)) return DatabasePath(folder);
  const auto type = std::filesystem::status(folder, error).type();
  const char* found = ": holds no session (no session.db)";
  if (type == std::filesystem::file_type::not_found) found = ": there is no such folder";
  if (type == std::filesystem::file_type::regular) found = ": is a file, not a session's folder";
  throw std::runtime_error(folder + found +
                           "; name the folder that was given to "
                           "`plumbline reconstruct` or to the launch file");
}

// Where the folder can be written, SQLite's own locks make readers and a writer get along, and
// leave nothing behind; where it cannot, the log of a session that lies at rest is not missed.
sqlite::Access ReadAccess(const std::string& folder) {
  if (::faccessat(AT_FDCWD, folder.c_str(), W_OK, AT_EACCESS) == 0) return sqlite::Access::kRead;
  std::error_code error;  // Of an absent log.
  const std::uintmax_t log_bytes = std::filesystem::file_size(DatabasePath(folder) + "-wal", error);
  const bool has_log = !error && log_bytes > 0;
  return has_log ? sqlite::Access::kReadProtected : sqlite::Access::kReadFrozen;
}

// NORMAL: a commit waits for no disk; a killed process loses nothing, a power cut at
// worst the last commits. 64 MB of cache keep the map's tables in memory.
constexpr char kConnectionSettings[] =
    "PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON; PRAGMA cache_size = -64000";

}  // namespace

class SessionStore::Impl {
 public:
  Impl(const std::string& folder, const Camera& camera)
      : folder_(folder),
        photos_(folder + "/photos"),
        lock_(folder),
        database_(DatabasePath(folder), sqlite::Access::kWrite),
        camera_(camera) {
    PrepareSession(&database_, camera);
    photos_.Prepare();
    database_.Execute(kConnectionSettings);
  }

  explicit Impl(const std::string& folder)
      : folder_(folder),
        photos_(folder + "/photos"),
        database_(ExistingDatabasePath(folder), ReadAccess(folder)),
        camera_(ReadSessionCamera(&database_)) {
    database_.Execute(kConnectionSettings);
  }

  std::string folder_;
  PhotoFolder photos_;
  std::optional<SessionLock> lock_;
  sqlite::Database database_;
  Camera camera_;
};

SessionStore::SessionStore(const std::string& folder, const Camera& camera)
    : impl_(std::make_unique<Impl>(folder, camera)) {}

SessionStore::SessionStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SessionStore::SessionStore(SessionStore&&) noexcept = default;
SessionStore::~SessionStore() = default;

SessionStore SessionStore::OpenExisting(const std::string& folder) {
  return SessionStore(std::make_unique<Impl>(folder));
}

const std::string& SessionStore::folder() const { return impl_->folder_; }
const Camera& SessionStore::camera() const { return impl_->camera_; }
PhotoFolder& SessionStore::photos() { return impl_->photos_; }

PhotoId SessionStore::NextPhotoId() const {
  const std::int64_t last = impl_->database_.QueryInt("SELECT max(id) FROM photos").value_or(-1);
  return {static_cast<std::uint32_t>(last + 1)};
}

std::string SessionStore::SavePhoto(PhotoId id,
                                    const std::string& name,
                                    const std::vector<std::uint8_t>& bytes) {
  const std::string stored_name = impl_->photos_.Save(name, bytes);
  impl_->database_
      .Prepared("INSERT INTO photos (id, name, source_name, num_bytes) VALUES (?, ?, ?, ?)")
      .Run(id.value, stored_name, name, std::uint64_t{bytes.size()});
  return stored_name;
}

void SessionStore::SaveAnalysis(PhotoId id,
                                Timestamp exposure_time,
                                const PhotoAnalysis& analysis) {
  sqlite::Transaction transaction(&impl_->database_);
  WriteAnalysis(&impl_->database_, id, exposure_time, analysis);
  WriteFeatures(&impl_->database_, id, analysis.features);
  transaction.Commit();
}

void SessionStore::SaveVerdict(const PhotoVerdict& verdict) {
  WriteVerdict(&impl_->database_, verdict);
}

void SessionStore::SaveSeconds(PhotoId id, const StageSeconds& seconds) {
  WriteSeconds(&impl_->database_, id, seconds);
}

void SessionStore::Apply(const MapDelta& delta) { ApplyDelta(&impl_->database_, delta); }
MapDelta SessionStore::Snapshot() const { return ReadSnapshot(&impl_->database_); }

void SessionStore::SaveRefinement(const MapDelta& delta) {
  WriteRefinement(&impl_->database_, delta);
}

void SessionStore::DropRefinement() { DeleteRefinement(&impl_->database_); }

bool SessionStore::HasRefinement() const { return plumb::HasRefinement(&impl_->database_); }

std::optional<MapDelta> SessionStore::RefinedSnapshot() const {
  return ReadRefinedSnapshot(&impl_->database_);
}

std::vector<StoredPhoto> SessionStore::Photos() const { return ReadPhotos(&impl_->database_); }

std::vector<PhotoVerdict> SessionStore::LatestVerdicts() const {
  return ReadVerdicts(&impl_->database_, "latest_verdicts", "photo");
}

std::vector<PhotoVerdict> SessionStore::AllVerdicts() const {
  return ReadVerdicts(&impl_->database_, "verdicts", "id");
}

FeatureSet SessionStore::LoadFeatures(PhotoId id) const {
  return ReadFeatures(&impl_->database_, id);
}

}  // namespace plumb
