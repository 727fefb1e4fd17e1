// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <sstream>
#include <stdexcept>

namespace plumb {
namespace {

constexpr std::size_t kMaxHeaderSize = 1 << 16;  // Real ones have some hundred bytes.

PlyType ParseType(const std::string& name) {
  static const std::map<std::string, PlyType> kTypes = {{"char", PlyType::kInt8},
                                                        {"int8", PlyType::kInt8},
                                                        {"uchar", PlyType::kUint8},
                                                        {"uint8", PlyType::kUint8},
                                                        {"short", PlyType::kInt16},
                                                        {"int16", PlyType::kInt16},
                                                        {"ushort", PlyType::kUint16},
                                                        {"uint16", PlyType::kUint16},
                                                        {"int", PlyType::kInt32},
                                                        {"int32", PlyType::kInt32},
                                                        {"uint", PlyType::kUint32},
                                                        {"uint32", PlyType::kUint32},
                                                        {"float", PlyType::kFloat32},
                                                        {"float32", PlyType::kFloat32},
                                                        {"double", PlyType::kFloat64},
                                                        {"float64", PlyType::kFloat64}};
  const auto type = kTypes.find(name);
  if (type == kTypes.end()) {
    throw std::invalid_argument("its header names an unknown type \"" + name + "\"");
  }
  return type->second;
}

bool IsFloating(PlyType type) { return type == PlyType::kFloat32 || type == PlyType::kFloat64; }

std::size_t ParseCount(const std::string& text) {
  std::size_t count = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc() || stop != end) {
    throw std::invalid_argument("its header counts \"" + text + "\" elements");
  }
  return count;
}

PlyProperty ParseProperty(const std::vector<std::string>& words) {
  if (words.size() == 3 && words[1] != "list") return {words[2], ParseType(words[1]), std::nullopt};
  if (words.size() == 5 && words[1] == "list") {
    const PlyType length_type = ParseType(words[2]);
    if (!IsFloating(length_type)) return {words[4], ParseType(words[3]), length_type};
  }
  throw std::invalid_argument("a property of its header has no type and name");
}

bool ParseFormat(const std::vector<std::string>& words) {
  const std::string format = words.size() < 2 ? "" : words[1];
  if (format != "ascii" && format != "binary_little_endian") {
    throw std::invalid_argument("its format is \"" + format +
                                "\"; save it as binary_little_endian or ascii");
  }
  return format == "ascii";
}

// Fewest bytes of a list or number.
std::size_t LeastSize(const PlyProperty& property, bool is_ascii) {
  if (is_ascii) return 2;  // A digit and a space.
  return SizeOf(property.length_type.value_or(property.type));
}

void CheckSize(const PlyHeader& header, std::size_t body_size) {
  for (const PlyElement& element : header.elements) {
    std::size_t least_size = 0;
    for (const PlyProperty& property : element.properties) {
      least_size += LeastSize(property, header.is_ascii);
    }
    if (least_size == 0) {
      throw std::invalid_argument("its element " + element.name + " has no property");
    }
    // An ascii file may lack its last line feed.
    if (element.count > (body_size + 1) / least_size) {
      throw std::invalid_argument("it is cut short: its header says " +
                                  std::to_string(element.count) + " of " + element.name);
    }
  }
}

void ParseLine(const std::vector<std::string>& words, bool* has_format, PlyHeader* header) {
  if (words[0] == "format") {
    header->is_ascii = ParseFormat(words);
    *has_format = true;
  } else if (words[0] == "element" && words.size() == 3) {
    header->elements.push_back({words[1], ParseCount(words[2]), {}});
  } else if (words[0] == "property" && !header->elements.empty()) {
    header->elements.back().properties.push_back(ParseProperty(words));
  } else if (words[0] != "comment" && words[0] != "obj_info") {
    throw std::invalid_argument("its header has a line that begins with \"" + words[0] + "\"");
  }
}

std::vector<std::string> WordsOf(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

std::size_t SizeOf(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

PlyHeader ParsePlyHeader(std::string_view file) {
  PlyHeader header;
  bool has_format = false;
  std::istringstream lines(std::string(file.substr(0, kMaxHeaderSize)));
  std::string line;
  std::getline(lines, line);
  if (WordsOf(line) != std::vector<std::string>{"ply"}) {
    throw std::invalid_argument("it is no PLY file");
  }
  while (std::getline(lines, line) && !lines.eof()) {
    const std::vector<std::string> words = WordsOf(line);
    if (words.empty()) continue;
    if (words[0] == "end_header") {
      if (!has_format) throw std::invalid_argument("its header names no format");
      header.size = static_cast<std::size_t>(lines.tellg());
      CheckSize(header, file.size() - header.size);
      return header;
    }
    if (words[0] == "comment" && words.size() > 1) {
      header.comments.push_back(line.substr(line.find(words[1], line.find(words[0]) + 7)));
    }
    ParseLine(words, &has_format, &header);
  }
  throw std::invalid_argument("its header has no end");
}

}  // namespace plumb
