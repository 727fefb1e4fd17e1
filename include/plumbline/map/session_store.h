// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/ids.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/map/map_delta.h"
#include "plumbline/map/photo_folder.h"
#include "plumbline/map/photo_verdict.h"

namespace plumb {

// A photo as the session knows it.
struct StoredPhoto {
  PhotoId id;
  std::string name;         // In photos/.
  std::string source_name;  // As it came; differs where the name was taken or unsafe.
  std::uint64_t num_bytes = 0;
  std::optional<Timestamp> exposure_time;  // Once it was analysed.
  std::optional<PhotoAnalysis> analysis;   // Without the features; see LoadFeatures.
};

// The session folder: photos/ with the original photos, and session.db with what is known of
// them and of the map. Every call is one transaction: a process killed at any moment leaves
// all or nothing of it, a power cut at worst loses the last of them. One store writes a
// session at a time. Not thread-safe, but for photos().
//
// Every call throws std::runtime_error naming the file, the cause and the cure if the disk is full
// or refuses, or if the file is damaged; the session is then as before the call.
class SessionStore {
 public:
  // Opens the session in `folder`, or makes one. Refuses another camera than the session's, a newer
  // schema, what is not a session database, and a session another program writes.
  SessionStore(const std::string& folder, const Camera& camera);

  // Opens a session only to read it, even while it is being written, or from a medium that cannot
  // be written.
  static SessionStore OpenExisting(const std::string& folder);

  SessionStore(SessionStore&&) noexcept;
  ~SessionStore();

  const std::string& folder() const;
  const Camera& camera() const;  // As given when the session was made.
  PhotoFolder& photos();         // Thread-safe.

  // Greater than the id of every photo so far.
  PhotoId NextPhotoId() const;

  // Keeps the original bytes, then the row; returns the name in photos/. PhotoFolder::ClaimName
  // tells that name beforehand. `id` must be new.
  std::string SavePhoto(PhotoId id,
                        const std::string& name,
                        const std::vector<std::uint8_t>& bytes);

  // What was found in the photo, and the moment of its exposure that the mapper was told.
  void SaveAnalysis(PhotoId id, Timestamp exposure_time, const PhotoAnalysis& analysis);

  // Adds to the photo's history and is its latest verdict from now on. The inlier and
  // outlier pixels are not kept.
  void SaveVerdict(const PhotoVerdict& verdict);

  // Completes the photo's latest verdict.
  void SaveSeconds(PhotoId id, const StageSeconds& seconds);

  // The delta must follow the last one applied, or be a snapshot.
  void Apply(const MapDelta& delta);

  // The whole map under the number of the last delta applied.
  MapDelta Snapshot() const;

  // Keeps what a refinement changes in the map, beside the map itself, in place of the one before.
  // Precondition: `delta` follows the last delta applied.
  void SaveRefinement(const MapDelta& delta);
  void DropRefinement();
  bool HasRefinement() const;  // Also one of an earlier map.

  // The map as it was refined, under the number of the map it was made of; nothing if it was not
  // or has changed since.
  std::optional<MapDelta> RefinedSnapshot() const;

  std::vector<StoredPhoto> Photos() const;           // By id.
  std::vector<PhotoVerdict> LatestVerdicts() const;  // By photo.
  std::vector<PhotoVerdict> AllVerdicts() const;     // As they were given.
  FeatureSet LoadFeatures(PhotoId id) const;         // Empty if there are none.

 private:
  class Impl;
  explicit SessionStore(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
