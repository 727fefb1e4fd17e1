// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/clearance.h"

#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>

namespace plumb {
namespace {

// A small MAV's radius with its propellers, and a hand's breadth.
constexpr double kSmallestClearance_m = 0.4;

// Looks around in the 26 directions of a cube's faces, edges and corners: whoever is
// inside sees a surface from behind.
std::string FaultAt(const Renderer& renderer, const Eigen::Vector3d& center_in_world) {
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i steps(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const Eigen::Vector3d direction = steps.cast<double>();
    if (direction.isZero()) continue;
    const std::optional<RayHit> hit = renderer.Cast(center_in_world, direction);
    if (!hit) continue;
    if (hit->normal_in_world.dot(direction) > 0.0) return "inside the building or the ground";
    if (hit->distance_m < kSmallestClearance_m)
      return "nearer than 0.4 m to the building or ground";
  }
  return {};
}

}  // namespace

void CheckClearance(const Renderer& renderer, const std::vector<PlannedPhoto>& photos) {
  for (const PlannedPhoto& photo : photos) {
    const Eigen::Vector3d center = photo.cam_from_world.TargetOriginInSource();
    const std::string fault = FaultAt(renderer, center);
    if (fault.empty()) continue;
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << "flight: the camera of photo " << photo.name
         << " at (" << center.x() << ", " << center.y() << ", " << center.z() << ") m is " << fault
         << "; raise its leg's distance_m or z_min_m, or lower the pilot's drift_m";
    throw std::invalid_argument(text.str());
  }
}

}  // namespace plumb
