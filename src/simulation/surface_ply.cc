// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/surface_ply.h"

#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says little-endian");

template <typename T>
void Append(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void AppendVertex(std::string& text, const Eigen::Vector3d& vertex_in_world) {
  for (int axis = 0; axis < 3; ++axis) Append(text, vertex_in_world[axis]);
}

void AppendFace(
    std::string& text, std::uint32_t a, std::uint32_t b, std::uint32_t c, bool is_main_wall) {
  Append(text, std::uint8_t{3});
  for (const std::uint32_t corner : {a, b, c}) Append(text, corner);
  Append(text, static_cast<std::uint8_t>(is_main_wall));
}

void AppendPlateVertices(std::string& text, const Plate& plate) {
  const double half = 0.5 * plate.side_m;
  // Anticlockwise seen from before the plate; its frame has y down.
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(-half, half, 0.0),
                                        Eigen::Vector3d(half, half, 0.0),
                                        Eigen::Vector3d(half, -half, 0.0),
                                        Eigen::Vector3d(-half, -half, 0.0)}) {
    AppendVertex(text, plate.world_from_plate * corner);
  }
}

std::string Header(std::size_t num_vertices, std::size_t num_faces) {
  return "ply\nformat binary_little_endian 1.0\n"
         "comment Plumbline simulation, true surface, frame: world, metres\n"
         "element vertex " +
         std::to_string(num_vertices) +
         "\nproperty double x\nproperty double y\nproperty double z\n"
         "element face " +
         std::to_string(num_faces) +
         "\nproperty list uchar uint vertex_indices\nproperty uchar main_wall\nend_header\n";
}

}  // namespace

void WriteSurfacePly(const World& world, const std::string& path) {
  const std::size_t num_vertices = world.vertices_in_world.size() + 4 * world.plates.size();
  const std::size_t num_faces = world.triangles.size() + 2 * world.plates.size();
  std::string text = Header(num_vertices, num_faces);
  for (const Eigen::Vector3d& vertex : world.vertices_in_world) AppendVertex(text, vertex);
  for (const Plate& plate : world.plates) AppendPlateVertices(text, plate);
  for (const WorldTriangle& triangle : world.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    AppendFace(text, a, b, c, world.facets[triangle.facet].is_main_wall);
  }
  auto first = static_cast<std::uint32_t>(world.vertices_in_world.size());
  for (std::size_t i = 0; i < world.plates.size(); ++i, first += 4) {
    AppendFace(text, first, first + 1, first + 2, false);
    AppendFace(text, first, first + 2, first + 3, false);
  }
  WriteFileAtomically(path, text);
}

}  // namespace plumb
