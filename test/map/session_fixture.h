// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

// A fresh folder for each test, removed at its end.
class SessionTest : public testing::Test {
 protected:
  SessionTest() {
    std::string pattern = testing::TempDir() + "plumbline_session_XXXXXX";
    root_ = ::mkdtemp(pattern.data());
    folder_ = (root_ / "flight").string();
  }
  ~SessionTest() override {
    namespace fs = std::filesystem;
    fs::permissions(root_, fs::perms::owner_all, fs::perm_options::add);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root_)) {
      if (!entry.is_directory()) continue;
      fs::permissions(entry, fs::perms::owner_all, fs::perm_options::add);
    }
    fs::remove_all(root_);
  }

  std::filesystem::path root_;
  std::string folder_;
};

inline Camera MakeCamera(double fx = 800.0) {
  LensParameters<double> lens{};
  lens[kFx] = fx;
  lens[kFy] = 801.25;
  lens[kCx] = 319.5;
  lens[kCy] = 239.5;
  lens[kK1] = -0.01;
  return {"test", 640, 480, DistortionModel::kPlumbBob, lens};
}

inline std::vector<std::uint8_t> MakeBytes(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

inline FeatureSet MakeFeatures(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0F, 640.0F);
  FeatureSet features;
  features.descriptors.resize(count, kDescriptorSize);
  for (int i = 0; i < count; ++i) {
    features.features.push_back(
        {uniform(random), uniform(random), uniform(random), uniform(random)});
    features.colors.push_back({static_cast<std::uint8_t>(i),
                               static_cast<std::uint8_t>(i / 2),
                               static_cast<std::uint8_t>(random())});
    for (int k = 0; k < kDescriptorSize; ++k) {
      features.descriptors(i, k) = static_cast<std::uint8_t>(random());
    }
  }
  return features;
}

inline PhotoAnalysis MakeAnalysis(int num_features, unsigned seed) {
  PhotoAnalysis analysis;
  analysis.status = PhotoStatus::kOk;
  analysis.detail = "fine";
  analysis.content_hash = 0xfedcba9876543210U + seed;
  analysis.metadata.width_px = 640;
  analysis.metadata.height_px = 480;
  analysis.metadata.exif_orientation = 6;
  analysis.metadata.focal_length_mm = 8.8;
  analysis.metadata.exposure_time = Timestamp{1234567890123456789};
  analysis.metadata.position = GeodeticPosition{47.3769, 8.5417, std::nullopt};
  analysis.blur_px = 0.75;
  analysis.decode_s = 0.125;
  analysis.features_s = 0.25;
  analysis.features = MakeFeatures(num_features, seed);
  return analysis;
}

// Sets view `photo` and lets it see landmarks 0 to `num_landmarks` - 1, which it moves to
// (photo, landmark, 0.1).
inline MapDelta MakeDelta(std::uint32_t sequence,
                          std::uint32_t photo,
                          std::uint32_t num_landmarks) {
  MapDelta delta;
  delta.sequence = sequence;
  delta.views_set.push_back(
      {{photo},
       "photo" + std::to_string(photo) + ".jpg",
       Timestamp{1000 + static_cast<std::int64_t>(photo)},
       Rigid3(Eigen::Quaterniond(0.8, 0.1, -0.2, 0.3), {0.1 * photo, 1.0 / 3.0, -2.5})});
  for (std::uint32_t i = 0; i < num_landmarks; ++i) {
    delta.landmarks_set.push_back(
        {{i}, Eigen::Vector3d(photo, i, 0.1), {static_cast<std::uint8_t>(i), 200, 255}});
    delta.observations_added.push_back(
        {{i}, {photo}, i + 7, {static_cast<float>(i) + 0.1F, 33.3F}});
  }
  return delta;
}

}  // namespace plumb
