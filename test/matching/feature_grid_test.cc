// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/feature_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace plumb {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 470;

// Some lie outside the image.
std::vector<Feature> RandomFeatures(int num_features, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> x(-60.0F, kWidth + 60.0F);
  std::uniform_real_distribution<float> y(-60.0F, kHeight + 60.0F);
  std::vector<Feature> features(static_cast<std::size_t>(num_features));
  for (Feature& feature : features) {
    feature.x_px = x(generator);
    feature.y_px = y(generator);
  }
  return features;
}

std::vector<std::uint32_t> BruteForce(const std::vector<Feature>& features,
                                      const Eigen::Vector2d& pixel,
                                      double radius_px) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < features.size(); ++i) {
    if ((features[i].Pixel() - pixel).norm() <= radius_px) indices.push_back(i);
  }
  return indices;
}

TEST(FeatureGrid, AgreesWithBruteForceInsideAndOutsideTheImage) {
  const std::vector<Feature> features = RandomFeatures(2000, 1);
  const FeatureGrid grid(features, kWidth, kHeight);
  std::vector<std::uint32_t> indices = {7};
  for (const Feature& query : RandomFeatures(200, 2)) {
    for (double radius_px : {0.5, 10.0, 32.0, 100.0, 2000.0}) {
      grid.FindWithin(query.Pixel(), radius_px, &indices);
      EXPECT_EQ(indices, BruteForce(features, query.Pixel(), radius_px));
    }
  }
}

TEST(FeatureGrid, CountsTheRadiusItselfAsWithin) {
  Feature feature;
  feature.x_px = 103.0F;
  feature.y_px = 104.0F;
  const FeatureGrid grid({feature}, kWidth, kHeight);
  std::vector<std::uint32_t> indices;
  grid.FindWithin({100.0, 100.0}, 5.0, &indices);
  EXPECT_THAT(indices, testing::ElementsAre(0U));
}

TEST(FeatureGrid, OfNoFeaturesFindsNone) {
  const FeatureGrid grid({}, kWidth, kHeight);
  std::vector<std::uint32_t> indices = {1};
  grid.FindWithin({10.0, 10.0}, 100.0, &indices);
  EXPECT_THAT(indices, testing::IsEmpty());
}

TEST(FeatureGrid, FindsNothingNearAPixelThatIsNotFinite) {
  const FeatureGrid grid(RandomFeatures(100, 1), kWidth, kHeight);
  std::vector<std::uint32_t> indices = {1};
  grid.FindWithin({std::nan(""), 10.0}, 100.0, &indices);
  EXPECT_THAT(indices, testing::IsEmpty());
}

TEST(FeatureGrid, RefusesAnImageWithoutArea) {
  EXPECT_THROW(FeatureGrid({}, 0, kHeight), std::logic_error);
}

}  // namespace
}  // namespace plumb
