// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t SizeOf(PlyType type);  // [bytes]

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  std::optional<PlyType> length_type;  // Only of a list.
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool is_ascii = false;  // Else binary little-endian.
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  // Without the word comment.
  std::size_t size = 0;               // [bytes]; the body begins there.
};

// Throws std::invalid_argument saying what is wrong, also if the file is too short to hold as many
// elements as the header says.
PlyHeader ParsePlyHeader(std::string_view file);

}  // namespace plumb
