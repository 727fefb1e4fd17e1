// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/tile_tracer.h"

#include <algorithm>

#include "simulation/tile_lens.h"

namespace plumb::internal {
namespace {

constexpr int kPacketSide = 4;
static_assert(kTileStride % kPacketSide == 0);
static_assert(kPacketSide * kPacketSide == RayPacket::kSize);

// A shadow ray starts so far before the surface: above what float rounds 100 m away.
constexpr float kShadowOffset_m = 5e-4F;

constexpr std::array<int, 8> kNeighbours = {-kTileStride - 1,
                                            -kTileStride,
                                            -kTileStride + 1,
                                            -1,
                                            1,
                                            kTileStride - 1,
                                            kTileStride,
                                            kTileStride + 1};

// Ray `slot` of the packet in column `packet_column`, row `packet_row` of packets.
int RayIndex(int packet_column, int packet_row, int slot) {
  return (packet_row * kPacketSide + slot / kPacketSide) * kTileStride +
         packet_column * kPacketSide + slot % kPacketSide;
}

template <typename Function>
void ForEachPacket(const Function& function) {
  for (int row = 0; row < kTileStride / kPacketSide; ++row) {
    for (int column = 0; column < kTileStride / kPacketSide; ++column) function(column, row);
  }
}

}  // namespace

TileTracer::TileTracer(const PhotoJob& job)
    : job_(job),
      center_(job.cam_from_world.TargetOriginInSource().cast<float>()),
      world_from_cam_(job.cam_from_world.rotation.conjugate().toRotationMatrix().cast<float>()),
      towards_sun_(job.light.towards_sun.cast<float>()) {}

void TileTracer::Trace(int left, int top, int width, int height) {
  width_ = width;
  height_ = height;
  const TileLens lens(job_.camera, left, top, width, height);
  for (int row = 0; row < kTileStride; ++row) {
    lens.Row(left - 1, top - 1 + row, kTileStride, &rays_[row * kTileStride]);
  }
  CastPixels();
  CastShadows();
  Collect();
}

Eigen::Vector3f TileTracer::DirectionOf(const PixelRay& ray) const {
  return world_from_cam_.col(0) * ray.x + world_from_cam_.col(1) * ray.y + world_from_cam_.col(2);
}

void TileTracer::SetRay(int slot, const PixelRay& ray, RayPacket* packet) const {
  const Eigen::Vector3f direction = DirectionOf(ray);
  packet->valid[slot] = -1;
  packet->origin_x[slot] = center_.x();
  packet->origin_y[slot] = center_.y();
  packet->origin_z[slot] = center_.z();
  packet->direction_x[slot] = direction.x();
  packet->direction_y[slot] = direction.y();
  packet->direction_z[slot] = direction.z();
}

// Leaves the ray out where the patch turns away from the sun.
void TileTracer::SetShadowRay(int slot, int patch, const PixelRay& ray, RayPacket* packet) const {
  packet->valid[slot] = 0;
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  if (patch != kSkyPatch && job_.planes[patch].faces_sun) {
    const PlaneView& plane = job_.planes[patch];
    const Eigen::Vector3f direction = DirectionOf(ray);
    point = center_ + plane.depth / plane.normal.dot(direction) * direction +
            kShadowOffset_m * plane.normal;
    packet->valid[slot] = -1;
  }
  packet->origin_x[slot] = point.x();
  packet->origin_y[slot] = point.y();
  packet->origin_z[slot] = point.z();
  packet->direction_x[slot] = towards_sun_.x();
  packet->direction_y[slot] = towards_sun_.y();
  packet->direction_z[slot] = towards_sun_.z();
}

void TileTracer::CastPixels() {
  RayPacket packet;
  std::array<int, RayPacket::kSize> triangles;
  ForEachPacket([&](int column, int row) {
    if (column * kPacketSide > width_ + 1 || row * kPacketSide > height_ + 1) return;
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      SetRay(slot, rays_[RayIndex(column, row, slot)], &packet);
    }
    job_.scene.FirstHits(packet, &triangles);
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      patch_[RayIndex(column, row, slot)] =
          triangles[slot] < 0 ? kSkyPatch : job_.patches.patch_of_triangle[triangles[slot]];
    }
  });
}

void TileTracer::CastShadows() {
  RayPacket packet;
  std::array<bool, RayPacket::kSize> is_hidden;
  ForEachPacket([&](int column, int row) {
    if (column * kPacketSide > width_ + 1 || row * kPacketSide > height_ + 1) return;
    bool is_any_valid = false;
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      const int ray = RayIndex(column, row, slot);
      SetShadowRay(slot, patch_[ray], rays_[ray], &packet);
      is_any_valid |= packet.valid[slot] != 0;
    }
    is_hidden.fill(true);
    if (is_any_valid) job_.scene.AnyHits(packet, kUnlimited, &is_hidden);
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      is_lit_[RayIndex(column, row, slot)] = packet.valid[slot] != 0 && !is_hidden[slot];
    }
  });
}

bool TileTracer::IsEdge(int pixel) const {
  return std::any_of(kNeighbours.begin(), kNeighbours.end(), [&](int step) {
    return patch_[pixel + step] != patch_[pixel];
  });
}

bool TileTracer::IsShadowEdge(int pixel) const {
  return std::any_of(kNeighbours.begin(), kNeighbours.end(), [&](int step) {
    return is_lit_[pixel + step] != is_lit_[pixel];
  });
}

// The parts' places lie on a turned grid, no two in one column or row: an upright edge that
// wanders through a pixel then meets them one by one.
PixelRay TileTracer::PartOf(int pixel, int part) const {
  const int n = job_.samples_per_axis;
  const int i = part % n;
  const int j = part / n;
  const auto num_parts = static_cast<float>(n * n);
  const float column = (static_cast<float>(i * n + j) + 0.5F) / num_parts - 0.5F;
  const float row = (static_cast<float>(j * n + n - 1 - i) + 0.5F) / num_parts - 0.5F;
  PixelRay ray = rays_[pixel];
  ray.x += column * ray.x_by_column + row * ray.x_by_row;
  ray.y += column * ray.y_by_column + row * ray.y_by_row;
  return ray;
}

// The share of the pixel's parts, all of one patch, that see the sun.
float TileTracer::SunShare(int pixel) const {
  const int num_parts = job_.samples_per_axis * job_.samples_per_axis;
  int num_lit = 0;
  for (int first = 0; first < num_parts; first += RayPacket::kSize) {
    RayPacket packet;
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      const int part = std::min(first + slot, num_parts - 1);
      SetShadowRay(slot, patch_[pixel], PartOf(pixel, part), &packet);
      if (first + slot >= num_parts) packet.valid[slot] = 0;
    }
    std::array<bool, RayPacket::kSize> is_hidden;
    job_.scene.AnyHits(packet, kUnlimited, &is_hidden);
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      num_lit += packet.valid[slot] != 0 && !is_hidden[slot] ? 1 : 0;
    }
  }
  return static_cast<float>(num_lit) / static_cast<float>(num_parts);
}

void TileTracer::Collect() {
  whole_pixels_.clear();
  parts_.clear();
  const int num_parts = job_.samples_per_axis * job_.samples_per_axis;
  for (int row = 1; row <= height_; ++row) {
    for (int column = 1; column <= width_; ++column) {
      const int pixel = row * kTileStride + column;
      if (num_parts > 1 && IsEdge(pixel)) {
        for (int part = 0; part < num_parts; ++part) {
          parts_.push_back({pixel, kSkyPatch, PartOf(pixel, part), 0.0F});
        }
        continue;
      }
      const bool is_mixed = num_parts > 1 && IsShadowEdge(pixel);
      const float sun = is_mixed ? SunShare(pixel) : (is_lit_[pixel] ? 1.0F : 0.0F);
      whole_pixels_.push_back({pixel, patch_[pixel], rays_[pixel], sun});
    }
  }
  CastParts();
}

void TileTracer::CastParts() {
  RayPacket packet;
  std::array<int, RayPacket::kSize> triangles;
  std::array<bool, RayPacket::kSize> is_hidden;
  const int num_parts = static_cast<int>(parts_.size());
  for (int first = 0; first < num_parts; first += RayPacket::kSize) {
    const int count = std::min(RayPacket::kSize, num_parts - first);
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      SetRay(slot, parts_[first + std::min(slot, count - 1)].ray, &packet);
    }
    job_.scene.FirstHits(packet, &triangles);
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      Sample& part = parts_[first + std::min(slot, count - 1)];
      if (triangles[slot] >= 0) part.patch = job_.patches.patch_of_triangle[triangles[slot]];
      SetShadowRay(slot, part.patch, part.ray, &packet);
    }
    job_.scene.AnyHits(packet, kUnlimited, &is_hidden);
    for (int slot = 0; slot < count; ++slot) {
      parts_[first + slot].sun = packet.valid[slot] != 0 && !is_hidden[slot] ? 1.0F : 0.0F;
    }
  }
}

}  // namespace plumb::internal
