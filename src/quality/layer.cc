// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/layer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

// The map's unit until georeferenced: the first photos look from about this far.
constexpr double kFirstDistance = 10.0;

constexpr double kMmPerMetre = 1000.0;

// All colours of a palette, poor first.
class Palettes {
 public:
  static const Palettes& Get() {
    static const Palettes palettes;
    return palettes;
  }

  Rgb At(Palette palette, std::size_t idx) const {
    return (palette == Palette::kPaper ? paper_ : color_blind_)[idx];
  }

 private:
  Palettes() {
    Fill(cv::COLORMAP_JET, &paper_);
    Fill(cv::COLORMAP_CIVIDIS, &color_blind_);
  }

  static void Fill(int colormap, std::array<Rgb, 256>* colors) {
    cv::Mat places(1, 256, CV_8U);
    for (int i = 0; i < 256; ++i) places.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
    cv::Mat bgr;
    cv::applyColorMap(places, bgr, colormap);
    for (int i = 0; i < 256; ++i) {
      const auto& pixel = bgr.at<cv::Vec3b>(i);
      (*colors)[static_cast<std::size_t>(i)] = {pixel[2], pixel[1], pixel[0]};
    }
  }

  std::array<Rgb, 256> paper_;
  std::array<Rgb, 256> color_blind_;
};

}  // namespace

const char* ToString(Layer layer) {
  switch (layer) {
    case Layer::kGsd:
      return "gsd";
    case Layer::kRedundancy:
      return "redundancy";
    case Layer::kAccuracy:
      return "accuracy";
    case Layer::kPlain:
      return "plain";
  }
  return "";
}

const char* ToString(Palette palette) {
  return palette == Palette::kPaper ? "paper" : "colour_blind";
}

std::optional<Palette> PaletteFromString(const std::string& word) {
  for (const Palette palette : {Palette::kPaper, Palette::kColorBlind}) {
    if (word == ToString(palette)) return palette;
  }
  return std::nullopt;
}

double Measure::GsdAt(double distance) const {
  const double gsd = distance / focal_length_px;
  return metres_per_map_unit ? kMmPerMetre * *metres_per_map_unit * gsd
                             : gsd * focal_length_px / kFirstDistance;
}

double Measure::DistanceFor(double gsd) const { return gsd / GsdAt(1.0); }

double Measure::PhotoRadiusAt(double distance) const {
  return distance * half_photo_px / focal_length_px;
}

double Measure::Gsd(const FaceQuality& quality) const {
  return GsdAt(focal_length_px * quality.gsd);
}

double Measure::Sigma(const FaceQuality& quality) const {
  return GsdAt(focal_length_px * noise_px * quality.sigma_per_px);
}

Scale ScaleOf(Layer layer, bool is_metric) {
  switch (layer) {
    case Layer::kGsd:
      // 16 megapixels behind 16 mm have 1 mm at 3.4 m and 10 mm at 34 m.
      return is_metric ? Scale{10.0, 1.0} : Scale{3.0, 0.3};
    case Layer::kRedundancy:
      return {1.0, 30.0};  // The paper's: red from 30 cameras.
    case Layer::kAccuracy:
      return is_metric ? Scale{20.0, 0.5} : Scale{10.0, 0.1};
    case Layer::kPlain:
      return {1.0, 1.0};
  }
  return {};
}

double PlaceOnScale(const Scale& scale, double value) {
  PLUMB_CHECK(scale.poor > 0.0 && scale.good > 0.0 && scale.poor != scale.good);
  if (std::isnan(value)) return 0.0;
  const double place = std::log(value / scale.poor) / std::log(scale.good / scale.poor);
  return std::clamp(place, 0.0, 1.0);
}

Rgb ColorAt(Palette palette, double place) {
  const double idx = std::round(255.0 * std::clamp(place, 0.0, 1.0));
  return Palettes::Get().At(palette, static_cast<std::size_t>(idx));
}

Rgb UnseenColor(Palette palette) {
  // Grey is in the middle of cividis. By the matrices of Vienot, Brettel and Mollon (1999) no
  // colour of it is nearer than 96 to this orange, of 0..255 an axis.
  return palette == Palette::kPaper ? Rgb{90, 90, 90} : Rgb{220, 90, 0};
}

Rgb ColorOf(Layer layer, Palette palette, const Measure& measure, const FaceQuality& quality) {
  if (layer == Layer::kPlain) return kPlainColor;
  if (quality.num_views == 0) return UnseenColor(palette);
  const Scale scale = ScaleOf(layer, measure.metres_per_map_unit.has_value());
  switch (layer) {
    case Layer::kGsd:
      return ColorAt(palette, PlaceOnScale(scale, measure.Gsd(quality)));
    case Layer::kRedundancy:
      return ColorAt(palette, PlaceOnScale(scale, quality.num_views));
    default:
      return ColorAt(palette, PlaceOnScale(scale, measure.Sigma(quality)));
  }
}

}  // namespace plumb
