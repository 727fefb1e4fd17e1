// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/ply_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "plumbline/export/ply.h"

namespace plumb {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename T>
std::string Bytes(std::initializer_list<T> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(T)};
}

constexpr char kAscii[] =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nelement face 2\n"
    "property list uchar int vertex_indices\nproperty uchar main_wall\nend_header\n"
    "0 0 0 255\n1.5 0 0 255\n1.5 2 0 0\n-3e1 2 0.25 0\n4 0 1 2 3 1\n3 0 1 3 0\n";

// Of doubles, with an element and a list that are of no interest.
std::string MakeBinary() {
  return "ply\r\nformat binary_little_endian 1.0\r\nelement camera 1\r\nproperty short id\r\n"
         "element vertex 3\r\nproperty double z\r\nproperty double x\r\nproperty list ushort "
         "float weights\r\nproperty double y\r\nelement face 1\r\nproperty list int uint "
         "vertex_index\r\nend_header\r\n" +
         Bytes<std::int16_t>({7}) + Bytes({1.0, 500000.123456789}) + Bytes<std::uint16_t>({1}) +
         Bytes({9.0F}) + Bytes({2.0}) + Bytes({3.0, 4.0}) + Bytes<std::uint16_t>({0}) +
         Bytes({5.0}) + Bytes({6.0, 7.0}) + Bytes<std::uint16_t>({0}) + Bytes({8.0}) +
         Bytes<std::int32_t>({3}) + Bytes<std::uint32_t>({2, 1, 0});
}

class PlyReaderTest : public testing::Test {
 protected:
  ~PlyReaderTest() override { std::remove(path_.c_str()); }

  void Write(const std::string& text) { std::ofstream(path_, std::ios::binary) << text; }
  std::string ErrorOf(const std::string& text) {
    Write(text);
    try {
      ReadPlyMesh(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }
  std::string ErrorAfter(const std::string& from, const std::string& to) {
    std::string text = kAscii;
    text.replace(text.find(from), from.size(), to);
    return ErrorOf(text);
  }

  std::string path_ = testing::TempDir() + "ply_reader_test.ply";
};

TEST_F(PlyReaderTest, ReadsAsciiAndFansPolygons) {
  Write(kAscii);
  const TriangleMesh mesh = ReadPlyMesh(path_);
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[3], Eigen::Vector3d(-30.0, 2.0, 0.25));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_THAT(mesh.triangles[0], ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.triangles[1], ElementsAre(0, 2, 3));
  EXPECT_THAT(mesh.triangles[2], ElementsAre(0, 1, 3));
  EXPECT_THAT(mesh.is_main_wall, ElementsAre(1, 1, 0));
}

TEST_F(PlyReaderTest, ReadsBinaryToTheLastBitAndSkipsWhatItDoesNotKnow) {
  Write(MakeBinary());
  const TriangleMesh mesh = ReadPlyMesh(path_);
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], Eigen::Vector3d(500000.123456789, 2.0, 1.0));
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(7.0, 8.0, 6.0));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_THAT(mesh.triangles[0], ElementsAre(2, 1, 0));
  EXPECT_TRUE(mesh.is_main_wall.empty());
  EXPECT_EQ(ReadPlyPoints(path_), mesh.vertices);
}

TEST_F(PlyReaderTest, ReadsWhatTheExportWrites) {  // Law: round trip.
  ExportPly({{{0}, {1.0 / 3.0, -2e6, 3.25}, {1, 2, 3}}, {{1}, {4, 5, 6}, {7, 8, 9}}}, path_);
  EXPECT_THAT(ReadPlyPoints(path_),
              ElementsAre(Eigen::Vector3d(1.0 / 3.0, -2e6, 3.25), Eigen::Vector3d(4, 5, 6)));
}

TEST_F(PlyReaderTest, NamesTheFileAndTheFault) {
  EXPECT_THAT(ErrorOf(""), AllOf(HasSubstr(path_), HasSubstr("no PLY file")));
  EXPECT_THAT(ErrorOf("solid stl\n"), HasSubstr("no PLY file"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\n"), HasSubstr("no end"));
  EXPECT_THAT(ErrorOf("ply\nend_header\n"), HasSubstr("names no format"));
  EXPECT_THAT(ErrorAfter("ascii", "binary_big_endian"), HasSubstr("binary_little_endian or ascii"));
  EXPECT_THAT(ErrorAfter("float z", "float w"), HasSubstr("no properties x, y, z"));
  EXPECT_THAT(ErrorAfter("float z", "real z"), HasSubstr("unknown type \"real\""));
  EXPECT_THAT(ErrorAfter("vertex 4", "vertex four"), HasSubstr("\"four\""));
  EXPECT_THAT(ErrorAfter("comment", "komment"), HasSubstr("\"komment\""));
  EXPECT_THAT(ErrorAfter("-3e1", "abc"), HasSubstr("\"abc\" is not a number"));
  EXPECT_THAT(ErrorAfter("-3e1", "nan"), HasSubstr("vertex 3 is not finite"));
  EXPECT_THAT(ErrorAfter("0 1 2 3", "0 1 2 4"), HasSubstr("vertex that there is not"));
  EXPECT_THAT(ErrorAfter("3 0 1 3", "3 0 -1 3"), HasSubstr("vertex that there is not"));
  EXPECT_THAT(ErrorAfter("face 2", "edge 2"), HasSubstr("no faces"));
}

TEST_F(PlyReaderTest, RefusesAFileThatIsCutShortAnywhere) {
  for (const std::string& text : {std::string(kAscii), MakeBinary()}) {
    // The last number of the text may lose its end unseen.
    for (std::size_t size = 0; size + 2 < text.size(); ++size) {
      EXPECT_NE(ErrorOf(text.substr(0, size)), "") << size << " bytes";
    }
  }
}

TEST_F(PlyReaderTest, BelievesNoCountThatTheFileCannotHold) {
  EXPECT_THAT(ErrorAfter("vertex 4", "vertex 4000000000"), HasSubstr("cut short"));
  EXPECT_THAT(ErrorAfter("4 0 1 2 3", "1e300 0 1 2 3"), HasSubstr("cut short"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement nothing 9000000000000000\nend_header\n"),
              HasSubstr("no property"));
}

TEST_F(PlyReaderTest, RefusesAFolderAndAMissingFile) {
  EXPECT_THROW(ReadPlyPoints(testing::TempDir()), std::runtime_error);
  EXPECT_THROW(ReadPlyPoints(path_ + ".missing"), std::runtime_error);
}

}  // namespace
}  // namespace plumb
