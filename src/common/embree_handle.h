// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace plumb::internal {

template <auto kRelease>
struct EmbreeReleaser {
  template <typename T>
  void operator()(T* handle) const {
    kRelease(handle);
  }
};

// Embree's devices, scenes and geometries count their users; these are one of them.
using EmbreeDevice =
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeReleaser<&rtcReleaseDevice>>;
using EmbreeScene =
    std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeReleaser<&rtcReleaseScene>>;
using EmbreeGeometry =
    std::unique_ptr<std::remove_pointer_t<RTCGeometry>, EmbreeReleaser<&rtcReleaseGeometry>>;

}  // namespace plumb::internal
