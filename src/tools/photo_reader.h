// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/common/stage.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/map/session_store.h"

namespace plumb::tools {

// A file to take.
struct PhotoTask {
  std::string path;
  std::string source_name;           // With its sub-folders.
  std::optional<PhotoId> stored_id;  // If the session holds it already, unfinished.
};

// A file that was read and analysed.
struct ReadPhoto {
  PhotoTask task;
  std::optional<PhotoId> known_as;  // What the session took it as; nothing else is filled in then.
  std::string trouble;              // Why it could not be read; nothing else is filled in then.
  std::string name;                 // In the session's photos/.
  std::shared_ptr<const std::vector<std::uint8_t>> bytes;
  PhotoAnalysis analysis;
  Stopwatch since_first_byte;
};

// Recognises the files that a session has taken already, by name without folders and content.
// Thread-safe: immutable.
class KnownPhotos {
 public:
  explicit KnownPhotos(SessionStore* store);
  std::optional<PhotoId> Find(const std::string& source_name, std::uint64_t content_hash) const;

 private:
  std::map<std::pair<std::string, std::uint64_t>, PhotoId> photos_;
};

// Reads and analyses one file after the other in a thread of its own.
class PhotoReader {
 public:
  // `photos` and `known` must outlive this.
  PhotoReader(const FeatureOptions& options,
              int width_px,
              int height_px,
              PhotoFolder* photos,
              const KnownPhotos* known);

  // A file of the session that cannot be read becomes an undecodable photo that says why.
  std::future<ReadPhoto> Start(const PhotoTask& task);

 private:
  ReadPhoto Read(const PhotoTask& task) const;

  FeatureOptions options_;
  int width_px_;
  int height_px_;
  PhotoFolder* photos_;
  const KnownPhotos* known_;
  Stage<std::packaged_task<ReadPhoto()>> stage_;
};

}  // namespace plumb::tools
