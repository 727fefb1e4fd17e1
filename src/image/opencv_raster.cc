// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/opencv_raster.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace plumb {
namespace {

// Scales of the grey image are multiples of 1/8.
constexpr int kScaleUnit = 8;

class OpenCvRaster : public PhotoRaster {
 public:
  OpenCvRaster(cv::Mat gray, cv::Mat color) : gray_(std::move(gray)), color_(std::move(color)) {}

  FloatImage Gray(int eighths, int /*num_threads*/) const override {
    const auto scaled = [eighths](int size) {
      return (size * eighths + kScaleUnit - 1) / kScaleUnit;
    };
    FloatImage image(scaled(gray_.cols), scaled(gray_.rows));
    // The border is extended to whole units, for which the scale is exact.
    const auto missing = [](int size) { return (kScaleUnit - size % kScaleUnit) % kScaleUnit; };
    cv::Mat whole;
    cv::copyMakeBorder(gray_,
                       whole,
                       0,
                       missing(gray_.rows),
                       0,
                       missing(gray_.cols),
                       cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    whole.convertTo(whole, CV_32F);
    cv::Mat resized;
    const cv::Size size(whole.cols / kScaleUnit * eighths, whole.rows / kScaleUnit * eighths);
    cv::resize(whole, resized, size, 0, 0, eighths < kScaleUnit ? cv::INTER_AREA : cv::INTER_CUBIC);
    for (int y = 0; y < image.height(); ++y) {
      std::copy_n(resized.ptr<float>(y), image.width(), image.Row(y));
      image.FillPadding(y);
    }
    return image;
  }

  Rgb ColorAt(float x_px, float y_px) const override {
    const int radius = 4;
    const int x = std::clamp(static_cast<int>(std::lround(x_px)), 0, color_.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(y_px)), 0, color_.rows - 1);
    const cv::Rect around(x - radius, y - radius, 2 * radius, 2 * radius);
    const cv::Scalar bgr = cv::mean(color_(around & cv::Rect({}, color_.size())));
    return {static_cast<std::uint8_t>(std::lround(bgr[2])),
            static_cast<std::uint8_t>(std::lround(bgr[1])),
            static_cast<std::uint8_t>(std::lround(bgr[0]))};
  }

 private:
  cv::Mat gray_;   // CV_8U.
  cv::Mat color_;  // CV_8UC3, BGR.
};

cv::Mat ToEightBits(const cv::Mat& image) {
  cv::Mat result;
  switch (image.depth()) {
    case CV_8U:
      return image;
    case CV_16U:
      image.convertTo(result, CV_8U, 1.0 / 257.0);
      return result;
    case CV_32F:
    case CV_64F:
      image.convertTo(result, CV_8U, 255.0);
      return result;
    default:
      return {};
  }
}

}  // namespace

DecodedPhoto DecodeWithOpenCv(const std::vector<std::uint8_t>& bytes) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // The caller is told.
  const DecodedPhoto failure = {nullptr, "the picture data are damaged or of an unknown kind"};
  try {
    // IMREAD_UNCHANGED, unlike the others, leaves EXIF's rotation alone.
    const cv::Mat image = ToEightBits(cv::imdecode(bytes, cv::IMREAD_UNCHANGED));
    if (image.empty()) return {nullptr, failure.problem};
    cv::Mat gray = image;
    cv::Mat color;
    if (image.channels() == 1) {
      cv::cvtColor(image, color, cv::COLOR_GRAY2BGR);
    } else {
      const bool has_alpha = image.channels() == 4;
      cv::cvtColor(image, gray, has_alpha ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
      color = image;
      if (has_alpha) cv::cvtColor(image, color, cv::COLOR_BGRA2BGR);
    }
    return {std::make_unique<OpenCvRaster>(gray, color), ""};
  } catch (const cv::Exception&) {
    return {nullptr, failure.problem};
  }
}

}  // namespace plumb
