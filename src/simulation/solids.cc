// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/solids.h"

#include <Eigen/Geometry>
#include <cmath>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

// The mitred left normals of a plane path: left of each corner's two directions.
std::vector<Vector2d> LeftNormals(const std::vector<Vector2d>& path, bool is_loop) {
  const std::size_t size = path.size();
  PLUMB_CHECK_GE(size, std::size_t{2});
  const auto left_of = [&](std::size_t from) {
    const Vector2d direction = (path[(from + 1) % size] - path[from]).normalized();
    return Vector2d(-direction.y(), direction.x());
  };
  std::vector<Vector2d> normals;
  for (std::size_t i = 0; i < size; ++i) {
    const bool has_before = is_loop || i > 0;
    const bool has_after = is_loop || i + 1 < size;
    const Vector2d before = left_of(has_before ? (i + size - 1) % size : i);
    const Vector2d after = has_after ? left_of(i) : before;
    normals.push_back((before + after) / (1.0 + before.dot(after)));
  }
  return normals;
}

Vector3d At(const SweepSection& section, const Vector2d& profile_point) {
  return section.origin + section.across * profile_point.x() + section.out * profile_point.y();
}

// One end, in strips between the profile and its back line: exact since `across` never falls.
void AddCap(MeshBuilder& builder,
            const Profile& profile,
            const SweepSection& section,
            bool is_start,
            std::uint32_t material) {
  const double back = profile.front().y();
  for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
    std::vector<Vector3d> corners = {At(section, {profile[j].x(), back}),
                                     At(section, profile[j]),
                                     At(section, profile[j + 1]),
                                     At(section, {profile[j + 1].x(), back})};
    if (!is_start) std::reverse(corners.begin(), corners.end());
    builder.AddPolygon(corners, material);
  }
}

// The strips between two sections; `along_m` is the length of the path before them.
void AddSpan(MeshBuilder& builder,
             const Profile& profile,
             const SweepSection& from,
             const SweepSection& to,
             double along_m,
             std::uint32_t material) {
  const Vector3d u_axis = (to.origin - from.origin).normalized();
  double girth_m = 0.0;
  for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
    const Vector3d a = At(from, profile[j]);
    const Vector3d d = At(from, profile[j + 1]);
    const Vector3d b = At(to, profile[j]);
    const Vector3d c = At(to, profile[j + 1]);
    const double width_m = (profile[j + 1] - profile[j]).norm();
    if (width_m < 1e-9) continue;
    Vector3d v_axis = d - a;
    v_axis -= u_axis * u_axis.dot(v_axis);
    v_axis.normalize();
    const Vector3d foot = a - u_axis * (u_axis.dot(a - from.origin) + along_m);
    builder.AddQuad(
        a, b, c, d, builder.AddFacet(foot - v_axis * girth_m, u_axis, v_axis, material));
    girth_m += width_m;
  }
}

std::vector<Vector3d> Circle(const Vector3d& center,
                             const Vector3d& x_axis,
                             const Vector3d& y_axis,
                             double radius_m,
                             int num_sides) {
  std::vector<Vector3d> points;
  for (int k = 0; k < num_sides; ++k) {
    const double angle = 2.0 * kPi * k / num_sides;
    points.push_back(center + radius_m * (std::cos(angle) * x_axis + std::sin(angle) * y_axis));
  }
  return points;
}

}  // namespace

int FittedCount(double length_m, double size_m) {
  constexpr double kRounding = 1e-6;
  return std::max(1, static_cast<int>(std::lround(length_m / size_m - kRounding)));
}

std::vector<SweepSection> WallPath(const std::vector<Vector2d>& path,
                                   double plane_y_m,
                                   bool is_loop) {
  const std::vector<Vector2d> normals = LeftNormals(path, is_loop);
  std::vector<SweepSection> sections;
  for (std::size_t i = 0; i < path.size(); ++i) {
    sections.push_back({{path[i].x(), plane_y_m, path[i].y()},
                        {normals[i].x(), 0.0, normals[i].y()},
                        {0.0, -1.0, 0.0}});
  }
  return sections;
}

std::vector<SweepSection> LevelPath(const std::vector<Vector2d>& path, double z_m, bool is_loop) {
  const std::vector<Vector2d> normals = LeftNormals(path, is_loop);
  std::vector<SweepSection> sections;
  for (std::size_t i = 0; i < path.size(); ++i) {
    sections.push_back({{path[i].x(), path[i].y(), z_m},
                        {0.0, 0.0, 1.0},
                        {-normals[i].x(), -normals[i].y(), 0.0}});
  }
  return sections;
}

void AddSweep(MeshBuilder& builder,
              const Profile& profile,
              const std::vector<SweepSection>& sections,
              std::uint32_t material,
              SweepEnds ends) {
  const std::size_t num_spans = ends == SweepEnds::kLoop ? sections.size() : sections.size() - 1;
  double along_m = 0.0;
  for (std::size_t i = 0; i < num_spans; ++i) {
    const SweepSection& to = sections[(i + 1) % sections.size()];
    AddSpan(builder, profile, sections[i], to, along_m, material);
    along_m += (to.origin - sections[i].origin).norm();
  }
  if (ends != SweepEnds::kCapped) return;
  AddCap(builder, profile, sections.front(), true, material);
  AddCap(builder, profile, sections.back(), false, material);
}

void AddMoulding(MeshBuilder& builder,
                 const Profile& profile,
                 double x0,
                 double x1,
                 double z,
                 std::uint32_t material,
                 double plane_y_m) {
  AddSweep(builder, profile, WallPath({{x0, z}, {x1, z}}, plane_y_m), material, SweepEnds::kCapped);
}

void AddBox(MeshBuilder& builder,
            const Vector3d& low,
            const Vector3d& high,
            std::uint32_t material,
            const BoxFaces& faces) {
  const auto corner = [&](int x, int y, int z) {
    return Vector3d(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    builder.AddPolygon({a, b, c, d}, material);
  };
  if (faces.front) add(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
  if (faces.back) add(corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1));
  if (faces.sides) {
    add(corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1));
    add(corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1));
  }
  if (faces.bottom) add(corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0), corner(0, 0, 0));
  if (faces.top) add(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
}

void AddBlock(MeshBuilder& builder,
              const Vector3d& low,
              const Vector3d& high,
              double bevel_m,
              std::uint32_t material) {
  AddBlock(builder, low, high, bevel_m, bevel_m, bevel_m, material);
}

void AddBlock(MeshBuilder& builder,
              const Vector3d& low,
              const Vector3d& high,
              double bevel_m,
              double left_bevel_m,
              double right_bevel_m,
              std::uint32_t material) {
  // Front and the rim behind the bevels, from the lower left corner round.
  const std::array<Vector3d, 4> inner = {
      Vector3d(low.x() + left_bevel_m, low.y(), low.z() + bevel_m),
      Vector3d(high.x() - right_bevel_m, low.y(), low.z() + bevel_m),
      Vector3d(high.x() - right_bevel_m, low.y(), high.z() - bevel_m),
      Vector3d(low.x() + left_bevel_m, low.y(), high.z() - bevel_m)};
  const double rim_y = low.y() + bevel_m;
  const std::array<Vector3d, 4> outer = {Vector3d(low.x(), rim_y, low.z()),
                                         Vector3d(high.x(), rim_y, low.z()),
                                         Vector3d(high.x(), rim_y, high.z()),
                                         Vector3d(low.x(), rim_y, high.z())};
  builder.AddPolygon({inner.begin(), inner.end()}, material);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const Vector3d back_from(outer[i].x(), high.y(), outer[i].z());
    const Vector3d back_to(outer[next].x(), high.y(), outer[next].z());
    builder.AddPolygon({outer[i], outer[next], inner[next], inner[i]}, material);
    builder.AddPolygon({back_from, back_to, outer[next], outer[i]}, material);
  }
}

void AddRevolution(MeshBuilder& builder,
                   const std::vector<Vector2d>& outline,
                   const Vector3d& foot,
                   int num_sides,
                   std::uint32_t material) {
  const auto at = [&](const Vector2d& point, int side) {
    const double angle = 2.0 * kPi * (side % num_sides) / num_sides;
    return Vector3d(foot +
                    Vector3d(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y()));
  };
  for (int side = 0; side < num_sides; ++side) {
    const double middle = 2.0 * kPi * (side + 0.5) / num_sides;
    const Vector3d u_axis(-std::sin(middle), std::cos(middle), 0.0);
    const std::uint32_t facet =
        builder.AddFacet(foot - u_axis * 0.1 * side, u_axis, Vector3d::UnitZ(), material);
    for (std::size_t j = 0; j + 1 < outline.size(); ++j) {
      builder.AddQuad(at(outline[j], side),
                      at(outline[j], side + 1),
                      at(outline[j + 1], side + 1),
                      at(outline[j + 1], side),
                      facet);
    }
  }
}

void AddTube(MeshBuilder& builder,
             const std::vector<Vector3d>& path,
             double radius_m,
             int num_sides,
             std::uint32_t material) {
  PLUMB_CHECK_GE(path.size(), std::size_t{2});
  std::vector<std::vector<Vector3d>> rings;
  Vector3d x_axis = (path[1] - path[0]).unitOrthogonal();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector3d before = (path[i] - path[i == 0 ? 0 : i - 1]).normalized();
    const Vector3d after = (path[i + 1 < path.size() ? i + 1 : i] - path[i]).normalized();
    const Vector3d axis = (before + after).normalized();  // One is zero at an end.
    x_axis = (x_axis - axis * axis.dot(x_axis)).normalized();
    rings.push_back(Circle(path[i], x_axis, axis.cross(x_axis), radius_m, num_sides));
  }
  const auto count = static_cast<std::size_t>(num_sides);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t next = (k + 1) % count;
      const Vector3d u_axis = (rings[i][next] - rings[i][k]).normalized();
      const std::uint32_t facet =
          builder.AddFacet(rings[i][k], u_axis, path[i + 1] - path[i], material);
      builder.AddQuad(rings[i][k], rings[i][next], rings[i + 1][next], rings[i + 1][k], facet);
    }
  }
  builder.AddPolygon({rings.front().rbegin(), rings.front().rend()}, material);
  builder.AddPolygon(rings.back(), material);
}

}  // namespace plumb
