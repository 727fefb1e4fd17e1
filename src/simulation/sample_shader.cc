// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/sample_shader.h"

#include <algorithm>
#include <cmath>

namespace plumb::internal {
namespace {

struct Footprint {
  int samples_per_axis;
  float pitch_px;  // Between the places.
};

void ShadeSky(const PhotoJob& job, const SampleGroup& group, SampleList* samples) {
  SkyJob sky{samples->Rays(group), {}, job.light.sky_irradiance, samples->Radiance(group)};
  const Eigen::Matrix3d world_from_cam = job.cam_from_world.rotation.conjugate().toRotationMatrix();
  for (int i = 0; i < 9; ++i) {
    sky.world_from_cam[i] = static_cast<float>(world_from_cam(i / 3, i % 3));
  }
  job.kernel.shade_sky(sky);
}

void LookUpAmbient(const PhotoJob& job,
                   const Patch& patch,
                   const SampleGroup& group,
                   SampleList* samples) {
  const AmbientMap& map = job.ambient_maps[patch.facet];
  const TextureList texture = samples->Texture(group);
  const int count = samples->Rays(group).count;
  for (int i = 0; i < count; ++i) {
    const AmbientMap::Value value = map.At(texture.u[i], texture.v[i]);
    samples->ambient()[group.begin + i] = value.seen;
    samples->run_off()[group.begin + i] = value.run_off;
  }
}

void ShadeFacet(const PhotoJob& job,
                const Patch& patch,
                const Footprint& footprint,
                const SampleGroup& group,
                SampleList* samples) {
  LookUpAmbient(job, patch, group, samples);
  const Material& material = job.materials[job.facets[patch.facet].material];
  const SurfaceShader shader = ShaderOf(patch, material, job.light, job.cam_from_world);
  job.kernel.shade({&shader,
                    samples->Rays(group),
                    samples->Texture(group),
                    samples->Light(group),
                    samples->Radiance(group),
                    footprint.samples_per_axis,
                    footprint.pitch_px});
}

// The mean of a plate's picture over a footprint, by exact means over its parts.
float PictureMean(const PictureIntegral& picture,
                  const TextureList& texture,
                  int i,
                  float side_m,
                  const Footprint& footprint) {
  const int n = footprint.samples_per_axis;
  const float scale = footprint.pitch_px / side_m;
  const float width = scale * (std::abs(texture.u_by_column[i]) + std::abs(texture.u_by_row[i]));
  const float height = scale * (std::abs(texture.v_by_column[i]) + std::abs(texture.v_by_row[i]));
  float sum = 0.0F;
  for (int k = 0; k < n * n; ++k) {
    const float column = scale * OffsetOf(k % n, n);
    const int row_index = k / n;
    const float row = scale * OffsetOf(row_index, n);
    sum += picture.Mean(
        texture.u[i] / side_m + column * texture.u_by_column[i] + row * texture.u_by_row[i],
        texture.v[i] / side_m + column * texture.v_by_column[i] + row * texture.v_by_row[i],
        width,
        height);
  }
  return sum / static_cast<float>(n * n);
}

void ShadePlate(const PhotoJob& job,
                const Patch& patch,
                const Footprint& footprint,
                const SampleGroup& group,
                SampleList* samples) {
  const PictureIntegral& picture = *job.pictures[patch.plate];
  const float side_m = job.plate_sides_m[patch.plate];
  const TextureList texture = samples->Texture(group);
  const LightList light = samples->Light(group);
  const ColorList radiance = samples->Radiance(group);
  const auto cosine = static_cast<float>(std::max(0.0, patch.normal.dot(job.light.towards_sun)));
  const std::array<float, 3> ambient = AmbientOn(job.light, patch.normal);
  for (int i = 0; i < group.count; ++i) {
    const float mean = PictureMean(picture, texture, i, side_m, footprint);
    const float sun = cosine * light.sun[i];
    radiance.red[i] = mean * (sun * job.light.sun[0] + ambient[0]);
    radiance.green[i] = mean * (sun * job.light.sun[1] + ambient[1]);
    radiance.blue[i] = mean * (sun * job.light.sun[2] + ambient[2]);
  }
}

}  // namespace

void ShadeSamples(const PhotoJob& job,
                  int samples_per_axis,
                  float footprint_px,
                  SampleList* samples) {
  const Footprint footprint{samples_per_axis, footprint_px / static_cast<float>(samples_per_axis)};
  for (const SampleGroup& group : samples->groups()) {
    if (group.patch == kSkyPatch) {
      ShadeSky(job, group, samples);
      continue;
    }
    const Patch& patch = job.patches.patches[group.patch];
    job.kernel.find_texture(
        ViewOf(patch, job.cam_from_world), samples->Rays(group), samples->Texture(group));
    if (patch.facet >= 0) {
      ShadeFacet(job, patch, footprint, group, samples);
    } else {
      ShadePlate(job, patch, footprint, group, samples);
    }
  }
}

}  // namespace plumb::internal
