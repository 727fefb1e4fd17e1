// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/camera/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumb {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Camera PlumbBob(const std::array<double, 5>& d) {
  return Camera("plumb_bob",
                4000,
                3000,
                DistortionModel::kPlumbBob,
                {2200.0, 2210.0, 1990.0, 1510.0, d[0], d[1], d[2], d[3], d[4], 0.0, 0.0, 0.0});
}

// Strong but real: an action camera's barrel, its wide variant with tangential terms, a
// pincushion telephoto, and a rational model of a wide lens.
std::vector<Camera> StrongLenses() {
  return {PlumbBob({0.0, 0.0, 0.0, 0.0, 0.0}),
          PlumbBob({-0.28, 0.11, 1e-3, -8e-4, 0.0}),
          PlumbBob({-0.2, 0.08, 4e-3, 3e-3, 0.01}),
          PlumbBob({0.15, 0.3, -2e-3, 1e-3, 0.1}),
          Camera("rational",
                 1920,
                 1200,
                 DistortionModel::kRationalPolynomial,
                 {870.0, 872.0, 955.0, 610.0, 4.1, 2.3, 1e-4, -2e-4, 0.09, 4.5, 3.6, 0.55})};
}

// A grid over the whole raster, corners of the corner pixels included.
template <typename Check>
void ForEachPixel(const Camera& camera, Check&& check) {
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      check(Eigen::Vector2d(-0.5 + i * camera.width_px() / static_cast<double>(kSteps),
                            -0.5 + j * camera.height_px() / static_cast<double>(kSteps)));
    }
  }
}

TEST(Camera, ProjectsWhatItUnprojectedOverTheWholeImage) {
  for (const Camera& camera : StrongLenses()) {
    ForEachPixel(camera, [&](const Eigen::Vector2d& pixel) {
      const auto xy = camera.Unproject(pixel);
      ASSERT_TRUE(xy) << camera.name() << " at " << pixel.transpose();
      for (const double depth : {0.3, 1.0, 250.0}) {
        const auto back = camera.Project(depth * xy->homogeneous());
        ASSERT_TRUE(back) << camera.name() << " at " << pixel.transpose();
        EXPECT_LT((*back - pixel).norm(), 1e-6) << camera.name() << " at " << pixel.transpose();
      }
    });
  }
}

TEST(Camera, UnprojectsToTheOneRayItProjected) {  // Not to another branch of the polynomial.
  for (const Camera& camera : StrongLenses()) {
    ForEachPixel(camera, [&](const Eigen::Vector2d& pixel) {
      const Eigen::Vector2d xy((pixel.x() - camera.lens()[kCx]) / camera.lens()[kFx],
                               (pixel.y() - camera.lens()[kCy]) / camera.lens()[kFy]);
      const auto distorted = camera.Project(xy.homogeneous());
      if (!distorted) return;  // Barrel lenses see less than their pinhole would.
      const auto back = camera.Unproject(*distorted);
      ASSERT_TRUE(back) << camera.name() << " at " << xy.transpose();
      EXPECT_LT((*back - xy).norm(), 1e-8) << camera.name() << " at " << xy.transpose();
    });
  }
}

TEST(Camera, UnprojectsThePrincipalPointToTheAxis) {
  const Camera camera = PlumbBob({-0.28, 0.11, 0.0, 0.0, 0.0});
  EXPECT_LT(camera.Unproject({1990.0, 1510.0})->norm(), 1e-12);
}

TEST(Camera, SeesNothingBehindIt) {
  const Camera camera = PlumbBob({-0.28, 0.11, 0.0, 0.0, 0.0});
  EXPECT_FALSE(camera.Project({0.1, 0.1, -1.0}));
  EXPECT_FALSE(camera.Project({0.1, 0.1, 0.0}));
  EXPECT_FALSE(camera.Project({kNan, 0.1, 1.0}));
}

TEST(Camera, DoesNotFoldPointsFarOffTheAxisBackIntoTheImage) {
  // r (1 - 0.25 r^2) turns back at r = sqrt(4 / 3): radius 2 maps to the image's centre.
  const Camera camera("barrel",
                      2000,
                      1500,
                      DistortionModel::kPlumbBob,
                      {1800.0, 1800.0, 999.5, 749.5, -0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_FALSE(camera.Project({2.0, 0.0, 1.0}));
  EXPECT_FALSE(camera.Project({0.0, -1.2, 1.0}));
  EXPECT_TRUE(camera.Project({0.0, -1.15, 1.0}));
  EXPECT_FALSE(camera.Project({std::sqrt(4.0 / 3.0) + 1e-6, 0.0, 1.0}));
  EXPECT_TRUE(camera.Project({std::sqrt(4.0 / 3.0) - 1e-6, 0.0, 1.0}));
}

TEST(Camera, ShrinksTheFieldForTangentialDistortion) {
  // With p2 alone d x' / d x = 1 + 6 p2 x along y = 0: singular at x = -1 / (6 p2) = -5 / 3.
  const Camera camera("decentred",
                      2000,
                      1500,
                      DistortionModel::kPlumbBob,
                      {1800.0, 1800.0, 999.5, 749.5, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(camera.Project({-5.0 / 3.0 + 1e-6, 0.0, 1.0}));
  EXPECT_FALSE(camera.Project({-5.0 / 3.0 - 1e-6, 0.0, 1.0}));
}

TEST(Camera, UnprojectsNothingBeyondTheField) {
  const Camera camera("barrel",
                      2000,
                      1500,
                      DistortionModel::kPlumbBob,
                      {1800.0, 1800.0, 999.5, 749.5, -0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_FALSE(camera.Unproject({1e5, 749.5}));
  EXPECT_FALSE(camera.Unproject({-1e9, 1e9}));
  EXPECT_FALSE(camera.Unproject({kNan, 749.5}));
  EXPECT_FALSE(camera.Unproject({std::numeric_limits<double>::infinity(), 0.0}));
}

TEST(Camera, KnowsItsImage) {
  const Camera camera = PlumbBob({0.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(camera.IsInImage({-0.5, -0.5}));
  EXPECT_TRUE(camera.IsInImage({3999.4, 2999.4}));
  EXPECT_FALSE(camera.IsInImage({-0.51, 10.0}));
  EXPECT_FALSE(camera.IsInImage({10.0, 2999.5}));
  EXPECT_FALSE(camera.IsInImage({kNan, 10.0}));
}

TEST(Camera, GivesTheGeometricMeanOfItsFocalLengths) {
  EXPECT_DOUBLE_EQ(PlumbBob({0.0, 0.0, 0.0, 0.0, 0.0}).MeanFocalLength(),
                   std::sqrt(2200.0 * 2210.0));
}

std::string RefusalOf(int width_px,
                      int height_px,
                      DistortionModel model,
                      const LensParameters<double>& lens) {
  try {
    Camera("refused", width_px, height_px, model, lens);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Camera, RefusesWhatNoCameraCanBeAndNamesTheField) {
  const LensParameters<double> good = {
      1000.0, 1000.0, 500.0, 400.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto with = [&](int parameter, double value) {
    LensParameters<double> lens = good;
    lens[parameter] = value;
    return RefusalOf(1000, 800, DistortionModel::kPlumbBob, lens);
  };
  EXPECT_EQ(RefusalOf(1000, 800, DistortionModel::kPlumbBob, good), "accepted");
  EXPECT_THAT(RefusalOf(0, 800, DistortionModel::kPlumbBob, good), HasSubstr("image_width"));
  EXPECT_THAT(RefusalOf(1000, -1, DistortionModel::kPlumbBob, good), HasSubstr("image_height"));
  EXPECT_THAT(with(kFx, -1000.0), HasSubstr("fx must be positive, but is -1000"));
  EXPECT_THAT(with(kFy, 0.0), HasSubstr("fy"));
  EXPECT_THAT(with(kFx, kNan), HasSubstr("fx must be a finite number"));
  EXPECT_THAT(with(kCx, 1001.0), HasSubstr("cx"));
  EXPECT_THAT(with(kCy, -2.0), HasSubstr("cy"));
  EXPECT_THAT(with(kP1, std::numeric_limits<double>::infinity()), HasSubstr("p1"));
  EXPECT_THAT(with(kK4, 0.1), HasSubstr("k4 must be 0 for plumb_bob"));
}

TEST(Camera, RefusesALensThatFoldsTheImage) {
  // r (1 - r^2) turns back at r = 0.58 and distorted radius 0.38; the corner lies at 0.64.
  EXPECT_THAT(
      RefusalOf(
          1000, 800, DistortionModel::kPlumbBob, {1000, 1000, 500, 400, -1.0, 0, 0, 0, 0, 0, 0, 0}),
      HasSubstr("fold"));
  // The rational model's pole at r = 0.5.
  EXPECT_THAT(RefusalOf(1000,
                        800,
                        DistortionModel::kRationalPolynomial,
                        {1000, 1000, 500, 400, -4.1, 0, 0, 0, 0, -4.0, 0, 0}),
              HasSubstr("fold"));
}

}  // namespace
}  // namespace plumb
