// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

namespace plumb::testing {

// A round bright spot: amplitude exp(-r^2 / (2 sigma^2)).
struct Blob {
  Eigen::Vector2d center_px;  // (0, 0) is the top-left pixel's centre.
  double sigma_px;
};

// Blobs on a grey ground, rendered at the pixels' centres, CV_8U.
inline cv::Mat RenderBlobs(const std::vector<Blob>& blobs, int width_px, int height_px) {
  cv::Mat image(height_px, width_px, CV_32F, cv::Scalar(70.0));
  for (const Blob& blob : blobs) {
    const int radius = static_cast<int>(std::ceil(5.0 * blob.sigma_px));
    const int center_x = static_cast<int>(std::lround(blob.center_px.x()));
    const int center_y = static_cast<int>(std::lround(blob.center_px.y()));
    for (int y = std::max(0, center_y - radius); y < std::min(height_px, center_y + radius); ++y) {
      for (int x = std::max(0, center_x - radius); x < std::min(width_px, center_x + radius); ++x) {
        const double squared = (Eigen::Vector2d(x, y) - blob.center_px).squaredNorm();
        image.at<float>(y, x) +=
            static_cast<float>(150.0 * std::exp(-0.5 * squared / (blob.sigma_px * blob.sigma_px)));
      }
    }
  }
  cv::Mat bytes;
  image.convertTo(bytes, CV_8U);
  return bytes;
}

// A surface with structure of all sizes, as real ones have: noise of several
// octaves, each of equal contrast. CV_8UC3, a little coloured.
inline cv::Mat RenderTexture(int width_px, int height_px, int seed) {
  cv::RNG rng(static_cast<std::uint64_t>(seed));
  cv::Mat sum(height_px, width_px, CV_32F, cv::Scalar(128.0));
  for (const double sigma_px : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    cv::Mat noise(height_px, width_px, CV_32F);
    rng.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
    cv::GaussianBlur(noise, noise, {}, sigma_px);
    sum += noise * (20.0 * 2.0 * std::sqrt(std::acos(-1.0)) * sigma_px);
  }
  cv::Mat gray;
  sum.convertTo(gray, CV_8U);
  cv::Mat color;
  cv::merge(std::vector<cv::Mat>{gray * 0.8, gray, gray * 0.9}, color);
  return color;
}

// `extension` with its dot: ".jpg" (of quality 95), ".png", ".tiff" ….
inline std::vector<std::uint8_t> Encode(const cv::Mat& image, const std::string& extension) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, image, bytes);
  return bytes;
}

}  // namespace plumb::testing
