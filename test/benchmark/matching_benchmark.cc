// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <benchmark/benchmark.h>

#include <atomic>
#include <opencv2/core.hpp>

#include "matching/neighbor_search.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "plumbline/matching/inverted_file.h"
#include "plumbline/matching/vocabulary_tree.h"
#include "test/matching/random_descriptors.h"

namespace plumb {
namespace {

using internal::SimdPath;

internal::DescriptorSpan Span(const DescriptorMatrix& descriptors) {
  return {descriptors.data(), static_cast<int>(descriptors.rows())};
}

void BM_FindNeighbors(benchmark::State& state) {
  const auto path = static_cast<SimdPath>(state.range(0));
  if (!internal::IsSupported(path)) {
    state.SkipWithError("this processor lacks the instructions");
    return;
  }
  const auto num_features = static_cast<int>(state.range(1));
  const DescriptorMatrix descriptors1 = RandomDescriptors(num_features, 1);
  const DescriptorMatrix descriptors2 = RandomDescriptors(num_features, 2);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        internal::FindNeighbors(path, Span(descriptors1), Span(descriptors2), 1));
  }
}
BENCHMARK(BM_FindNeighbors)
    ->ArgNames({"path", "features"})
    ->ArgsProduct({{static_cast<int>(SimdPath::kPortable),
                    static_cast<int>(SimdPath::kAvx2),
                    static_cast<int>(SimdPath::kAvxVnni),
                    static_cast<int>(SimdPath::kAvx512Vnni)},
                   {800, 5000}})
    ->Unit(benchmark::kMillisecond);

// The alternative: the dot products by a float matrix product, then a scan of the matrix.
template <typename Product>
void MatchByProduct(benchmark::State& state, const Product& product) {
  const DescriptorMatrix descriptors1 = RandomDescriptors(5000, 1);
  const DescriptorMatrix descriptors2 = RandomDescriptors(5000, 2);
  for (auto _ : state) {
    const auto dots = product(descriptors1, descriptors2);
    for (Eigen::Index i = 0; i < dots.rows(); ++i) {
      float best = 0.0F;
      float second = 0.0F;
      for (Eigen::Index j = 0; j < dots.cols(); ++j) {
        second = std::max(second, std::min(best, dots(i, j)));
        best = std::max(best, dots(i, j));
      }
      benchmark::DoNotOptimize(second);
    }
    benchmark::DoNotOptimize(dots.colwise().maxCoeff().eval());
  }
}

using FloatMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void BM_MatchByEigenProduct(benchmark::State& state) {
  MatchByProduct(state, [](const DescriptorMatrix& set1, const DescriptorMatrix& set2) {
    return FloatMatrix(set1.cast<float>() * set2.cast<float>().transpose());
  });
}
BENCHMARK(BM_MatchByEigenProduct)->Unit(benchmark::kMillisecond);

void BM_MatchByOpenCvProduct(benchmark::State& state) {
  cv::setNumThreads(1);
  MatchByProduct(state, [](const DescriptorMatrix& set1, const DescriptorMatrix& set2) {
    FloatMatrix floats1 = set1.cast<float>();
    FloatMatrix floats2 = set2.cast<float>();
    FloatMatrix dots(set1.rows(), set2.rows());
    const cv::Mat mat1(static_cast<int>(set1.rows()), kDescriptorSize, CV_32F, floats1.data());
    const cv::Mat mat2(static_cast<int>(set2.rows()), kDescriptorSize, CV_32F, floats2.data());
    cv::Mat product(mat1.rows, mat2.rows, CV_32F, dots.data());
    cv::gemm(mat1, mat2, 1.0, cv::noArray(), 0.0, product, cv::GEMM_2_T);
    return dots;
  });
}
BENCHMARK(BM_MatchByOpenCvProduct)->Unit(benchmark::kMillisecond);

void BM_SquaredDistance(benchmark::State& state) {
  const DescriptorMatrix descriptors = RandomDescriptors(1000, 1);
  Eigen::Index i = 0;
  for (auto _ : state) {
    i = (i + 1) % descriptors.rows();
    benchmark::DoNotOptimize(SquaredDistance(descriptors.data(), descriptors.row(i).data()));
  }
}
BENCHMARK(BM_SquaredDistance);

VocabularyTree TrainTree() {
  const std::atomic<bool> is_cancelled{false};
  return VocabularyTree::Train({}, RandomDescriptors(50000, 1), is_cancelled).value();
}

void BM_TrainTreeOn50000(benchmark::State& state) {
  const DescriptorMatrix descriptors = RandomDescriptors(50000, 1);
  const std::atomic<bool> is_cancelled{false};
  for (auto _ : state) {
    benchmark::DoNotOptimize(VocabularyTree::Train({}, descriptors, is_cancelled));
  }
}
BENCHMARK(BM_TrainTreeOn50000)->Unit(benchmark::kMillisecond);

void BM_Quantize5000(benchmark::State& state) {
  const VocabularyTree tree = TrainTree();
  const DescriptorMatrix descriptors = RandomDescriptors(5000, 2);
  for (auto _ : state) benchmark::DoNotOptimize(tree.Quantize(descriptors));
}
BENCHMARK(BM_Quantize5000)->Unit(benchmark::kMillisecond);

// 5000 features against an inverted file of so many photos of 5000 features each.
void BM_Query(benchmark::State& state) {
  const VocabularyTree tree = TrainTree();
  InvertedFile file(tree.num_words());
  for (std::uint32_t photo = 0; photo < state.range(0); ++photo) {
    file.Add({photo}, tree.Quantize(RandomDescriptors(5000, 10 + photo % 20)));
  }
  const auto words = tree.Quantize(RandomDescriptors(5000, 2));
  for (auto _ : state) benchmark::DoNotOptimize(file.Query(words, 8));
}
BENCHMARK(BM_Query)->ArgName("photos")->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb

BENCHMARK_MAIN();
