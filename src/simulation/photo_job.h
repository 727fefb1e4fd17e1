// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/simulation/world.h"
#include "simulation/ambient_map.h"
#include "simulation/patch.h"
#include "simulation/picture_integral.h"
#include "simulation/ray_scene.h"
#include "simulation/shade_kernel.h"
#include "simulation/shader_setup.h"

namespace plumb::internal {

// A patch's plane as rays from the camera meet it: at center + depth / (normal . d) d along d.
struct PlaneView {
  Eigen::Vector3f normal;
  float depth;
  bool faces_sun;
};

// All that a photo of a world depends on. Holds references.
struct PhotoJob {
  const RayScene& scene;
  const PatchWorld& patches;
  const std::vector<Facet>& facets;
  const std::vector<Material>& materials;
  const std::vector<AmbientMap>& ambient_maps;          // Of each facet.
  const std::vector<const PictureIntegral*>& pictures;  // Of each plate.
  const std::vector<float>& plate_sides_m;
  const ShadeKernel& kernel;
  const Camera& camera;
  Rigid3 cam_from_world;
  Illumination light;
  std::vector<PlaneView> planes;  // Of each patch.
  int samples_per_axis;
};

}  // namespace plumb::internal
