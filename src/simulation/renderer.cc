// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/renderer.h"

#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "image/parallel_for.h"
#include "plumbline/common/check.h"
#include "simulation/photo_job.h"
#include "simulation/tile_painter.h"

namespace plumb {

using internal::AmbientMap;
using internal::Illumination;
using internal::Patch;
using internal::PatchWorld;
using internal::PhotoJob;
using internal::PictureIntegral;
using internal::PlaneView;
using internal::RayScene;
using internal::TilePainter;

namespace {

constexpr double kEndsPulledIn_m = 1e-4;

// Tiles that one thread does in a row: enough to reuse its memory.
constexpr int kTilesPerPart = 16;

// A step without a common divisor with the number of tiles, so that threads with equal
// numbers of tiles have equal shares of sky and wall.
int StepThroughTiles(int num_tiles) {
  int step = static_cast<int>(0.618 * num_tiles) + 1;
  while (std::gcd(step, num_tiles) != 1) ++step;
  return step;
}

std::vector<PlaneView> ViewPlanes(const PatchWorld& world,
                                  const Rigid3& cam_from_world,
                                  const Illumination& light) {
  const Eigen::Vector3d center = cam_from_world.TargetOriginInSource();
  std::vector<PlaneView> planes;
  planes.reserve(world.patches.size());
  for (const Patch& patch : world.patches) {
    planes.push_back({patch.normal.cast<float>(),
                      static_cast<float>(patch.offset - patch.normal.dot(center)),
                      patch.normal.dot(light.towards_sun) > 0.0});
  }
  return planes;
}

}  // namespace

class Renderer::Impl {
 public:
  explicit Impl(const World& world)
      : patches(internal::CutIntoPatches(world)),
        scene(patches.triangles),
        facets(world.facets),
        materials(world.materials),
        ambient_maps(
            internal::BakeAmbientMaps(patches, scene, static_cast<int>(world.facets.size()))) {
    integrals.try_emplace("", nullptr);
    for (const PlatePicture& picture : world.pictures) {
      integrals.try_emplace(picture.name, &picture);
    }
    for (const Plate& plate : world.plates) {
      pictures.push_back(&integrals.at(plate.picture));
      plate_sides_m.push_back(static_cast<float>(plate.side_m));
    }
  }

  const PatchWorld patches;
  const RayScene scene;
  const std::vector<Facet> facets;
  const std::vector<Material> materials;
  const std::vector<AmbientMap> ambient_maps;
  std::map<std::string, PictureIntegral> integrals;
  std::vector<const PictureIntegral*> pictures;  // Of each plate.
  std::vector<float> plate_sides_m;
};

Renderer::Renderer(const World& world) : impl_(std::make_unique<Impl>(world)) {}

Renderer::~Renderer() = default;

cv::Mat Renderer::Render(const Camera& camera,
                         const Rigid3& cam_from_world,
                         const Light& light,
                         int samples_per_axis,
                         int num_threads) const {
  PLUMB_CHECK_GE(samples_per_axis, 1);
  PLUMB_CHECK(cam_from_world.Matrix().allFinite());
  const Illumination illumination = internal::IlluminationOf(light);
  const PhotoJob job{impl_->scene,
                     impl_->patches,
                     impl_->facets,
                     impl_->materials,
                     impl_->ambient_maps,
                     impl_->pictures,
                     impl_->plate_sides_m,
                     internal::ShadeKernelOf(DetectSimdLevel()),
                     camera,
                     cam_from_world,
                     illumination,
                     ViewPlanes(impl_->patches, cam_from_world, illumination),
                     samples_per_axis};
  cv::Mat photo(camera.height_px(), camera.width_px(), CV_32FC3);
  const int num_tiles = TilePainter::NumTiles(camera);
  const int step = StepThroughTiles(num_tiles);
  ParallelFor(num_threads, num_tiles, kTilesPerPart, [&](int begin, int end) {
    const auto painter = std::make_unique<TilePainter>(job);
    for (int i = begin; i < end; ++i) {
      painter->Paint(static_cast<int>(static_cast<std::int64_t>(i) * step % num_tiles), &photo);
    }
  });
  return photo;
}

std::optional<RayHit> Renderer::Cast(const Eigen::Vector3d& origin_in_world,
                                     const Eigen::Vector3d& direction_in_world) const {
  PLUMB_CHECK(origin_in_world.allFinite() && direction_in_world.allFinite());
  PLUMB_CHECK(!direction_in_world.isZero(0.0));
  const auto hit = impl_->scene.FirstHit(
      origin_in_world, direction_in_world, 0.0, std::numeric_limits<double>::infinity());
  if (!hit) return std::nullopt;
  const Patch& patch = impl_->patches.patches[impl_->patches.patch_of_triangle[hit->triangle]];
  RayHit result;
  result.point_in_world = origin_in_world + hit->along * direction_in_world;
  result.normal_in_world = patch.normal;
  result.distance_m = hit->along * direction_in_world.norm();
  result.plate = patch.plate;
  result.triangle = patch.plate < 0 ? hit->triangle : -1;
  return result;
}

bool Renderer::IsVisible(const Eigen::Vector3d& from_in_world,
                         const Eigen::Vector3d& to_in_world) const {
  PLUMB_CHECK(from_in_world.allFinite() && to_in_world.allFinite());
  const Eigen::Vector3d span = to_in_world - from_in_world;
  const double pulled_in = kEndsPulledIn_m / span.norm();
  if (!(pulled_in < 0.5)) return true;  // Nothing is left between the ends.
  return !impl_->scene.FirstHit(from_in_world, span, pulled_in, 1.0 - pulled_in);
}

}  // namespace plumb
