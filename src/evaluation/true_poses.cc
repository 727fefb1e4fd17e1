// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/true_poses.h"

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

constexpr std::size_t kNumFields = 8;

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(Trimmed(text.substr(begin, end - begin)));
  }
  return parts;
}

double ParseNumber(const std::string& field) {
  double value = 0.0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) {
    throw std::invalid_argument("\"" + field + "\" is not a number");
  }
  return value;
}

// Throws std::invalid_argument saying what is wrong.
TruePose ParseLine(const std::string& line) {
  const std::vector<std::string> fields = Split(line, ',');
  if (fields.size() != kNumFields) {
    throw std::invalid_argument("has " + std::to_string(fields.size()) + " fields, not " +
                                std::to_string(kNumFields) +
                                " (photo,qw,qx,qy,qz,center_x_m,center_y_m,center_z_m)");
  }
  if (fields[0].empty()) throw std::invalid_argument("names no photo");
  std::array<double, kNumFields - 1> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = ParseNumber(fields[i + 1]);
  const Eigen::Quaterniond rotation(values[0], values[1], values[2], values[3]);
  // Files carry some six digits of it; what is off by more is no rotation.
  if (std::abs(rotation.norm() - 1.0) > 1e-3) {
    throw std::invalid_argument("the quaternion is not of unit length");
  }
  return {fields[0], rotation.normalized(), {values[4], values[5], values[6]}};
}

bool IsHeader(const std::string& line) { return Split(line, ',')[0] == "photo"; }

}  // namespace

std::vector<TruePose> ReadTruePoses(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  std::vector<TruePose> poses;
  std::set<std::string> names;
  int line_number = 0;
  for (const std::string& line : Split(std::string(bytes.begin(), bytes.end()), '\n')) {
    ++line_number;
    if (line.empty() || line[0] == '#' || (poses.empty() && IsHeader(line))) continue;
    try {
      poses.push_back(ParseLine(line));
      if (!names.insert(poses.back().photo).second) {
        throw std::invalid_argument("names photo " + poses.back().photo + " a second time");
      }
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(path + ": line " + std::to_string(line_number) + ": " +
                               error.what());
    }
  }
  if (poses.empty()) throw std::runtime_error(path + ": holds no pose");
  return poses;
}

}  // namespace plumb
