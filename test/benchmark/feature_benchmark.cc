// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time of AnalyzePhoto (decoding included) against OpenCV's SIFT on the same reduced decoding, for
// synthetic photos of 6 and 16 megapixels and, where the shared data are, for a real one.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "plumbline/image/photo_analysis.h"
#include "test/image/synthetic_photo.h"

namespace plumb {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Photo {
  Bytes bytes;
  int width_px;
  int height_px;
};

Photo SyntheticPhoto(int width_px, int height_px) {
  return {
      testing::Encode(testing::RenderTexture(width_px, height_px, 1), ".jpg"), width_px, height_px};
}

std::string RealPhotoPath() {
  const char* data = std::getenv("PLUMBLINE_DATA");
  const std::string root = data != nullptr ? data : PLUMBLINE_SOURCE_DIR "/../shared/data";
  return root + "/fountain-P11/photos/0005.jpg";
}

Photo RealPhoto() {
  std::ifstream file(RealPhotoPath(), std::ios::binary);
  return {
      Bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>()), 3072, 2048};
}

void RunAnalyzePhoto(benchmark::State& state, const Photo& photo, int num_threads) {
  FeatureOptions options;
  options.num_threads = num_threads;
  std::size_t num_features = 0;
  for (auto _ : state) {
    num_features =
        AnalyzePhoto(options, photo.bytes, photo.width_px, photo.height_px).features.size();
  }
  state.counters["features"] = static_cast<double>(num_features);
}

void RunOpenCvSift(benchmark::State& state, const Photo& photo) {
  const FeatureOptions options;
  std::size_t num_features = 0;
  for (auto _ : state) {
    const cv::Mat image = cv::imdecode(photo.bytes, cv::IMREAD_REDUCED_GRAYSCALE_2);
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    cv::SIFT::create(options.max_features, 3, 3.0 * options.min_contrast)
        ->detectAndCompute(image, {}, keypoints, descriptors);
    num_features = keypoints.size();
  }
  state.counters["features"] = static_cast<double>(num_features);
}

void Register(const std::string& name, const Photo& photo) {
  const auto add = [&](const std::string& what, auto run) {
    benchmark::RegisterBenchmark((what + '/' + name).c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  };
  add("AnalyzePhoto", [photo](benchmark::State& state) { RunAnalyzePhoto(state, photo, 0); });
  add("AnalyzePhotoOneThread",
      [photo](benchmark::State& state) { RunAnalyzePhoto(state, photo, 1); });
  add("OpenCvSift", [photo](benchmark::State& state) { RunOpenCvSift(state, photo); });
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  plumb::Register("synthetic_6_megapixels", plumb::SyntheticPhoto(3072, 2048));
  plumb::Register("synthetic_16_megapixels", plumb::SyntheticPhoto(4608, 3456));
  if (std::ifstream(plumb::RealPhotoPath())) {
    plumb::Register("fountain_6_megapixels", plumb::RealPhoto());
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
