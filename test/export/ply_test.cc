// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/export/ply.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

TEST(ExportPly, ReadsBackToTheLastBitEvenFarFromTheOrigin) {
  const std::vector<LandmarkState> landmarks = {
      {{1}, {2600000.123456789, 1200000.987654321, 430.1}, {255, 0, 10}},
      {{5}, {-1.0 / 3.0, 0.0, 1e-12}, {1, 2, 3}}};
  const std::string path = testing::TempDir() + "points.ply";
  ExportPly(landmarks, path);
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  std::remove(path.c_str());
  const std::string text(bytes.begin(), bytes.end());
  const std::string end = "end_header\n";
  const std::size_t body = text.find(end) + end.size();
  EXPECT_EQ(text.substr(0, 4), "ply\n");
  EXPECT_NE(text.find("format binary_little_endian 1.0\n"), std::string::npos);
  EXPECT_NE(text.find("element vertex 2\n"), std::string::npos);
  constexpr std::size_t kStride = 27;
  ASSERT_EQ(text.size() - body, 2 * kStride);
  for (std::size_t i = 0; i < 2; ++i) {
    Eigen::Vector3d position;
    std::memcpy(position.data(), text.data() + body + i * kStride, 24);
    EXPECT_EQ(position, landmarks[i].position_in_map);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(static_cast<std::uint8_t>(text[body + i * kStride + 24 + k]),
                landmarks[i].color[k]);
    }
  }
}

}  // namespace
}  // namespace plumb
