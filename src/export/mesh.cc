// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/export/mesh.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <vector>

#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says little-endian");

struct WholeMesh {
  std::vector<const MeshVertex*> vertices;  // By landmark.
  std::vector<std::array<std::int32_t, 3>> faces;
};

WholeMesh JoinBlocks(const MeshDelta& snapshot) {
  std::map<LandmarkId, const MeshVertex*> vertex_of_landmark;
  for (const MeshBlock& block : snapshot.blocks) {
    for (const MeshVertex& vertex : block.vertices) vertex_of_landmark[vertex.landmark] = &vertex;
  }
  WholeMesh mesh;
  std::map<LandmarkId, std::int32_t> index_of_landmark;
  for (const auto& [landmark, vertex] : vertex_of_landmark) {
    index_of_landmark[landmark] = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back(vertex);
  }
  for (const MeshBlock& block : snapshot.blocks) {
    for (std::size_t i = 0; i < block.faces.size(); ++i) {
      const FaceKey key = block.KeyOf(i);
      mesh.faces.push_back({index_of_landmark.at(key[0]),
                            index_of_landmark.at(key[1]),
                            index_of_landmark.at(key[2])});
    }
  }
  return mesh;
}

}  // namespace

void ExportMeshPly(const MeshDelta& snapshot,
                   const std::string& path,
                   const std::vector<std::string>& comments) {
  const WholeMesh mesh = JoinBlocks(snapshot);
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment Plumbline mesh\n";
  for (const std::string& comment : comments) text += "comment " + comment + '\n';
  text += "element vertex " + std::to_string(mesh.vertices.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face " +
          std::to_string(mesh.faces.size()) +
          "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const MeshVertex* vertex : mesh.vertices) {
    text.append(reinterpret_cast<const char*>(vertex->position_in_map.data()), 3 * sizeof(double));
    text.append(reinterpret_cast<const char*>(vertex->color.data()), vertex->color.size());
  }
  for (const std::array<std::int32_t, 3>& face : mesh.faces) {
    text.push_back(3);
    text.append(reinterpret_cast<const char*>(face.data()), sizeof(face));
  }
  WriteFileAtomically(path, text);
}

void ExportMeshObj(const MeshDelta& snapshot,
                   const std::string& path,
                   const std::vector<std::string>& comments) {
  const WholeMesh mesh = JoinBlocks(snapshot);
  std::string text = "# Plumbline mesh\n";
  for (const std::string& comment : comments) text += "# " + comment + '\n';
  std::array<char, 160> line;
  for (const MeshVertex* vertex : mesh.vertices) {
    const Eigen::Vector3d& position = vertex->position_in_map;
    const int length = std::snprintf(line.data(),
                                     line.size(),
                                     "v %.17g %.17g %.17g %.4f %.4f %.4f\n",
                                     position.x(),
                                     position.y(),
                                     position.z(),
                                     vertex->color[0] / 255.0,
                                     vertex->color[1] / 255.0,
                                     vertex->color[2] / 255.0);
    text.append(line.data(), static_cast<std::size_t>(length));
  }
  for (const std::array<std::int32_t, 3>& face : mesh.faces) {
    text += "f";
    for (const std::int32_t index : face) text += " " + std::to_string(index + 1);
    text += "\n";
  }
  WriteFileAtomically(path, text);
}

}  // namespace plumb
