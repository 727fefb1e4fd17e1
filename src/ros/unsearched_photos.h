// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Photo.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "ros/photo_intake.h"

namespace plumb::ros_adapter {

// Finds photos of a session that camera_ingest has taken up and nobody has answered. Not
// thread-safe.
class UnsearchedPhotos {
 public:
  explicit UnsearchedPhotos(std::string session_folder);

  // The first that is not known, as camera_ingest sends it; nothing if there is none. A photo that
  // cannot be read is passed over from then on. Throws std::runtime_error naming the file that
  // cannot be read or makes no sense.
  std::optional<plumbline::Photo> Next(const std::function<bool(std::uint32_t)>& is_known);

 private:
  void ReadLedger();
  plumbline::Photo Read(const TakenPhoto& photo, const Camera& camera) const;

  std::string session_folder_;
  std::uintmax_t ledger_size_ = 0;
  std::vector<TakenPhoto> photos_;
  std::set<std::uint32_t> unreadable_;
};

}  // namespace plumb::ros_adapter
