// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/occluders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>

namespace plumb::internal {
namespace {

constexpr int kPacketSize = 16;
constexpr unsigned kAllMasks = ~0U;

// Sixteen rays to one eye, with what the filter needs of them.
struct Cast {
  RTCIntersectContext context;  // First: the filter gets a pointer to it.
  unsigned geometry = RTC_INVALID_GEOMETRY_ID;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  std::array<std::uint32_t, kPacketSize> faces = {};
  std::array<Eigen::Vector3d, kPacketSize> centers;
};

// Whether two points lie on different sides of a triangle's plane.
bool AreApart(const Eigen::Vector3d& from,
              const Eigen::Vector3d& to,
              const Eigen::Vector3d& a,
              const Eigen::Vector3d& b,
              const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  return normal.dot(from - a) * normal.dot(to - a) < 0.0;
}

// Embree asks it of each candidate: 0 passes the candidate by.
void KeepTrueHits(const RTCFilterFunctionNArguments* args) {
  const auto& cast = *reinterpret_cast<const Cast*>(args->context);
  const auto& block = *static_cast<const MeshBlock*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const unsigned lane = RTCRayN_id(args->ray, args->N, i);
    const unsigned face = RTCHitN_primID(args->hit, args->N, i);
    const unsigned geometry = RTCHitN_geomID(args->hit, args->N, i);
    const auto& corner = block.faces[face];
    const bool is_itself = geometry == cast.geometry && face == cast.faces[lane];
    if (is_itself || !AreApart(cast.centers[lane],
                               cast.eye,
                               block.vertices[corner[0]].position_in_map,
                               block.vertices[corner[1]].position_in_map,
                               block.vertices[corner[2]].position_in_map)) {
      args->valid[i] = 0;
    }
  }
}

RTCDevice NewDevice() {
  // A number of threads given here would bind all that TBB does in this program, OpenCV's too.
  RTCDevice device = rtcNewDevice("set_affinity=0");
  if (device == nullptr) throw std::runtime_error("cannot start Embree, which casts the rays");
  return device;
}

void Fill(const Cast& cast, int num_rays, std::array<int, kPacketSize>* valid, RTCRay16* rays) {
  for (int i = 0; i < kPacketSize; ++i) {
    (*valid)[static_cast<std::size_t>(i)] = i < num_rays ? -1 : 0;
    const Eigen::Vector3d& from = cast.centers[static_cast<std::size_t>(std::min(i, num_rays - 1))];
    const Eigen::Vector3d direction = cast.eye - from;
    rays->org_x[i] = static_cast<float>(from.x());
    rays->org_y[i] = static_cast<float>(from.y());
    rays->org_z[i] = static_cast<float>(from.z());
    rays->dir_x[i] = static_cast<float>(direction.x());
    rays->dir_y[i] = static_cast<float>(direction.y());
    rays->dir_z[i] = static_cast<float>(direction.z());
    rays->tnear[i] = 0.0F;
    rays->tfar[i] = 1.0F;
    rays->time[i] = 0.0F;
    rays->mask[i] = kAllMasks;
    rays->id[i] = static_cast<unsigned>(i);
    rays->flags[i] = 0;
  }
}

}  // namespace

Occluders::Occluders() : device_(NewDevice()), scene_(rtcNewScene(device_.get())) {
  rtcSetSceneFlags(scene_.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
  rtcCommitScene(scene_.get());
}

Occluders::~Occluders() = default;

void Occluders::Set(const MeshBlock& block) {
  Remove(block.id);
  if (block.faces.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry,
                                                               RTC_BUFFER_TYPE_VERTEX,
                                                               0,
                                                               RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float),
                                                               block.vertices.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry,
                                                                 RTC_BUFFER_TYPE_INDEX,
                                                                 0,
                                                                 RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned),
                                                                 block.faces.size()));
  if (vertices == nullptr || indices == nullptr) throw std::bad_alloc();
  for (const MeshVertex& vertex : block.vertices) {
    for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(vertex.position_in_map[k]);
  }
  for (const auto& face : block.faces) indices = std::copy(face.begin(), face.end(), indices);
  rtcSetGeometryUserData(geometry, const_cast<MeshBlock*>(&block));
  rtcSetGeometryOccludedFilterFunction(geometry, &KeepTrueHits);
  rtcCommitGeometry(geometry);
  geometry_of_block_[block.id] = rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
}

void Occluders::Remove(const BlockId& id) {
  const auto found = geometry_of_block_.find(id);
  if (found == geometry_of_block_.end()) return;
  rtcDetachGeometry(scene_.get(), found->second);
  geometry_of_block_.erase(found);
}

void Occluders::Commit() { rtcCommitScene(scene_.get()); }

void Occluders::FindHidden(const MeshBlock& block,
                           const std::vector<Eigen::Vector3d>& centers_in_map,
                           const std::vector<std::uint32_t>& face_idxs,
                           const Eigen::Vector3d& eye_in_map,
                           std::vector<char>* is_hidden) const {
  is_hidden->assign(face_idxs.size(), 0);
  Cast cast;
  cast.eye = eye_in_map;
  const auto found = geometry_of_block_.find(block.id);
  if (found != geometry_of_block_.end()) cast.geometry = found->second;
  for (std::size_t begin = 0; begin < face_idxs.size(); begin += kPacketSize) {
    const std::size_t num = std::min<std::size_t>(kPacketSize, face_idxs.size() - begin);
    for (std::size_t i = 0; i < num; ++i) {
      cast.faces[i] = face_idxs[begin + i];
      cast.centers[i] = centers_in_map[begin + i];
    }
    alignas(64) std::array<int, kPacketSize> valid;
    alignas(64) RTCRay16 rays;
    Fill(cast, static_cast<int>(num), &valid, &rays);
    rtcInitIntersectContext(&cast.context);
    cast.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid.data(), scene_.get(), &cast.context, &rays);
    for (std::size_t i = 0; i < num; ++i) (*is_hidden)[begin + i] = rays.tfar[i] < 0.0F ? 1 : 0;
  }
}

}  // namespace plumb::internal
