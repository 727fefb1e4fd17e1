// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/shader_setup.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumb::internal {
namespace {

using Vector3f = Eigen::Vector3f;

constexpr double kGroundReflectance = 0.22;

// A detail of this deviation has stains, streaks and cracks at full strength.
constexpr float kUsualDetail = 0.12F;

// Relief shows below this wavelength only: what is coarser is flat for the eye.
constexpr float kCoarsestRelief_m = 0.06F;
// Deviation of one octave's slope for the usual detail.
constexpr float kReliefOfOctave = 0.055F;
constexpr float kSlopeDeviation = 2.9F;  // NoiseSample::slope.

std::array<float, 3> ToArray(const Eigen::Vector3d& vector) {
  return {static_cast<float>(vector.x()),
          static_cast<float>(vector.y()),
          static_cast<float>(vector.z())};
}

// What an octave's lattice is laid out by.
struct OctaveFrame {
  Eigen::Vector2d sun;  // The sun's direction along (u, v).
  std::uint32_t seed;

  // Lattice of the given wavelengths along axes turned by `angle_rad` from u and v.
  Octave Make(int index, double along_u_m, double along_v_m, double angle_rad) const {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    Octave octave;
    octave.x_by_u = static_cast<float>(c / along_u_m);
    octave.x_by_v = static_cast<float>(s / along_u_m);
    octave.y_by_u = static_cast<float>(-s / along_v_m);
    octave.y_by_v = static_cast<float>(c / along_v_m);
    const double shorter_m = std::min(along_u_m, along_v_m);
    octave.wavelength_m = static_cast<float>(shorter_m);
    octave.sun_x = static_cast<float>(shorter_m * (c * sun.x() + s * sun.y()) / along_u_m);
    octave.sun_y = static_cast<float>(shorter_m * (-s * sun.x() + c * sun.y()) / along_v_m);
    octave.seed = seed + static_cast<std::uint32_t>(index) * 0x6C8E9CF5U;
    return octave;
  }
};

// Equal deviation in each octave: an amplitude spectrum of 1/f.
void SetOctaves(const Material& material, const OctaveFrame& frame, SurfaceShader* shader) {
  const double finest_m = std::max(1e-4F, material.finest_detail_m);
  for (double wavelength_m = material.coarsest_detail_m;
       wavelength_m >= 0.99 * finest_m && shader->num_octaves < kMaxOctaves;
       wavelength_m *= 0.5) {
    const int k = shader->num_octaves++;
    // Turned by the golden angle, so that no two lattices run alike.
    Octave& octave = shader->octaves[k];
    octave = frame.Make(k, wavelength_m, wavelength_m, 0.4 + 2.399963 * k);
    octave.relief = wavelength_m > kCoarsestRelief_m
                        ? 0.0F
                        : kReliefOfOctave * shader->strength / kSlopeDeviation;
  }
  const float share = 1.0F / std::sqrt(static_cast<float>(std::max(1, shader->num_octaves)));
  for (Octave& octave : shader->octaves) octave.tone = share * material.detail;
}

// Lattices of the blemishes; the wavelengths are those of weathered walls.
void SetBlemishes(const Material& material, const OctaveFrame& frame, SurfaceShader* shader) {
  shader->contrast = frame.Make(20, 0.6, 0.6, 0.7);
  shader->stain = frame.Make(21, 1.1, 1.6, 0.2);
  shader->streak = frame.Make(22, 0.035, 1.1, 0.0);
  shader->crack = frame.Make(23, 0.9, 0.9, 1.1);
  shader->crack_where = frame.Make(24, 2.3, 2.3, 0.5);
  shader->warp = frame.Make(25, 0.23, 0.23, 1.9);
  shader->trowel = frame.Make(26, 0.025, 0.16, 0.6);
  if (material.pattern == Pattern::kWood) {
    const bool is_along_u = material.element_m.x() > material.element_m.y();
    shader->trowel =
        is_along_u ? frame.Make(26, 0.25, 0.006, 0.0) : frame.Make(26, 0.006, 0.25, 0.0);
  }
  if (material.pattern == Pattern::kGlass) shader->trowel = frame.Make(26, 0.35, 0.5, 0.3);
  shader->trowel.tone = 0.25F * material.detail;
  shader->trowel.relief = kReliefOfOctave * shader->strength / kSlopeDeviation;
}

void SetLight(const Patch& patch, const Illumination& light, SurfaceShader* shader) {
  shader->sun_cosine = static_cast<float>(patch.normal.dot(light.towards_sun));
  shader->sun_u = static_cast<float>(patch.u_axis.dot(light.towards_sun));
  shader->sun_v = static_cast<float>(patch.v_axis.dot(light.towards_sun));
  shader->sun = light.sun;
  shader->ambient = AmbientOn(light, patch.normal);
  shader->sky = light.sky_irradiance;
  shader->height_by_u = static_cast<float>(patch.u_axis.z());
  shader->height_by_v = static_cast<float>(patch.v_axis.z());
  // On the plane, normal . point = offset; texture_origin need not lie on it.
  const Eigen::Vector3d foot =
      patch.texture_origin + (patch.offset - patch.normal.dot(patch.texture_origin)) * patch.normal;
  shader->height_m = static_cast<float>(foot.z());
}

void CheckLight(const Light& light) {
  const bool is_good = light.towards_sun_in_world.allFinite() &&
                       light.towards_sun_in_world.norm() > 0.0 &&
                       std::isfinite(light.sun_irradiance) && light.sun_irradiance >= 0.0 &&
                       std::isfinite(light.sky_irradiance) && light.sky_irradiance >= 0.0;
  if (is_good) return;
  throw std::invalid_argument(
      "the light needs a direction to the sun and irradiances of sun and sky of at least 0");
}

}  // namespace

Illumination IlluminationOf(const Light& light) {
  CheckLight(light);
  Illumination result;
  result.towards_sun = light.towards_sun_in_world.normalized();
  // Sunlight is warm, skylight blue; their mean over the channels is the given irradiance.
  result.sun = ToArray(light.sun_irradiance * Eigen::Vector3d(1.06, 1.0, 0.90));
  result.sky = ToArray(light.sky_irradiance * Eigen::Vector3d(0.90, 0.99, 1.13));
  const double on_ground =
      light.sun_irradiance * std::max(0.0, result.towards_sun.z()) + light.sky_irradiance;
  result.ground = ToArray(kGroundReflectance * on_ground * Eigen::Vector3d(1.05, 1.0, 0.92));
  result.sky_irradiance = static_cast<float>(light.sky_irradiance);
  return result;
}

PatchView ViewOf(const Patch& patch, const Rigid3& cam_from_world) {
  const Eigen::Vector3d center = cam_from_world.TargetOriginInSource();
  // point = center + depth / (n . X) * X with X = (x, y, 1): all in the camera's axes.
  const double depth = patch.offset - patch.normal.dot(center);
  const Eigen::Quaterniond& rotation = cam_from_world.rotation;
  PatchView view;
  view.n = ToArray(rotation * patch.normal);
  view.u = ToArray(depth * (rotation * patch.u_axis));
  view.v = ToArray(depth * (rotation * patch.v_axis));
  view.u0 = static_cast<float>(patch.u_axis.dot(center - patch.texture_origin));
  view.v0 = static_cast<float>(patch.v_axis.dot(center - patch.texture_origin));
  return view;
}

std::array<float, 3> AmbientOn(const Illumination& light, const Eigen::Vector3d& normal) {
  // Half spheres of sky above and ground below: their shares seen by a tilted plane.
  const auto sky_share = static_cast<float>(0.5 + 0.5 * normal.z());
  std::array<float, 3> ambient;
  for (int k = 0; k < 3; ++k) {
    ambient[k] = sky_share * light.sky[k] + (1.0F - sky_share) * light.ground[k];
  }
  return ambient;
}

SurfaceShader ShaderOf(const Patch& patch,
                       const Material& material,
                       const Illumination& light,
                       const Rigid3& cam_from_world) {
  SurfaceShader shader;
  shader.pattern = material.pattern;
  for (int k = 0; k < 3; ++k) shader.reflectance[k] = material.reflectance[k];
  shader.strength = std::min(material.detail / kUsualDetail, 2.0F);
  shader.element_m = {material.element_m.x(), material.element_m.y()};
  shader.joint_m = material.joint_m;
  shader.element_contrast = material.element_contrast;
  shader.specular = material.specular;
  shader.seed = patch.texture_seed;
  SetLight(patch, light, &shader);
  const OctaveFrame frame{
      {patch.u_axis.dot(light.towards_sun), patch.v_axis.dot(light.towards_sun)},
      patch.texture_seed};
  SetOctaves(material, frame, &shader);
  SetBlemishes(material, frame, &shader);

  Eigen::Matrix3d axes_from_world;
  axes_from_world << patch.u_axis.transpose(), patch.v_axis.transpose(), patch.normal.transpose();
  const Eigen::Matrix3d axes_from_cam =
      axes_from_world * cam_from_world.rotation.conjugate().toRotationMatrix();
  for (int i = 0; i < 9; ++i) {
    shader.axes_from_cam[i] = static_cast<float>(axes_from_cam(i / 3, i % 3));
  }
  shader.up_in_axes = ToArray(axes_from_world.col(2));
  return shader;
}

}  // namespace plumb::internal
