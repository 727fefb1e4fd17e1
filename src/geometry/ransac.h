// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "geometry/sampler.h"
#include "geometry/sequential_test.h"
#include "geometry/truncated_cost.h"

namespace plumb {

struct RansacOptions {
  double max_error = 0.0;
  double confidence = 0.0;
  int min_iterations = 0;
  int max_iterations = 0;
  int random_seed = 0;
};

// Locally optimised RANSAC (Chum, Matas & Kittler, DAGM 2003). `Problem` has
//   using Model; static constexpr int kSampleSize;
//   int size() const;                                      matches
//   void Solve(const std::array<int, kSampleSize>&, std::vector<Model>*) const;   appends
//   double SquaredError(const Model&, int match) const;    infinite if impossible
//   Model Refine(const Model&, const std::vector<int>& inliers) const;
// Deterministic for a seed.
template <typename Problem>
class Ransac {
 public:
  using Model = typename Problem::Model;

  Ransac(const RansacOptions& options, const Problem& problem)
      : options_(options),
        problem_(problem),
        cost_(options.max_error, problem),
        sampler_(options.random_seed) {}

  // Nothing if no sample gave a model.
  std::optional<RansacResult<Model>> Run() {
    if (problem_.size() < Problem::kSampleSize) return std::nullopt;
    std::vector<Model> models;
    double needed = options_.max_iterations;
    int iteration = 0;
    for (; iteration < options_.max_iterations &&
           (iteration < options_.min_iterations || iteration < needed);
         ++iteration) {
      models.clear();
      problem_.Solve(sampler_.template Distinct<Problem::kSampleSize>(problem_.size()), &models);
      bool improved = false;
      for (const Model& model : models) improved |= TryModel(model);
      if (!improved) continue;
      // Until the next better model the local optimum stands in for this one.
      Improve(kMaxLocalInliers, kLocalSteps);
      const double ratio = static_cast<double>(best_.num_inliers) / problem_.size();
      test_.SetGoodRatio(std::clamp(ratio, 0.01, 0.99));
      needed = NeededIterations(ratio);
    }
    if (!has_best_) return std::nullopt;
    Improve(problem_.size(), kFinalSteps);
    best_.num_iterations = iteration;
    return best_;
  }

  std::vector<char> InlierMask(const Model& model) const { return cost_.InlierMask(model); }

 private:
  // Enough for a stable local optimum; more cost time at every new best model.
  static constexpr int kMaxLocalInliers = 300;
  static constexpr int kLocalSteps = 3;
  static constexpr int kFinalSteps = 5;

  // Whether the model became the best.
  bool TryModel(const Model& model) {
    const int size = problem_.size();
    const double log_limit = std::log(SequentialTest::kDecisionThreshold);
    double log_ratio = 0.0;
    RansacResult<Model> result{model, 0.0, 0, 0};
    // From a random match on, lest always the same few decide.
    int match = sampler_.Index(size);
    for (int tried = 1; tried <= size; ++tried) {
      const double error2 = cost_.RelativeError2(model, match);
      if (++match == size) match = 0;
      if (error2 < 1.0) {
        ++result.num_inliers;
        result.cost += error2;
        log_ratio += test_.log_inlier_factor();
      } else {
        result.cost += 1.0;
        log_ratio += test_.log_outlier_factor();
      }
      if (log_ratio > log_limit) {
        test_.AddRefused(result.num_inliers, tried);
        return false;
      }
      if (result.cost >= best_.cost) return false;
    }
    best_ = result;
    has_best_ = true;
    return true;
  }

  // Refines the best model on its inliers, at first those within twice the bound: a
  // minimal sample's noise hides good ones.
  void Improve(int max_inliers, int max_steps) {
    RansacResult<Model> current = best_;
    for (int step = 0; step < max_steps; ++step) {
      std::vector<int> inliers = cost_.Within(current.model, step == 0 ? 4.0 : 1.0);
      Thin(max_inliers, &inliers);
      current = cost_.Evaluate(problem_.Refine(current.model, inliers));
      if (current.cost < best_.cost) {
        best_ = current;
      } else if (step > 0) {
        return;
      }
    }
  }

  // Keeps a random `max_size` of the indices.
  void Thin(int max_size, std::vector<int>* indices) {
    const int size = static_cast<int>(indices->size());
    if (size <= max_size) return;
    for (int i = 0; i < max_size; ++i) {
      std::swap((*indices)[static_cast<std::size_t>(i)],
                (*indices)[static_cast<std::size_t>(i + sampler_.Index(size - i))]);
    }
    indices->resize(static_cast<std::size_t>(max_size));
  }

  double NeededIterations(double inlier_ratio) const {
    const double good_sample = std::pow(inlier_ratio, Problem::kSampleSize) *
                               (1.0 - 1.0 / SequentialTest::kDecisionThreshold);
    return std::log(1.0 - options_.confidence) / std::log1p(-good_sample);
  }

  RansacOptions options_;
  const Problem& problem_;
  TruncatedCost<Problem> cost_;
  Sampler sampler_;
  SequentialTest test_;
  RansacResult<Model> best_ = {};
  bool has_best_ = false;
};

}  // namespace plumb
