// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/MarkerDetectionArray.h>

#include <memory>
#include <string>
#include <vector>

#include "map/sqlite.h"

namespace plumb::ros_adapter {

// The answers of marker_detector, in SESSION/markers.db: each is there whole or not at all,
// whatever is killed when. Those of a program whose messages were others are forgotten; the photos
// are there to be searched again. Not thread-safe.
class AnswerStore {
 public:
  // Makes folder and file if need be. Throws std::runtime_error naming the file, the cause and the
  // cure, as every call does.
  explicit AnswerStore(const std::string& session_folder);

  std::vector<plumbline::MarkerDetectionArray> Load();

  // Takes the place of an earlier answer to the same photo.
  void Save(const plumbline::MarkerDetectionArray& answer);

 private:
  std::unique_ptr<sqlite::Database> database_;
};

}  // namespace plumb::ros_adapter
