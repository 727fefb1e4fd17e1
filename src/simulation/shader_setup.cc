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

// Deviation of an octave of reflectance against the next coarser one. 1 would be an amplitude
// spectrum of 1/f; photos of walls fall a little faster (test/benchmark/renderer_benchmark.cc).
constexpr float kTonePersistence = 0.87F;

// Relief shows below this wavelength only: what is coarser is flat for the eye.
constexpr float kCoarsestRelief_m = 0.06F;
// Deviation of one octave's slope for the usual detail.
constexpr float kReliefOfOctave = 0.032F;
constexpr float kSlopeDeviation = 2.9F;  // NoiseSample::slope.

std::array<float, 3> ToArray(const Eigen::Vector3d& vector) {
  return {static_cast<float>(vector.x()),
          static_cast<float>(vector.y()),
          static_cast<float>(vector.z())};
}

constexpr int kNumTurns = kMaxOctaves + 8;

std::array<Eigen::Vector2d, kNumTurns> GoldenTurns() {
  std::array<Eigen::Vector2d, kNumTurns> turns;
  for (int i = 0; i < kNumTurns; ++i) turns[i] = {std::cos(2.399963 * i), std::sin(2.399963 * i)};
  return turns;
}

// What an octave's lattice is laid out by.
class OctaveFrame {
 public:
  // `sun`: its direction along (u, v).
  OctaveFrame(const Eigen::Vector2d& sun, std::uint32_t seed) : sun_(sun), seed_(seed) {}

  // Lattice of the given wavelengths along axes turned by `index` golden angles from u and
  // v, so that no two run alike.
  Octave Make(int index, double along_u_m, double along_v_m) const {
    static const std::array<Eigen::Vector2d, kNumTurns> kTurns = GoldenTurns();
    return Turned(kTurns[index], index, along_u_m, along_v_m);
  }

  // The same along u and v.
  Octave MakeStraight(int index, double along_u_m, double along_v_m) const {
    return Turned({1.0, 0.0}, index, along_u_m, along_v_m);
  }

 private:
  Octave Turned(const Eigen::Vector2d& turn, int index, double along_u_m, double along_v_m) const {
    const double c = turn.x();
    const double s = turn.y();
    Octave octave;
    octave.x_by_u = static_cast<float>(c / along_u_m);
    octave.x_by_v = static_cast<float>(s / along_u_m);
    octave.y_by_u = static_cast<float>(-s / along_v_m);
    octave.y_by_v = static_cast<float>(c / along_v_m);
    const double shorter_m = std::min(along_u_m, along_v_m);
    octave.wavelength_m = static_cast<float>(shorter_m);
    octave.sun_x = static_cast<float>(shorter_m * (c * sun_.x() + s * sun_.y()) / along_u_m);
    octave.sun_y = static_cast<float>(shorter_m * (-s * sun_.x() + c * sun_.y()) / along_v_m);
    octave.seed = seed_ + static_cast<std::uint32_t>(index) * 0x6C8E9CF5U;
    return octave;
  }

  Eigen::Vector2d sun_;
  std::uint32_t seed_;
};

void SetOctaves(const Material& material, const OctaveFrame& frame, SurfaceShader* shader) {
  float amplitude = 1.0F;
  float sum_of_squares = 0.0F;
  const double finest_m = std::max(1e-4F, material.finest_detail_m);
  for (double wavelength_m = material.coarsest_detail_m;
       wavelength_m >= 0.99 * finest_m && shader->num_octaves < kMaxOctaves;
       wavelength_m *= 0.5) {
    const int k = shader->num_octaves++;
    Octave& octave = shader->octaves[k];
    octave = frame.Make(k + 1, wavelength_m, wavelength_m);
    octave.relief = wavelength_m > kCoarsestRelief_m
                        ? 0.0F
                        : kReliefOfOctave * shader->strength / kSlopeDeviation;
    octave.tone = amplitude;
    sum_of_squares += amplitude * amplitude;
    amplitude *= kTonePersistence;
  }
  const float scale = material.detail / std::sqrt(std::max(sum_of_squares, 1e-9F));
  for (Octave& octave : shader->octaves) octave.tone *= scale;
}

// Lattices of the blemishes; the wavelengths are those of weathered walls.
void SetBlemishes(const Material& material, const OctaveFrame& frame, SurfaceShader* shader) {
  shader->contrast = frame.Make(kMaxOctaves + 1, 0.6, 0.6);
  shader->stain = frame.Make(kMaxOctaves + 2, 1.1, 1.6);
  shader->streak = frame.MakeStraight(kMaxOctaves + 3, 0.035, 1.1);
  shader->crack = frame.Make(kMaxOctaves + 4, 0.9, 0.9);
  shader->crack_where = frame.Make(kMaxOctaves + 5, 2.3, 2.3);
  shader->warp = frame.Make(kMaxOctaves + 6, 0.23, 0.23);
  shader->trowel = frame.Make(kMaxOctaves + 7, 0.025, 0.16);
  if (material.pattern == Pattern::kWood) {
    const bool is_along_u = material.element_m.x() > material.element_m.y();
    shader->trowel = is_along_u ? frame.MakeStraight(kMaxOctaves + 7, 0.25, 0.006)
                                : frame.MakeStraight(kMaxOctaves + 7, 0.006, 0.25);
  }
  if (material.pattern == Pattern::kGlass) shader->trowel = frame.Make(kMaxOctaves + 7, 0.35, 0.5);
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
  shader->is_level = std::abs(patch.normal.z()) > 0.7;
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
  shader.per_detail = material.detail > 0.0F ? 1.0F / material.detail : 0.0F;
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
