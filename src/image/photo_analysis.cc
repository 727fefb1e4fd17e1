// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/photo_analysis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "plumbline/image/content_hash.h"

namespace plumb {
namespace {

double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Keys {
  std::vector<cv::KeyPoint> keys;
  cv::Mat descriptors;
  int reduction = 4;
  cv::Mat color;
};

Keys Detect(const FeatureOptions& options, const std::vector<std::uint8_t>& bytes, int reduction) {
  Keys result;
  result.reduction = reduction;
  const int flag = reduction == 4   ? cv::IMREAD_REDUCED_COLOR_4
                   : reduction == 2 ? cv::IMREAD_REDUCED_COLOR_2
                                    : cv::IMREAD_COLOR;
  result.color = cv::imdecode(bytes, flag | cv::IMREAD_IGNORE_ORIENTATION);
  cv::Mat gray;
  cv::cvtColor(result.color, gray, cv::COLOR_BGR2GRAY);
  cv::SIFT::create(0, 3, options.min_contrast * 3, options.max_edge_ratio, 1.6)
      ->detectAndCompute(gray, {}, result.keys, result.descriptors);
  return result;
}

FeatureSet Select(const FeatureOptions& options, const Keys& keys) {
  std::vector<int> order(keys.keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return keys.keys[a].size > keys.keys[b].size;
  });
  order.resize(std::min<std::size_t>(order.size(), options.max_features));
  FeatureSet set;
  set.descriptors.resize(static_cast<Eigen::Index>(order.size()), kDescriptorSize);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const cv::KeyPoint& key = keys.keys[order[i]];
    const float r = static_cast<float>(keys.reduction);
    set.features.push_back({(key.pt.x + 0.5F) * r - 0.5F,
                            (key.pt.y + 0.5F) * r - 0.5F,
                            key.size * r / 2.0F,
                            key.angle * static_cast<float>(CV_PI) / 180.0F});
    const cv::Mat row = keys.descriptors.row(order[i]);
    const double sum = std::max(1e-9, cv::norm(row, cv::NORM_L1));
    for (int c = 0; c < kDescriptorSize; ++c) {
      set.descriptors(static_cast<Eigen::Index>(i), c) = static_cast<std::uint8_t>(
          std::min(255.0, std::round(512.0 * std::sqrt(row.at<float>(c) / sum))));
    }
    const int x = std::clamp(static_cast<int>(std::lround(key.pt.x)), 0, keys.color.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(key.pt.y)), 0, keys.color.rows - 1);
    const cv::Vec3b bgr = keys.color.at<cv::Vec3b>(y, x);
    set.colors.push_back({bgr[2], bgr[1], bgr[0]});
  }
  return set;
}

}  // namespace

PhotoAnalysis AnalyzePhoto(const FeatureOptions& options,
                           const std::vector<std::uint8_t>& bytes,
                           int width_px,
                           int height_px) {
  PhotoAnalysis analysis;
  analysis.content_hash = ContentHash(bytes.data(), bytes.size());
  const double start = Seconds();
  analysis.detail = "the file is no picture that can be decoded";
  cv::Mat image;
  try {
    if (!bytes.empty()) image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return analysis;
  }
  if (image.empty()) return analysis;
  analysis.metadata.width_px = image.cols;
  analysis.metadata.height_px = image.rows;
  if (image.cols != width_px || image.rows != height_px) {
    analysis.status = PhotoStatus::kWrongSize;
    analysis.detail = "the photo is " + std::to_string(image.cols) + " x " +
                      std::to_string(image.rows) + " pixels, the camera's are " +
                      std::to_string(width_px) + " x " + std::to_string(height_px);
    return analysis;
  }
  analysis.decode_s = Seconds() - start;
  for (int reduction = 4; reduction >= 1; reduction /= 2) {
    const Keys keys = Detect(options, bytes, reduction);
    analysis.features = Select(options, keys);
    if (static_cast<int>(analysis.features.size()) * 2 > options.max_features) break;
  }
  analysis.features_s = Seconds() - start - analysis.decode_s;
  analysis.status = PhotoStatus::kOk;
  analysis.detail.clear();
  if (static_cast<int>(analysis.features.size()) < options.min_features) {
    analysis.status = PhotoStatus::kTooFewFeatures;
    analysis.detail = "only " + std::to_string(analysis.features.size()) + " features found";
    analysis.features = {};
  }
  return analysis;
}

}  // namespace plumb
