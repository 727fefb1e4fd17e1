// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "plumbline/common/timestamp.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/map/photo_folder.h"

namespace plumb::ros_adapter {

// A photo that cannot be read where the camera left it; others may well be.
struct UnreadablePhoto : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What the session knows of a photo it has taken up, beside its bytes.
struct TakenPhoto {
  std::uint32_t sequence = 0;
  std::string name;       // In the session's photos folder.
  std::string source;     // As the camera called it, with its sub-folders.
  Timestamp source_time;  // When the source was changed, for a file; else the stamp.
  Timestamp exposure_time;
  Timestamp received;
  std::optional<GeodeticPosition> position;
};

// What SESSION/photos.jsonl says, by sequence, even while it is being written: a last line that is
// not whole does not count. Nothing if there is no such file. Throws std::runtime_error naming the
// file if it cannot be read or a line makes no sense.
std::vector<TakenPhoto> ReadPhotoLedger(const std::string& session_folder);

// Keeps the original bytes of each photo in SESSION/photos and one line about it in
// SESSION/photos.jsonl, so that the numbering goes on after a restart and nothing is taken up
// twice. Thread-safe; one process a session.
class PhotoIntake {
 public:
  // Goes on with what the session holds; a last line cut by a crash is forgotten. Throws
  // std::runtime_error naming the file if a line makes no sense or nothing can be written.
  explicit PhotoIntake(const std::string& session_folder);

  // Takes up the photo `source` of a folder; nothing if it was taken up before, whole and
  // unchanged. Two of the same name in two sub-folders are two photos. The time of exposure is that
  // of EXIF, else the file's time of change.
  // Throws UnreadablePhoto naming the file, std::runtime_error if it cannot be kept.
  std::optional<TakenPhoto> TakeFile(const std::string& folder, const std::string& source);

  // The same from memory; `time` is that of the exposure.
  std::optional<TakenPhoto> TakeBytes(const std::string& source,
                                      Timestamp time,
                                      const std::vector<std::uint8_t>& bytes);

  // All that was ever taken up, by sequence.
  std::vector<TakenPhoto> photos() const;
  std::size_t num_photos() const;
  TakenPhoto photo(std::uint32_t sequence) const;

  // Throws std::runtime_error naming the file if it cannot be read.
  std::vector<std::uint8_t> ReadBytes(const TakenPhoto& photo) const;

 private:
  void ReadLedger();
  std::optional<TakenPhoto> Take(const std::string& source,
                                 Timestamp source_time,
                                 Timestamp exposure_time,
                                 const std::vector<std::uint8_t>& bytes);
  bool IsKnown(const std::string& source, Timestamp source_time) const;
  void Append(const TakenPhoto& photo);

  std::string ledger_path_;
  PhotoFolder folder_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, TakenPhoto> photos_;
  std::map<std::string, std::uint32_t> sequence_of_name_;
};

}  // namespace plumb::ros_adapter
