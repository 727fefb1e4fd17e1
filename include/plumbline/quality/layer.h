// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "plumbline/image/features.h"
#include "plumbline/quality/quality_block.h"

namespace plumb {

// What the colours of the mesh tell.
enum class Layer { kGsd, kRedundancy, kAccuracy, kPlain };

constexpr std::array<Layer, 4> kLayers = {
    Layer::kGsd, Layer::kRedundancy, Layer::kAccuracy, Layer::kPlain};

// "gsd", "redundancy", "accuracy", "plain"; as in names of topics.
const char* ToString(Layer layer);

// The paper's, blue for poor to red for good, or one that those who see no red or green can read.
enum class Palette { kPaper, kColorBlind };

// "paper", "colour_blind"; the inverse gives nothing for another word.
const char* ToString(Palette palette);
std::optional<Palette> PaletteFromString(const std::string& word);

// What turns the map's lengths into what is shown. While the map is not metric, lengths are
// multiples of what the first photos had.
struct Measure {
  std::optional<double> metres_per_map_unit;
  double focal_length_px = 0.0;
  double noise_px = 0.0;
  double half_photo_px = 0.0;  // Half of the photo's shorter side.

  // [mm], or relative to a face that is looked at straight from the distance of the first photos.
  double Gsd(const FaceQuality& quality) const;

  // [mm], or relative to one pixel of such a face.
  double Sigma(const FaceQuality& quality) const;

  // The GSD of a distance that is looked from straight, and the inverse; distances in map units.
  double GsdAt(double distance) const;
  double DistanceFor(double gsd) const;

  // The radius of the circle that fits into a photo from there [map units].
  double PhotoRadiusAt(double distance) const;
};

// Logarithmic scales, the same in every flight: the colours of two flights can be compared.
struct Scale {
  double poor = 0.0;  // This and worse has the colour at the poor end, ...
  double good = 0.0;  // ... this and better that at the good end.
};

Scale ScaleOf(Layer layer, bool is_metric);

// 0 at the poor end, 1 at the good end.
double PlaceOnScale(const Scale& scale, double value);

Rgb ColorAt(Palette palette, double place);

// No camera sees it. Far from all colours of the palette; of that for the colour-blind, also to
// eyes without red or green cones.
Rgb UnseenColor(Palette palette);

// Of kPlain, before shading.
constexpr Rgb kPlainColor = {205, 200, 190};

Rgb ColorOf(Layer layer, Palette palette, const Measure& measure, const FaceQuality& quality);

}  // namespace plumb
