// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/occluders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "image/parallel_for.h"

namespace plumb::internal {
namespace {

constexpr int kPacketSize = 16;
constexpr unsigned kAllMasks = ~0U;
constexpr std::int32_t kRegionBlocks = 4;  // Along each axis.

// Up to sixteen rays of one block, with what the filter needs of them.
struct Cast {
  RTCIntersectContext context;  // First: the filter gets a pointer to it.
  const BlockId* block = nullptr;
  const SightLine* lines = nullptr;
  int num_lines = 0;
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
    const auto& corner = block.faces[face];
    const SightLine& line = cast.lines[lane];
    const bool is_itself = face == line.face && block.id == *cast.block;
    if (is_itself || !AreApart(*line.center_in_map,
                               *line.eye_in_map,
                               block.vertices[corner[0]].position_in_map,
                               block.vertices[corner[1]].position_in_map,
                               block.vertices[corner[2]].position_in_map)) {
      args->valid[i] = 0;
    }
  }
}

RTCScene NewScene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
  rtcCommitScene(scene);
  return scene;
}

EmbreeGeometry GeometryOf(const EmbreeDevice& device, const MeshBlock& block) {
  EmbreeTriangles triangles = NewTriangles(device, block.vertices.size(), block.faces.size());
  float* coordinate = triangles.vertices;
  for (const MeshVertex& vertex : block.vertices) {
    for (int k = 0; k < 3; ++k) *coordinate++ = static_cast<float>(vertex.position_in_map[k]);
  }
  unsigned* index = triangles.indices;
  for (const auto& face : block.faces) index = std::copy(face.begin(), face.end(), index);
  RTCGeometry geometry = triangles.geometry.get();
  rtcSetGeometryUserData(geometry, const_cast<MeshBlock*>(&block));
  rtcSetGeometryOccludedFilterFunction(geometry, &KeepTrueHits);
  rtcCommitGeometry(geometry);
  return std::move(triangles.geometry);
}

std::int32_t FloorDivide(std::int32_t index) {
  return index >= 0 ? index / kRegionBlocks : -1 - (-1 - index) / kRegionBlocks;
}

void Fill(const Cast& cast, std::array<int, kPacketSize>* valid, RTCRay16* rays) {
  for (int i = 0; i < kPacketSize; ++i) {
    (*valid)[static_cast<std::size_t>(i)] = i < cast.num_lines ? -1 : 0;
    const SightLine& line = cast.lines[std::min(i, cast.num_lines - 1)];
    const Eigen::Vector3d& from = *line.center_in_map;
    const Eigen::Vector3d direction = *line.eye_in_map - from;
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

Occluders::Occluders() : device_(StartEmbree("set_affinity=0")), scene_(NewScene(device_.get())) {}

Occluders::~Occluders() = default;

BlockId Occluders::RegionOf(const BlockId& block) {
  return {FloorDivide(block.x), FloorDivide(block.y), FloorDivide(block.z)};
}

Occluders::Region* Occluders::EnsureRegion(const BlockId& id) {
  Region& region = regions_[id];
  if (region.scene) return &region;
  region.scene.reset(NewScene(device_.get()));
  region.instance.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(region.instance.get(), region.scene.get());
  region.instance_id = rtcAttachGeometry(scene_.get(), region.instance.get());
  return &region;
}

void Occluders::Set(const std::vector<const MeshBlock*>& blocks, int num_threads) {
  std::vector<EmbreeGeometry> geometries(blocks.size());
  ParallelFor(num_threads, static_cast<int>(blocks.size()), 1, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (!blocks[i]->faces.empty()) geometries[i] = GeometryOf(device_, *blocks[i]);
    }
  });
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Remove(blocks[i]->id);
    if (geometries[i]) Attach(blocks[i]->id, geometries[i]);
  }
}

void Occluders::Attach(const BlockId& block, const EmbreeGeometry& geometry) {
  const BlockId id = RegionOf(block);
  Region* region = EnsureRegion(id);
  region->geometry_of_block[block] = rtcAttachGeometry(region->scene.get(), geometry.get());
  changed_regions_.insert(id);
}

void Occluders::Remove(const BlockId& id) {
  const BlockId region_id = RegionOf(id);
  const auto region = regions_.find(region_id);
  if (region == regions_.end()) return;
  const auto found = region->second.geometry_of_block.find(id);
  if (found == region->second.geometry_of_block.end()) return;
  rtcDetachGeometry(region->second.scene.get(), found->second);
  region->second.geometry_of_block.erase(found);
  changed_regions_.insert(region_id);
}

void Occluders::CommitRegion(const BlockId& id) const {
  const Region& region = regions_.at(id);
  if (!region.geometry_of_block.empty()) rtcCommitScene(region.scene.get());
}

void Occluders::Commit() {
  for (const BlockId& id : std::exchange(changed_regions_, {})) {
    Region& region = regions_.at(id);
    if (region.geometry_of_block.empty()) {
      rtcDetachGeometry(scene_.get(), region.instance_id);
      regions_.erase(id);
    } else {
      rtcCommitGeometry(region.instance.get());
    }
  }
  rtcCommitScene(scene_.get());
}

std::vector<char> Occluders::FindHidden(const MeshBlock& block,
                                        const std::vector<SightLine>& lines) const {
  std::vector<char> is_hidden(lines.size(), 0);
  Cast cast;
  cast.block = &block.id;
  for (std::size_t begin = 0; begin < lines.size(); begin += kPacketSize) {
    const std::size_t num = std::min<std::size_t>(kPacketSize, lines.size() - begin);
    cast.lines = &lines[begin];
    cast.num_lines = static_cast<int>(num);
    alignas(64) std::array<int, kPacketSize> valid;
    alignas(64) RTCRay16 rays;
    Fill(cast, &valid, &rays);
    rtcInitIntersectContext(&cast.context);
    cast.context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcOccluded16(valid.data(), scene_.get(), &cast.context, &rays);
    for (std::size_t i = 0; i < num; ++i) is_hidden[begin + i] = rays.tfar[i] < 0.0F ? 1 : 0;
  }
  return is_hidden;
}

}  // namespace plumb::internal
