// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/ray_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace plumb::internal {
namespace {

constexpr unsigned kNoMask = ~0U;

void CopyRays(const RayPacket& packet, float max_along, RTCRay16* rays) {
  for (int i = 0; i < RayPacket::kSize; ++i) {
    rays->org_x[i] = packet.origin_x[i];
    rays->org_y[i] = packet.origin_y[i];
    rays->org_z[i] = packet.origin_z[i];
    rays->dir_x[i] = packet.direction_x[i];
    rays->dir_y[i] = packet.direction_y[i];
    rays->dir_z[i] = packet.direction_z[i];
    rays->tnear[i] = 0.0F;
    rays->tfar[i] = max_along;
    rays->time[i] = 0.0F;
    rays->mask[i] = kNoMask;
    rays->flags[i] = 0;
  }
}

RTCIntersectContext ContextOf(const RayPacket& packet) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = packet.is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

}  // namespace

// One thread builds the tree, so that it is the same every time.
RayScene::RayScene(std::vector<Triangle3> triangles)
    : triangles_(std::move(triangles)),
      device_(StartEmbree("threads=1,set_affinity=0")),
      scene_(rtcNewScene(device_.get())) {
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);  // No ray slips through an edge.
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  if (!triangles_.empty()) AddTriangles();
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree cannot hold the world's triangles: not enough memory");
  }
}

void RayScene::AddTriangles() {
  const EmbreeTriangles all = NewTriangles(device_, 3 * triangles_.size(), triangles_.size());
  float* coordinate = all.vertices;
  unsigned index = 0;
  for (const Triangle3& triangle : triangles_) {
    for (const Eigen::Vector3d& vertex : triangle) {
      for (int k = 0; k < 3; ++k) *coordinate++ = static_cast<float>(vertex[k]);
      all.indices[index] = index;
      ++index;
      scene_radius_ = std::max(scene_radius_, vertex.norm());
    }
  }
  rtcCommitGeometry(all.geometry.get());
  rtcAttachGeometry(scene_.get(), all.geometry.get());
}

void RayScene::FirstHits(const RayPacket& packet,
                         std::array<int, RayPacket::kSize>* triangles) const {
  alignas(64) RTCRayHit16 rays;
  CopyRays(packet, kUnlimited, &rays.ray);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context = ContextOf(packet);
  rtcIntersect16(packet.valid.data(), scene_.get(), &context, &rays);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const bool is_hit = rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    (*triangles)[i] = is_hit ? static_cast<int>(rays.hit.primID[i]) : -1;
  }
}

void RayScene::AnyHits(const RayPacket& packet,
                       float max_along,
                       std::array<bool, RayPacket::kSize>* hits) const {
  alignas(64) RTCRay16 rays;
  CopyRays(packet, max_along, &rays);
  RTCIntersectContext context = ContextOf(packet);
  rtcOccluded16(packet.valid.data(), scene_.get(), &context, &rays);
  for (int i = 0; i < RayPacket::kSize; ++i) (*hits)[i] = rays.tfar[i] < 0.0F;
}

double RayScene::PlaneDistance(int triangle,
                               const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction) const {
  const Triangle3& corners = triangles_[triangle];
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  return normal.dot(corners[0] - origin) / normal.dot(direction);
}

std::optional<TriangleHit> RayScene::FirstHit(const Eigen::Vector3d& origin,
                                              const Eigen::Vector3d& direction,
                                              double min_along,
                                              double max_along) const {
  // A start far outside would lose its digits in float: begin where the scene may begin.
  const double length = direction.norm();
  const Eigen::Vector3d unit = direction / length;
  const double skipped =
      std::max({min_along * length, -origin.dot(unit) - 2.0 * scene_radius_, 0.0});
  const Eigen::Vector3d start = origin + skipped * unit;
  const double end = max_along * length - skipped;

  // Embree's float distance decides the order only; what it finds outside the bounds in double
  // (a wall that a segment ends on, seen at a grazing angle) is passed by.
  float near = 0.0F;
  while (near <= end) {
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(start.x());
    ray.ray.org_y = static_cast<float>(start.y());
    ray.ray.org_z = static_cast<float>(start.z());
    ray.ray.dir_x = static_cast<float>(unit.x());
    ray.ray.dir_y = static_cast<float>(unit.y());
    ray.ray.dir_z = static_cast<float>(unit.z());
    ray.ray.tnear = near;
    ray.ray.tfar = kUnlimited;
    ray.ray.mask = kNoMask;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const int triangle = static_cast<int>(ray.hit.primID);
    const double along = (skipped + PlaneDistance(triangle, start, unit)) / length;
    if (along >= min_along && along <= max_along) return TriangleHit{triangle, along};
    near = std::nextafter(std::max(ray.ray.tfar, near), kUnlimited);
  }
  return std::nullopt;
}

}  // namespace plumb::internal
