// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/photo_analysis.h"

#include <cmath>
#include <optional>
#include <utility>

#include "image/blur_estimate.h"
#include "image/feature_extractor.h"
#include "image/file_damage.h"
#include "image/jpeg_raster.h"
#include "image/opencv_raster.h"
#include "plumbline/common/options.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/image/content_hash.h"
#include "plumbline/image/photo_metadata.h"
#include "plumbline/image/photo_name.h"

namespace plumb {
namespace {

// Decoding takes some 6 bytes a pixel; no camera of a MAV comes near.
constexpr double kMaxPixels = 200e6;

std::string Describe(PhotoSize size) {
  return std::to_string(size.width_px) + " x " + std::to_string(size.height_px);
}

bool Refuse(PhotoStatus status, std::string detail, PhotoAnalysis* analysis) {
  analysis->status = status;
  analysis->detail = std::move(detail);
  return false;
}

// Reads the header: the size and the metadata.
bool CheckHeader(const std::vector<std::uint8_t>& bytes,
                 PhotoSize expected,
                 PhotoAnalysis* analysis) {
  if (bytes.empty()) {
    return Refuse(
        PhotoStatus::kUndecodable, "the file is empty; copy it from the camera again", analysis);
  }
  analysis->metadata = ReadPhotoMetadata(bytes);
  if (IsJpeg(bytes)) {
    const std::optional<PhotoSize> of_header = ReadJpegSize(bytes);
    if (!of_header) {
      return Refuse(PhotoStatus::kUndecodable,
                    "the header of the JPEG file is damaged; copy the file from the camera again",
                    analysis);
    }
    analysis->metadata.width_px = of_header->width_px;
    analysis->metadata.height_px = of_header->height_px;
  }
  const PhotoSize size = {analysis->metadata.width_px, analysis->metadata.height_px};
  if (static_cast<double>(size.width_px) * size.height_px > kMaxPixels) {
    return Refuse(PhotoStatus::kUndecodable,
                  "the file claims " + Describe(size) + " pixels, more than 200 megapixels",
                  analysis);
  }
  std::string damage = FindFileDamage(bytes);
  if (!damage.empty()) return Refuse(PhotoStatus::kUndecodable, std::move(damage), analysis);
  if (size.width_px <= 0 || size.height_px <= 0) {
    return Refuse(PhotoStatus::kUndecodable,
                  std::string("the file is no photo, or of a kind that is not read (") +
                      kPhotoKinds + " are); let the camera save JPEG",
                  analysis);
  }
  if (size.width_px == expected.width_px && size.height_px == expected.height_px) return true;
  std::string detail =
      "the photo has " + Describe(size) + " pixels, but the camera's have " + Describe(expected);
  const bool is_swapped =
      size.width_px == expected.height_px && size.height_px == expected.width_px;
  detail += is_swapped
                ? "; a program has rotated it, or the camera file is of photos held upright: only "
                  "originals fit the camera's calibration"
                : "; use the camera's originals, and the camera file of photos of this size";
  return Refuse(PhotoStatus::kWrongSize, std::move(detail), analysis);
}

bool Decode(const std::vector<std::uint8_t>& bytes, DecodedPhoto* photo, PhotoAnalysis* analysis) {
  if (IsJpeg(bytes)) *photo = DecodeJpeg(bytes);
  if (photo->raster == nullptr && photo->problem.empty()) *photo = DecodeWithOpenCv(bytes);
  if (photo->raster != nullptr) return true;
  return Refuse(PhotoStatus::kUndecodable, photo->problem, analysis);
}

bool FindFeatures(const FeatureOptions& options,
                  FeatureExtractor* extractor,
                  PhotoAnalysis* analysis) {
  extractor->SearchCoarse();
  analysis->blur_px = EstimateBlur(extractor->first_octave());
  const double max_blur_px = options.max_blur * extractor->first_octave().full_px_per_px;
  if (analysis->blur_px > max_blur_px) {
    return Refuse(PhotoStatus::kTooBlurred,
                  "blurred by about " + std::to_string(std::lround(analysis->blur_px)) +
                      " px; hold still, focus, or use a shorter exposure",
                  analysis);
  }
  extractor->SearchFiner();
  analysis->features = extractor->Describe();
  const int num_features = static_cast<int>(analysis->features.size());
  if (num_features >= options.min_features) return true;
  analysis->features = {};
  return Refuse(PhotoStatus::kTooFewFeatures,
                "only " + std::to_string(num_features) +
                    " features, too few to locate it; is it too dark, too bright, or a blank wall?",
                analysis);
}

}  // namespace

PhotoAnalysis AnalyzePhoto(const FeatureOptions& options,
                           const std::vector<std::uint8_t>& bytes,
                           int width_px,
                           int height_px) {
  ThrowIfProblems("features", options.Problems());
  PhotoAnalysis analysis;
  const Stopwatch decoding;
  analysis.content_hash = ContentHash(bytes.data(), bytes.size());
  if (!CheckHeader(bytes, {width_px, height_px}, &analysis)) return analysis;
  DecodedPhoto photo;
  const bool is_decoded = Decode(bytes, &photo, &analysis);
  analysis.decode_s = decoding.Seconds();
  if (!is_decoded) return analysis;

  const Stopwatch finding;
  FeatureExtractor extractor(options, *photo.raster, {width_px, height_px});
  if (FindFeatures(options, &extractor, &analysis)) analysis.status = PhotoStatus::kOk;
  analysis.decode_s += extractor.decode_s();
  analysis.features_s = finding.Seconds() - extractor.decode_s();
  return analysis;
}

}  // namespace plumb
