// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/feature_extractor.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "image/feature_selection.h"
#include "image/parallel_for.h"
#include "image/scaled_idct.h"
#include "image/sift_descriptor.h"
#include "plumbline/common/stopwatch.h"

namespace plumb {
namespace {

constexpr int kFeaturesPerPart = 64;
constexpr int kMinOctaveSize = 24;  // Pixels; smaller ones have no room beside their border.
constexpr double kFullScale = kDctSize;

// Blur that decoding leaves in a picture, in its own pixels: half a pixel (Lowe, section 3.3),
// and as much more as it is interpolated.
double DecodedSigma(int eighths) { return 0.5 * std::max(1.0, eighths / kFullScale); }

double Pixels(PhotoSize size, int eighths) {
  const double scale = eighths / kFullScale;
  return scale * scale * size.width_px * size.height_px;
}

int FirstEighths(const FeatureOptions& options, PhotoSize size) {
  int eighths = 1;
  const double wanted = options.pixels_per_feature * options.max_features;
  while (eighths < kDctSize && Pixels(size, eighths) < wanted) ++eighths;
  return eighths;
}

PatchFrame FrameOf(const Extremum& extremum) {
  return {extremum.x, extremum.y, static_cast<float>(LevelSigma(extremum.level))};
}

}  // namespace

FeatureExtractor::FeatureExtractor(const FeatureOptions& options,
                                   const PhotoRaster& raster,
                                   PhotoSize size)
    : options_(options), raster_(raster), size_(size), eighths_(FirstEighths(options, size)) {}

Octave FeatureExtractor::DecodeOctave(int eighths) {
  const Stopwatch stopwatch;
  const FloatImage image = raster_.Gray(eighths, options_.num_threads);
  decode_s_ += stopwatch.Seconds();
  const double full_px_per_px = kFullScale / eighths;
  return BuildOctave(BlurToBase(image, DecodedSigma(eighths), options_.num_threads),
                     full_px_per_px,
                     0.5 * full_px_per_px - 0.5,
                     options_.num_threads);
}

void FeatureExtractor::KeepExtrema(std::vector<Extremum> found) {
  extrema_.insert(extrema_.end(), found.begin(), found.end());
}

void FeatureExtractor::SearchCoarse() {
  octaves_.push_back(DecodeOctave(eighths_));
  while (true) {
    const Octave& octave = octaves_.back();
    KeepExtrema(FindExtrema(options_, octave, static_cast<int>(octaves_.size()) - 1));
    if (std::min(octave.width(), octave.height()) < 2 * kMinOctaveSize) break;
    octaves_.push_back(BuildNextOctave(octave, options_.num_threads));
  }
}

void FeatureExtractor::SearchFiner() {
  while (true) {
    const double count = static_cast<double>(extrema_.size());
    if (count >= options_.min_fill * options_.max_features) return;
    // The number of features grows with that of pixels.
    const double missing = std::sqrt(options_.max_features / std::max(1.0, count));
    const int wanted = static_cast<int>(std::ceil(eighths_ * missing));
    int eighths = std::min({std::max(wanted, eighths_ + 1), 2 * eighths_, kMaxEighths});
    while (eighths > eighths_ && Pixels(size_, eighths) > 1e6 * options_.max_octave_megapixels) {
      --eighths;
    }
    if (eighths <= eighths_) return;
    // What is larger has been found in the coarser octave, whose range begins here.
    const double max_scale_px = LevelSigma(0.5) * kFullScale / eighths_;
    octaves_.push_back(DecodeOctave(eighths));
    std::vector<Extremum> found =
        FindExtrema(options_, octaves_.back(), static_cast<int>(octaves_.size()) - 1);
    found.erase(std::remove_if(found.begin(),
                               found.end(),
                               [&](const Extremum& extremum) {
                                 return static_cast<double>(extremum.scale_px) >= max_scale_px;
                               }),
                found.end());
    KeepExtrema(std::move(found));
    eighths_ = eighths;
  }
}

FeatureSet FeatureExtractor::Describe() const {
  const std::vector<int> selected = SelectExtrema(extrema_, octaves_, size_, options_.max_features);
  const int num_selected = static_cast<int>(selected.size());
  const auto image_of = [&](const Extremum& extremum) -> const FloatImage& {
    const int level =
        std::clamp(static_cast<int>(std::lround(extremum.level)), 1, kScalesPerOctave);
    return octaves_[static_cast<std::size_t>(extremum.octave_idx)]
        .levels[static_cast<std::size_t>(level)];
  };

  std::vector<std::vector<float>> orientations(selected.size());
  ParallelFor(options_.num_threads, num_selected, kFeaturesPerPart, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Extremum& extremum =
          extrema_[static_cast<std::size_t>(selected[static_cast<std::size_t>(i)])];
      orientations[static_cast<std::size_t>(i)] =
          FindOrientations(image_of(extremum), FrameOf(extremum));
    }
  });

  // One feature for each orientation, as far as the number allows, by decreasing scale.
  std::vector<std::pair<const Extremum*, float>> oriented;
  for (std::size_t i = 0; i < selected.size(); ++i) {
    const Extremum& extremum = extrema_[static_cast<std::size_t>(selected[i])];
    for (const float orientation : orientations[i]) oriented.emplace_back(&extremum, orientation);
  }
  if (static_cast<int>(oriented.size()) > options_.max_features) {
    oriented.resize(static_cast<std::size_t>(options_.max_features));
  }
  std::stable_sort(oriented.begin(), oriented.end(), [](const auto& a, const auto& b) {
    return a.first->scale_px > b.first->scale_px;
  });

  FeatureSet set;
  set.features.resize(oriented.size());
  set.colors.resize(oriented.size());
  set.descriptors.resize(static_cast<Eigen::Index>(oriented.size()), kDescriptorSize);
  const int num_features = static_cast<int>(oriented.size());
  ParallelFor(options_.num_threads, num_features, kFeaturesPerPart, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto& [extremum, orientation] = oriented[static_cast<std::size_t>(i)];
      const Octave& octave = octaves_[static_cast<std::size_t>(extremum->octave_idx)];
      const auto to_full = [&](float pixel) {
        return static_cast<float>(pixel * octave.full_px_per_px + octave.full_px_offset);
      };
      Feature& feature = set.features[static_cast<std::size_t>(i)];
      feature = {to_full(extremum->x), to_full(extremum->y), extremum->scale_px, orientation};
      DescribePatch(
          image_of(*extremum), FrameOf(*extremum), orientation, set.descriptors.row(i).data());
      set.colors[static_cast<std::size_t>(i)] = raster_.ColorAt(feature.x_px, feature.y_px);
    }
  });
  return set;
}

}  // namespace plumb
