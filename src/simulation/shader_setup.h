// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "plumbline/geometry/rigid3.h"
#include "plumbline/simulation/renderer.h"
#include "simulation/patch.h"
#include "simulation/shade_job.h"

namespace plumb::internal {

// The light as the shading wants it.
struct Illumination {
  Eigen::Vector3d towards_sun;  // Unit length.
  std::array<float, 3> sun;     // Irradiance at normal incidence: R, G, B.
  std::array<float, 3> sky;     // On the level ground.
  std::array<float, 3> ground;  // What the ground throws back.
  float sky_irradiance;
};

// Throws std::invalid_argument if the direction is zero, a number not finite or negative.
Illumination IlluminationOf(const Light& light);

// Where the patch's texture lies for a camera.
PatchView ViewOf(const Patch& patch, const Rigid3& cam_from_world);

// The irradiance of sky and ground on a surface that nothing hides.
std::array<float, 3> AmbientOn(const Illumination& light, const Eigen::Vector3d& normal);

SurfaceShader ShaderOf(const Patch& patch,
                       const Material& material,
                       const Illumination& light,
                       const Rigid3& cam_from_world);

}  // namespace plumb::internal
