// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's reader of polygon soups does not give a face's own properties, and takes whatever
// length a broken list claims; Debian 12 has no other small one.
#include "plumbline/evaluation/ply_reader.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "evaluation/ply_header.h"
#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "binary files are little-endian");

// Takes one number after the other from the body. Throws std::invalid_argument.
class PlyCursor {
 public:
  PlyCursor(std::string_view body, bool is_ascii)
      : next_(body.data()), end_(body.data() + body.size()), is_ascii_(is_ascii) {}

  double Take(PlyType type) { return is_ascii_ ? TakeText() : TakeBinary(type); }

  void Skip(const PlyProperty& property) {
    const double length = property.length_type ? Take(*property.length_type) : 1.0;
    for (double i = 0; i < length; ++i) Take(property.type);
  }

 private:
  template <typename T>
  double TakeAs() {
    T value;
    if (static_cast<std::size_t>(end_ - next_) < sizeof(T)) ThrowCutShort();
    std::memcpy(&value, next_, sizeof(T));
    next_ += sizeof(T);
    return static_cast<double>(value);
  }

  double TakeBinary(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return TakeAs<std::int8_t>();
      case PlyType::kUint8:
        return TakeAs<std::uint8_t>();
      case PlyType::kInt16:
        return TakeAs<std::int16_t>();
      case PlyType::kUint16:
        return TakeAs<std::uint16_t>();
      case PlyType::kInt32:
        return TakeAs<std::int32_t>();
      case PlyType::kUint32:
        return TakeAs<std::uint32_t>();
      case PlyType::kFloat32:
        return TakeAs<float>();
      case PlyType::kFloat64:
        break;
    }
    return TakeAs<double>();
  }

  static bool IsSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

  double TakeText() {
    while (next_ != end_ && IsSpace(*next_)) ++next_;
    if (next_ == end_) ThrowCutShort();
    double value = 0.0;
    const auto [stop, error] = std::from_chars(next_, end_, value);
    if (error != std::errc() || (stop != end_ && !IsSpace(*stop))) {
      const char* word_end = next_;
      while (word_end != end_ && !IsSpace(*word_end) && word_end - next_ < 20) ++word_end;
      throw std::invalid_argument("\"" + std::string(next_, word_end) + "\" is not a number");
    }
    next_ = stop;
    return value;
  }

  [[noreturn]] static void ThrowCutShort() {
    throw std::invalid_argument("it is cut short: it ends before its last element");
  }

  const char* next_;
  const char* end_;
  bool is_ascii_;
};

std::vector<Eigen::Vector3d> TakePoints(const PlyElement& element, PlyCursor* cursor) {
  std::vector<int> axis_of_property;
  int num_axes = 0;
  for (const PlyProperty& property : element.properties) {
    const std::size_t axis = std::string("xyz").find(property.name);
    const bool is_axis = property.name.size() == 1 && axis != std::string::npos;
    if (is_axis && property.length_type) throw std::invalid_argument("its coordinates are lists");
    axis_of_property.push_back(is_axis ? static_cast<int>(axis) : -1);
    num_axes += is_axis ? 1 : 0;
  }
  if (num_axes != 3) throw std::invalid_argument("its vertices have no properties x, y, z");
  std::vector<Eigen::Vector3d> points(element.count);
  for (std::size_t i = 0; i < element.count; ++i) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (axis_of_property[k] < 0) {
        cursor->Skip(property);
      } else {
        points[i][axis_of_property[k]] = cursor->Take(property.type);
      }
    }
    if (!points[i].allFinite()) {
      throw std::invalid_argument("vertex " + std::to_string(i) + " is not finite");
    }
  }
  return points;
}

std::vector<std::uint32_t> TakeFace(const PlyProperty& property,
                                    std::size_t num_vertices,
                                    PlyCursor* cursor) {
  std::vector<std::uint32_t> corners;
  const double length = cursor->Take(*property.length_type);
  for (double i = 0; i < length; ++i) {
    const double vertex = cursor->Take(property.type);
    if (!(vertex >= 0 && vertex < static_cast<double>(num_vertices))) {
      throw std::invalid_argument(
          "a face names a vertex that there is not; vertices must come "
          "before faces, and count from 0");
    }
    corners.push_back(static_cast<std::uint32_t>(vertex));
  }
  return corners;
}

bool IsVertexList(const PlyProperty& property) {
  return property.length_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

void TakeFaces(const PlyElement& element, PlyCursor* cursor, TriangleMesh* mesh) {
  bool has_main_wall = false;
  for (std::size_t i = 0; i < element.count; ++i) {
    std::vector<std::uint32_t> corners;
    bool is_main_wall = false;
    for (const PlyProperty& property : element.properties) {
      if (IsVertexList(property)) {
        corners = TakeFace(property, mesh->vertices.size(), cursor);
      } else if (property.name == "main_wall" && !property.length_type) {
        is_main_wall = cursor->Take(property.type) != 0.0;
        has_main_wall = true;
      } else {
        cursor->Skip(property);
      }
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      mesh->triangles.push_back({corners[0], corners[k - 1], corners[k]});
      mesh->is_main_wall.push_back(is_main_wall ? 1 : 0);
    }
  }
  if (!has_main_wall) mesh->is_main_wall.clear();
}

TriangleMesh Parse(std::string_view file, bool wants_faces) {
  const PlyHeader header = ParsePlyHeader(file);
  PlyCursor cursor(file.substr(header.size), header.is_ascii);
  TriangleMesh mesh;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      mesh.vertices = TakePoints(element, &cursor);
      if (!wants_faces) break;
    } else if (element.name == "face" && wants_faces) {
      TakeFaces(element, &cursor, &mesh);
    } else {
      for (std::size_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) cursor.Skip(property);
      }
    }
  }
  if (mesh.vertices.empty()) throw std::invalid_argument("it holds no points");
  if (wants_faces && mesh.triangles.empty()) {
    throw std::invalid_argument("it holds no faces, so it is a point cloud and no surface");
  }
  return mesh;
}

TriangleMesh Read(const std::string& path, bool wants_faces) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  try {
    return Parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, wants_faces);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": " + error.what() + "; export or copy it again");
  }
}

}  // namespace

TriangleMesh ReadPlyMesh(const std::string& path) { return Read(path, /*wants_faces=*/true); }

std::vector<std::string> ReadPlyComments(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  try {
    return ParsePlyHeader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}).comments;
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": " + error.what() + "; export or copy it again");
  }
}

std::vector<Eigen::Vector3d> ReadPlyPoints(const std::string& path) {
  return Read(path, /*wants_faces=*/false).vertices;
}

}  // namespace plumb
