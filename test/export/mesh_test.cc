// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/export/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

// A square of two faces in two blocks, far from the origin; two landmarks are in both.
MeshDelta MakeMesh() {
  const Eigen::Vector3d origin(2600000.123456789, 1200000.987654321, 1.0 / 3.0);
  const MeshVertex a{{3}, origin, {255, 0, 51}};
  const MeshVertex b{{4}, origin + Eigen::Vector3d(1, 0, 0), {1, 2, 3}};
  const MeshVertex c{{7}, origin + Eigen::Vector3d(1, 0, 1), {4, 5, 6}};
  const MeshVertex d{{9}, origin + Eigen::Vector3d(0, 0, 1), {7, 8, 9}};
  MeshDelta mesh;
  mesh.blocks.push_back({{0, 0, 0}, {a, b, c}, {{0, 1, 2}}});
  mesh.blocks.push_back({{1, 0, 0}, {a, c, d}, {{0, 1, 2}}});
  return mesh;
}

template <typename Export>
std::string Exported(const Export& write) {
  const std::string path = testing::TempDir() + "exported_mesh";
  write(MakeMesh(), path, {"frame: enu about offset, metres", "offset: 1 2 3"});
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  std::remove(path.c_str());
  return {bytes.begin(), bytes.end()};
}

TEST(ExportMesh, JoinsTheBlocksOfAPly) {
  const std::string text = Exported(ExportMeshPly);
  EXPECT_THAT(text, testing::HasSubstr("element vertex 4\n"));
  EXPECT_THAT(text, testing::HasSubstr("comment frame: enu about offset, metres\n"));
  EXPECT_THAT(text, testing::HasSubstr("element face 2\n"));
  const std::string end = "end_header\n";
  const char* body = text.data() + text.find(end) + end.size();
  ASSERT_EQ(text.data() + text.size() - body, 4 * 27 + 2 * 13);
  double x = 0.0;
  std::memcpy(&x, body, sizeof x);
  EXPECT_EQ(x, 2600000.123456789);
  EXPECT_EQ(static_cast<std::uint8_t>(body[24]), 255);
  std::array<std::int32_t, 3> face;
  EXPECT_EQ(body[4 * 27 + 13], 3);
  std::memcpy(face.data(), body + 4 * 27 + 13 + 1, sizeof face);
  EXPECT_THAT(face, testing::ElementsAre(0, 2, 3));
}

TEST(ExportMesh, WritesAnObjThatReadsBackToTheLastBit) {
  const std::string text = Exported(ExportMeshObj);
  EXPECT_THAT(text, testing::HasSubstr("# offset: 1 2 3\n"));
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double red = 0.0;
  double blue = 0.0;
  const std::size_t first = text.find("\nv ");
  ASSERT_EQ(
      std::sscanf(text.c_str() + first, "\nv %lf %lf %lf %lf %*f %lf", &x, &y, &z, &red, &blue), 5);
  EXPECT_EQ(x, 2600000.123456789);
  EXPECT_EQ(y, 1200000.987654321);
  EXPECT_EQ(z, 1.0 / 3.0);
  EXPECT_EQ(red, 1.0);
  EXPECT_EQ(blue, 0.2);
  EXPECT_THAT(text, testing::HasSubstr("\nf 1 2 3\nf 1 3 4\n"));
}

TEST(ExportMesh, NamesTheFileItCannotWrite) {
  const std::string path = testing::TempDir() + "exported_mesh_file";
  WriteFileAtomically(path, "a file");
  try {
    ExportMeshPly(MakeMesh(), path + "/mesh.ply");
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(path));
  }
  std::remove(path.c_str());
}

}  // namespace
}  // namespace plumb
