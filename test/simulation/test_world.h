// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/simulation/renderer.h"

namespace plumb::test {

// Collects rectangles into a world.
class WorldBuilder {
 public:
  std::uint32_t AddMaterial(const Material& material) {
    world_.materials.push_back(material);
    return static_cast<std::uint32_t>(world_.materials.size() - 1);
  }

  // A rectangle from `corner` along two perpendicular sides; outside is where they turn
  // anticlockwise. Returns its facet.
  Facet& AddRectangle(std::uint32_t material,
                      const Eigen::Vector3d& corner,
                      const Eigen::Vector3d& along_u,
                      const Eigen::Vector3d& along_v) {
    const auto first = static_cast<std::uint32_t>(world_.vertices_in_world.size());
    const auto facet = static_cast<std::uint32_t>(world_.facets.size());
    for (const Eigen::Vector3d& step :
         {Eigen::Vector3d(0, 0, 0), along_u, Eigen::Vector3d(along_u + along_v), along_v}) {
      world_.vertices_in_world.push_back(corner + step);
    }
    world_.triangles.push_back({{first, first + 1, first + 2}, facet});
    world_.triangles.push_back({{first, first + 2, first + 3}, facet});
    Facet added;
    added.origin_in_world = corner;
    added.u_axis = along_u.normalized();
    added.v_axis = along_v.normalized();
    added.material = material;
    world_.facets.push_back(added);
    return world_.facets.back();
  }

  // A box on or in the plane y = 0, without its back.
  void AddBox(std::uint32_t material, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const Eigen::Vector3d size = high - low;
    const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
    AddRectangle(material, low, x, z);
    AddRectangle(material, low + y, -y, z);
    AddRectangle(material, low + x, y, z);
    AddRectangle(material, low + z, x, y);
    AddRectangle(material, low + y, x, -y);
  }

  // Upright on the wall y = 0 or another plane, 2 mm before it.
  void AddPlate(const Rigid3& world_from_plate, double side_m, const std::string& picture) {
    Plate plate;
    plate.id = static_cast<int>(world_.plates.size());
    plate.world_from_plate = world_from_plate;
    plate.side_m = side_m;
    plate.picture = picture;
    world_.plates.push_back(plate);
  }

  World& world() { return world_; }

 private:
  World world_;
};

// The paper's camera: 16 megapixels, 16 mm on APS-C, with the distortion of such a lens.
inline Camera MakePaperCamera(double scale = 1.0) {
  const auto width = static_cast<int>(4912 * scale);
  const auto height = static_cast<int>(3264 * scale);
  const double focal_px = 3350.0 * scale;
  return Camera("paper",
                width,
                height,
                DistortionModel::kPlumbBob,
                {focal_px,
                 focal_px * 1.001,
                 0.5 * width + 11.0 * scale,
                 0.5 * height - 7.0 * scale,
                 -0.11,
                 0.09,
                 4e-4,
                 -3e-4,
                 -0.01});
}

// Upright and level, then turned: looks along +y, into the wall.
inline Rigid3 LookAtWall(const Eigen::Vector3d& center,
                         double yaw_rad = 0.0,
                         double pitch_rad = 0.0,
                         double roll_rad = 0.0) {
  Eigen::Matrix3d level;  // Rows: the camera's axes (right, down, forward) in the world.
  level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY());
  const Eigen::Quaterniond rotation = turn * Eigen::Quaterniond(level);
  return {rotation, -(rotation * center)};
}

}  // namespace plumb::test
