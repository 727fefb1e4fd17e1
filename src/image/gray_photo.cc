// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/gray_photo.h"

#include <opencv2/core.hpp>

#include "image/jpeg_raster.h"
#include "image/opencv_raster.h"
#include "plumbline/image/photo_metadata.h"

namespace plumb {
namespace {

constexpr double kMaxPixels = 200e6;  // As in AnalyzePhoto.
constexpr int kFullSize = 8;          // Eighths.

std::string ProblemOfHeader(const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return "the file is empty; copy it from the camera again";
  const PhotoMetadata metadata = ReadPhotoMetadata(bytes);
  if (metadata.width_px <= 0 || metadata.height_px <= 0) {
    return "the file is no photo, or of a kind that is not read; let the camera save JPEG, PNG or "
           "TIFF";
  }
  if (static_cast<double>(metadata.width_px) * metadata.height_px > kMaxPixels) {
    return "the file claims more than 200 megapixels";
  }
  return {};
}

}  // namespace

GrayPhoto DecodeGrayPhoto(const std::vector<std::uint8_t>& bytes, int num_threads) {
  GrayPhoto photo;
  photo.problem = ProblemOfHeader(bytes);
  if (!photo.problem.empty()) return photo;
  DecodedPhoto decoded;
  if (IsJpeg(bytes)) decoded = DecodeJpeg(bytes);
  if (decoded.raster == nullptr && decoded.problem.empty()) decoded = DecodeWithOpenCv(bytes);
  if (decoded.raster == nullptr) {
    photo.problem = decoded.problem;
    return photo;
  }
  FloatImage image = decoded.raster->Gray(kFullSize, num_threads);
  const cv::Mat view(image.height(),
                     image.width(),
                     CV_32F,
                     image.Row(0),
                     static_cast<std::size_t>(image.stride()) * sizeof(float));
  view.convertTo(photo.gray, CV_8U);
  return photo;
}

}  // namespace plumb
