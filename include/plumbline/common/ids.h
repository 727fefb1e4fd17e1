// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

namespace plumb {

// An integer that names one thing of one kind; ids of different kinds do not
// mix. A default-constructed id is invalid.
template <typename Tag>
struct Id {
  static constexpr std::uint32_t kInvalid = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t value = kInvalid;

  bool IsValid() const { return value != kInvalid; }
  friend bool operator==(Id a, Id b) { return a.value == b.value; }
  friend bool operator!=(Id a, Id b) { return a.value != b.value; }
  friend bool operator<(Id a, Id b) { return a.value < b.value; }
};

// A photo of the session, in the order of arrival. A photo that was located
// becomes a view of the map and keeps its id.
using PhotoId = Id<struct PhotoTag>;

// A landmark of the map. Never used again after the landmark is gone.
using LandmarkId = Id<struct LandmarkTag>;

}  // namespace plumb

template <typename Tag>
struct std::hash<plumb::Id<Tag>> {
  std::size_t operator()(plumb::Id<Tag> id) const noexcept {
    return std::hash<std::uint32_t>{}(id.value);
  }
};
