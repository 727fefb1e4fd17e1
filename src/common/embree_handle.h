// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <memory>
#include <new>
#include <stdexcept>
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

// With Embree's own words for its options; a number of threads among them binds all that TBB does
// in this program, OpenCV's loops too.
inline EmbreeDevice StartEmbree(const char* options) {
  EmbreeDevice device(rtcNewDevice(options));
  if (!device) throw std::runtime_error("cannot start Embree, which casts the rays");
  return device;
}

// Triangles whose buffers are still to be filled: three floats a vertex, three indices a triangle.
struct EmbreeTriangles {
  EmbreeGeometry geometry;
  float* vertices = nullptr;
  unsigned* indices = nullptr;
};

inline EmbreeTriangles NewTriangles(const EmbreeDevice& device,
                                    std::size_t num_vertices,
                                    std::size_t num_triangles) {
  EmbreeTriangles triangles;
  triangles.geometry.reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  triangles.vertices = static_cast<float*>(rtcSetNewGeometryBuffer(triangles.geometry.get(),
                                                                   RTC_BUFFER_TYPE_VERTEX,
                                                                   0,
                                                                   RTC_FORMAT_FLOAT3,
                                                                   3 * sizeof(float),
                                                                   num_vertices));
  triangles.indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(triangles.geometry.get(),
                                                                     RTC_BUFFER_TYPE_INDEX,
                                                                     0,
                                                                     RTC_FORMAT_UINT3,
                                                                     3 * sizeof(unsigned),
                                                                     num_triangles));
  if (triangles.vertices == nullptr || triangles.indices == nullptr) throw std::bad_alloc();
  return triangles;
}

}  // namespace plumb::internal
