// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plumbline/quality/legend.h"

namespace plumb {
namespace {

Measure MetricMeasure() { return {/*metres_per_map_unit=*/2.0, /*focal_length_px=*/1000.0, 0.5}; }

FaceQuality Seen(double gsd, int num_views, double sigma_per_px = 0.001) {
  FaceQuality quality;
  quality.gsd = static_cast<float>(gsd);
  quality.num_views = static_cast<std::uint16_t>(num_views);
  quality.sigma_per_px = static_cast<float>(sigma_per_px);
  return quality;
}

TEST(Measure, GivesMillimetresOfAMetricMap) {
  const Measure measure = MetricMeasure();
  EXPECT_NEAR(measure.Gsd(Seen(0.002, 3)), 4.0, 1e-6);
  EXPECT_NEAR(measure.Sigma(Seen(0.002, 3, 0.003)), 3.0, 1e-6);
  EXPECT_NEAR(measure.GsdAt(1.5), 3.0, 1e-9);
  EXPECT_NEAR(measure.DistanceFor(3.0), 1.5, 1e-9);
}

TEST(Measure, ComparesWithTheFirstPhotosWhileTheMapIsNotMetric) {
  const Measure measure{std::nullopt, 1000.0, 0.5};
  EXPECT_NEAR(measure.Gsd(Seen(0.01, 3)), 1.0, 1e-6);  // The first photos' depth is 10.
  EXPECT_NEAR(measure.Gsd(Seen(0.02, 3)), 2.0, 1e-6);
  EXPECT_NEAR(measure.DistanceFor(1.0), 10.0, 1e-9);
}

int Blueness(const Rgb& color) { return color[2] - color[0]; }

TEST(ColorOf, IsBlueForCoarseAndRedForFine) {
  const Measure measure = MetricMeasure();
  const auto color = [&](double gsd_mm) {
    return ColorOf(Layer::kGsd, Palette::kPaper, measure, Seen(gsd_mm / 2000.0, 5));
  };
  EXPECT_GT(Blueness(color(10.0)), 100);
  EXPECT_LT(Blueness(color(1.0)), -100);
  EXPECT_EQ(color(50.0), color(10.0));  // The scale ends.
  EXPECT_EQ(color(0.5), color(1.0));
}

TEST(ColorOf, IsRedFromThirtyCamerasOn) {
  const Measure measure = MetricMeasure();
  const auto color = [&](int num_views) {
    return ColorOf(Layer::kRedundancy, Palette::kPaper, measure, Seen(0.002, num_views));
  };
  EXPECT_EQ(color(30), color(200));
  EXPECT_EQ(color(30), ColorAt(Palette::kPaper, 1.0));
  EXPECT_GT(color(30)[0], 2 * color(30)[2]);
  EXPECT_NE(color(29), color(30));
  EXPECT_GT(Blueness(color(2)), 100);
}

TEST(ColorOf, DoesNotDependOnTheOtherFaces) {  // Absolute: the same in every flight.
  const Measure one = MetricMeasure();
  Measure other = one;
  other.metres_per_map_unit = 0.5;
  EXPECT_EQ(ColorOf(Layer::kGsd, Palette::kPaper, one, Seen(0.001, 3)),
            ColorOf(Layer::kGsd, Palette::kPaper, other, Seen(0.004, 3)));
}

TEST(ColorOf, TellsUnseenFacesFromAllOthers) {
  for (const Palette palette : {Palette::kPaper, Palette::kColorBlind}) {
    const Rgb unseen = UnseenColor(palette);
    for (const Layer layer : {Layer::kGsd, Layer::kRedundancy, Layer::kAccuracy}) {
      EXPECT_EQ(ColorOf(layer, palette, MetricMeasure(), FaceQuality()), unseen);
    }
    for (int i = 0; i < 256; ++i) {
      const Rgb seen = ColorAt(palette, i / 255.0);
      const Eigen::Vector3d apart(seen[0] - unseen[0], seen[1] - unseen[1], seen[2] - unseen[2]);
      EXPECT_GT(apart.norm(), 100.0) << ToString(palette) << ' ' << i;
    }
  }
  EXPECT_EQ(ColorOf(Layer::kPlain, Palette::kPaper, MetricMeasure(), FaceQuality()), kPlainColor);
}

TEST(ColorOf, ShowsAnUnknownAccuracyAsPoor) {
  const FaceQuality quality = Seen(0.002, 1, std::numeric_limits<double>::infinity());
  EXPECT_EQ(ColorOf(Layer::kAccuracy, Palette::kPaper, MetricMeasure(), quality),
            ColorAt(Palette::kPaper, 0.0));
}

// Who sees neither red nor green still sees how light a colour is (Rec. 709 luma).
TEST(ColorAt, OfTheColourBlindPaletteGetsLighterAllTheWay) {
  double last = -1.0;
  for (int i = 0; i <= 20; ++i) {
    const Rgb color = ColorAt(Palette::kColorBlind, i / 20.0);
    const double luma = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
    EXPECT_GT(luma, last + 2.0) << i;
    last = luma;
  }
}

TEST(PaletteFromString, KnowsItsWords) {
  EXPECT_EQ(PaletteFromString("paper"), Palette::kPaper);
  EXPECT_EQ(PaletteFromString("colour_blind"), Palette::kColorBlind);
  EXPECT_EQ(PaletteFromString("rainbow"), std::nullopt);
}

TEST(DrawLegend, HasTheColoursOfTheScaleFromPoorToGood) {
  for (const Palette palette : {Palette::kPaper, Palette::kColorBlind}) {
    const cv::Mat picture = DrawLegend(Layer::kRedundancy, palette, MetricMeasure(), GapOptions());
    ASSERT_EQ(picture.size(), cv::Size(kLegendWidth_px, kLegendHeight_px));
    const auto at = [&](int column) {
      const auto& pixel = picture.at<cv::Vec3b>(70, column);
      return Rgb{pixel[0], pixel[1], pixel[2]};
    };
    EXPECT_EQ(at(45), ColorAt(palette, 5.0 / 695.0));
    EXPECT_EQ(at(405), ColorAt(palette, 365.0 / 695.0));
    EXPECT_EQ(at(kLegendWidth_px - 60), UnseenColor(palette));
  }
}

TEST(DrawLegend, OfAMapThatIsNotMetricIsAnotherPicture) {
  Measure measure = MetricMeasure();
  const cv::Mat metric = DrawLegend(Layer::kGsd, Palette::kPaper, measure, GapOptions());
  measure.metres_per_map_unit.reset();
  const cv::Mat relative = DrawLegend(Layer::kGsd, Palette::kPaper, measure, GapOptions());
  EXPECT_GT(cv::norm(metric, relative, cv::NORM_L1), 1e5);
}

}  // namespace
}  // namespace plumb
