// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/shade_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "simulation/picture_integral.h"
#include "simulation/sample_list.h"
#include "simulation/shader_setup.h"
#include "test/support/random.h"

namespace plumb::internal {
namespace {

constexpr std::array<Pattern, 8> kPatterns = {Pattern::kPlaster,
                                              Pattern::kBrick,
                                              Pattern::kAshlar,
                                              Pattern::kWood,
                                              Pattern::kGlass,
                                              Pattern::kMetal,
                                              Pattern::kRoofTiles,
                                              Pattern::kGround};

// The wall y = 0.
Patch MakePatch() {
  Patch patch;
  patch.normal = -Eigen::Vector3d::UnitY();
  patch.offset = 0.0;
  patch.texture_origin.setZero();
  patch.u_axis = Eigen::Vector3d::UnitX();
  patch.v_axis = Eigen::Vector3d::UnitZ();
  patch.texture_seed = 99;
  return patch;
}

// Looks at the wall from a distance, at (x, z).
Rigid3 LookFrom(double x, double z, double distance_m) {
  Eigen::Matrix3d rotation;
  rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return {Eigen::Quaterniond(rotation), -(rotation * Eigen::Vector3d(x, -distance_m, z))};
}

// A square of `side` x `side` pixels around the optical axis.
std::vector<Sample> MakeSamples(int side, float pixel) {
  std::vector<Sample> samples;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const float x = (static_cast<float>(column) - 0.5F * static_cast<float>(side - 1)) * pixel;
      const float y = (static_cast<float>(row) - 0.5F * static_cast<float>(side - 1)) * pixel;
      samples.push_back({row * side + column, 0, {x, y, pixel, 0.0F, 0.0F, pixel}, 1.0F});
    }
  }
  return samples;
}

// Green, row by row.
std::vector<float> Render(const ShadeKernel& kernel,
                          const Material& material,
                          const Rigid3& cam_from_world,
                          int side,
                          float pixel) {
  SampleList list;
  list.Assign(MakeSamples(side, pixel));
  const SampleGroup& group = list.groups().front();
  const int count = list.Rays(group).count;
  std::fill(list.ambient(), list.ambient() + count, 0.9F);
  std::fill(list.run_off(), list.run_off() + count, 0.4F);
  const SurfaceShader shader =
      ShaderOf(MakePatch(), material, IlluminationOf(Light()), cam_from_world);
  kernel.find_texture(ViewOf(MakePatch(), cam_from_world), list.Rays(group), list.Texture(group));
  kernel.shade({&shader,
                list.Rays(group),
                list.Texture(group),
                list.Light(group),
                list.Radiance(group),
                2,
                0.5F});
  const ColorList radiance = list.Radiance(group);
  return {radiance.green, radiance.green + side * side};
}

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};

Moments MomentsOf(const std::vector<float>& values) {
  Moments moments;
  for (const float value : values) moments.mean += value / static_cast<double>(values.size());
  for (const float value : values) moments.deviation += std::pow(value - moments.mean, 2);
  moments.deviation = std::sqrt(moments.deviation / static_cast<double>(values.size()));
  return moments;
}

TEST(ShadeKernel, AllProcessorsAgreeToTheBit) {
  for (const Pattern pattern : kPatterns) {
    Material material;
    material.pattern = pattern;
    material.specular = pattern == Pattern::kGlass ? 0.3F : 0.0F;
    const Rigid3 cam_from_world = LookFrom(17.3, 8.1, 6.0);
    const std::vector<float> expected =
        Render(PortableShadeKernel(), material, cam_from_world, 61, 1e-3F);
    for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
      if (level > DetectSimdLevel()) continue;
      EXPECT_EQ(Render(ShadeKernelOf(level), material, cam_from_world, 61, 1e-3F), expected)
          << static_cast<int>(pattern) << ' ' << static_cast<int>(level);
    }
  }
}

TEST(ShadeKernel, WithoutDetailASurfaceIsPlain) {
  Material material;
  material.detail = 0.0F;
  const Moments moments = MomentsOf(
      Render(ShadeKernelOf(DetectSimdLevel()), material, LookFrom(3.0, 9.0, 5.0), 128, 3e-4F));
  EXPECT_GT(moments.mean, 0.1);
  EXPECT_LT(moments.deviation, 1e-6);
}

TEST(ShadeKernel, DetailGoesDownToMillimetres) {
  Material material;
  // 38 mm of wall at 0.3 mm a pixel: its detail is finer than that.
  const Moments moments = MomentsOf(
      Render(ShadeKernelOf(DetectSimdLevel()), material, LookFrom(3.0, 9.0, 1.0), 128, 3e-4F));
  EXPECT_GT(moments.deviation, 0.02 * moments.mean);
}

// Mean over cells of `factor` x `factor` pixels.
std::vector<float> Reduced(const std::vector<float>& values, int side, int factor) {
  const int reduced_side = side / factor;
  std::vector<float> result(static_cast<std::size_t>(reduced_side) * reduced_side, 0.0F);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      result[row / factor * reduced_side + column / factor] +=
          values[row * side + column] / static_cast<float>(factor * factor);
    }
  }
  return result;
}

double Correlation(const std::vector<float>& a, const std::vector<float>& b) {
  const Moments moments_a = MomentsOf(a);
  const Moments moments_b = MomentsOf(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - moments_a.mean) * (b[i] - moments_b.mean);
  }
  return sum / (static_cast<double>(a.size()) * moments_a.deviation * moments_b.deviation);
}

TEST(ShadeKernel, NearAndFarPhotosSeeTheSame) {
  const ShadeKernel& kernel = ShadeKernelOf(DetectSimdLevel());
  for (const Pattern pattern : {Pattern::kPlaster, Pattern::kBrick, Pattern::kGround}) {
    Material material;
    material.pattern = pattern;
    material.element_m = {0.25F, 0.08F};
    const std::vector<float> near = Render(kernel, material, LookFrom(4.0, 12.0, 2.5), 512, 3e-4F);
    const std::vector<float> far = Render(kernel, material, LookFrom(4.0, 12.0, 10.0), 128, 3e-4F);
    const std::vector<float> reduced = Reduced(near, 512, 4);
    // Not 1: the far photo lacks what is finer than some two of its pixels.
    EXPECT_GT(Correlation(reduced, far), 0.88) << static_cast<int>(pattern);
    EXPECT_NEAR(MomentsOf(far).mean / MomentsOf(reduced).mean, 1.0, 0.02);
    EXPECT_NEAR(MomentsOf(far).deviation / MomentsOf(reduced).deviation, 1.0, 0.15);
  }
}

TEST(ShadeKernel, EveryPlaceIsUnique) {
  const ShadeKernel& kernel = ShadeKernelOf(DetectSimdLevel());
  const std::vector<float> here = Render(kernel, Material(), LookFrom(4.0, 12.0, 4.0), 256, 3e-4F);
  for (const double step_m : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    const std::vector<float> there =
        Render(kernel, Material(), LookFrom(4.0 + step_m, 12.0, 4.0), 256, 3e-4F);
    EXPECT_LT(std::abs(Correlation(here, there)), 0.6) << step_m;
  }
}

TEST(PictureIntegral, MeansAreThoseOfThePixels) {
  test::Random random(4);
  PlatePicture picture{"noise", 7, {}};
  for (int i = 0; i < 49; ++i) {
    picture.pixels.push_back(static_cast<std::uint8_t>(random.Index(256)));
  }
  const PictureIntegral integral(&picture);
  for (int trial = 0; trial < 50; ++trial) {
    const float width = static_cast<float>(random.Uniform(0.01, 0.4));
    const float height = static_cast<float>(random.Uniform(0.01, 0.4));
    const float x = static_cast<float>(random.Uniform(0.2, 0.8));
    const float y = static_cast<float>(random.Uniform(0.2, 0.8));
    double sum = 0.0;  // By brute force, over 200 x 200 places.
    for (int i = 0; i < 40000; ++i) {
      const double px = x + width * ((i % 200 + 0.5) / 200.0 - 0.5);
      const double py = y + height * ((i / 200 + 0.5) / 200.0 - 0.5);
      sum += picture.pixels[static_cast<int>(py * 7) * 7 + static_cast<int>(px * 7)] / 255.0;
    }
    EXPECT_NEAR(integral.Mean(x, y, width, height), sum / 40000, 5e-3);
  }
  EXPECT_NEAR(integral.Mean(-1.0F, -1.0F, 0.1F, 0.1F), picture.pixels[0] / 255.0, 1e-3);
  EXPECT_NEAR(integral.Mean(2.0F, 2.0F, 0.1F, 0.1F), picture.pixels[48] / 255.0, 1e-3);
  EXPECT_NEAR(PictureIntegral(nullptr).Mean(0.3F, 0.3F, 0.1F, 0.1F), 1.0, 1e-6);
}

}  // namespace
}  // namespace plumb::internal
