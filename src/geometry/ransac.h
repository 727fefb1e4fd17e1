// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace plumb {

// A uniform sampler that does not depend on the library's distributions.
class Sampler {
 public:
  explicit Sampler(int seed) : generator_(static_cast<std::uint32_t>(seed)) {}

  // An index below `size`, which must be positive.
  int Index(int size) {
    const std::uint64_t product = std::uint64_t{generator_()} * static_cast<std::uint32_t>(size);
    return static_cast<int>(product >> 32);
  }

  // kCount distinct indices below `size` >= kCount.
  template <std::size_t kCount>
  std::array<int, kCount> Distinct(int size) {
    std::array<int, kCount> indices = {};
    for (std::size_t i = 0; i < kCount; ++i) {
      do {
        indices[i] = Index(size);
      } while (std::find(indices.begin(), indices.begin() + i, indices[i]) != indices.begin() + i);
    }
    return indices;
  }

 private:
  std::mt19937 generator_;
};

struct RansacOptions {
  double max_error = 0.0;
  double confidence = 0.0;
  int min_iterations = 0;
  int max_iterations = 0;
  int random_seed = 0;
};

template <typename Model>
struct RansacResult {
  Model model;
  double cost = std::numeric_limits<double>::infinity();  // Sum of min(error^2 / bound^2, 1).
  int num_inliers = 0;
  int num_iterations = 0;
};

// Wald's sequential test of a model against the matches (Matas & Chum, Randomized RANSAC with
// Sequential Probability Ratio Test, ICCV 2005): most bad models are refused after a few.
class SequentialTest {
 public:
  // One good model in so many is refused by mistake.
  static constexpr double kDecisionThreshold = 100.0;

  SequentialTest() { Update(); }

  // A good model has this ratio of inliers.
  void SetGoodRatio(double ratio) {
    good_ratio_ = ratio;
    Update();
  }
  // A refused model had so many inliers among so many matches tried.
  void AddRefused(int num_inliers, int num_tried) {
    refused_inliers_ += num_inliers;
    refused_tried_ += num_tried;
    if (++num_refused_ % 16 == 0) Update();
  }

  double log_inlier_factor() const { return log_inlier_factor_; }
  double log_outlier_factor() const { return log_outlier_factor_; }

 private:
  void Update() {
    // Starts as if 1000 matches had been tried with 1 % inliers by chance.
    bad_ratio_ = std::min((10.0 + refused_inliers_) / (1000.0 + refused_tried_), 0.5 * good_ratio_);
    log_inlier_factor_ = std::log(bad_ratio_ / good_ratio_);
    log_outlier_factor_ = std::log((1.0 - bad_ratio_) / (1.0 - good_ratio_));
  }

  double good_ratio_ = 0.1;  // Until a model is found: the hardest case worth its time.
  double bad_ratio_ = 0.0;
  double refused_inliers_ = 0.0;
  double refused_tried_ = 0.0;
  int num_refused_ = 0;
  double log_inlier_factor_ = 0.0;
  double log_outlier_factor_ = 0.0;
};

// Locally optimised RANSAC (Chum, Matas & Kittler, DAGM 2003) with truncated squared errors
// (Torr & Zisserman's MSAC, CVIU 78(1), 2000). `Problem` has
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
        inverse_bound2_(1.0 / (options.max_error * options.max_error)),
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

  std::vector<char> InlierMask(const Model& model) const {
    std::vector<char> is_inlier(static_cast<std::size_t>(problem_.size()), 0);
    for (int i = 0; i < problem_.size(); ++i) {
      is_inlier[static_cast<std::size_t>(i)] = RelativeError2(model, i) < 1.0 ? 1 : 0;
    }
    return is_inlier;
  }

 private:
  // Enough for a stable local optimum; more cost time at every new best model.
  static constexpr int kMaxLocalInliers = 300;
  static constexpr int kLocalSteps = 3;
  static constexpr int kFinalSteps = 5;

  double RelativeError2(const Model& model, int match) const {
    return problem_.SquaredError(model, match) * inverse_bound2_;
  }

  // Whether the model became the best.
  bool TryModel(const Model& model) {
    const int size = problem_.size();
    const double log_limit = std::log(SequentialTest::kDecisionThreshold);
    double log_ratio = 0.0;
    RansacResult<Model> result{model, 0.0, 0, 0};
    // From a random match on, lest always the same few decide.
    int match = sampler_.Index(size);
    for (int tried = 1; tried <= size; ++tried) {
      const double error2 = RelativeError2(model, match);
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

  RansacResult<Model> Evaluate(const Model& model) const {
    RansacResult<Model> result{model, 0.0, 0, 0};
    for (int i = 0; i < problem_.size(); ++i) {
      const double error2 = RelativeError2(model, i);
      result.cost += std::min(error2, 1.0);
      result.num_inliers += error2 < 1.0 ? 1 : 0;
    }
    return result;
  }

  // Refines the best model on its inliers, at first those within twice the bound: a
  // minimal sample's noise hides good ones.
  void Improve(int max_inliers, int max_steps) {
    RansacResult<Model> current = best_;
    for (int step = 0; step < max_steps; ++step) {
      const double bound2 = step == 0 ? 4.0 : 1.0;
      std::vector<int> inliers;
      for (int i = 0; i < problem_.size(); ++i) {
        if (RelativeError2(current.model, i) < bound2) inliers.push_back(i);
      }
      Thin(max_inliers, &inliers);
      current = Evaluate(problem_.Refine(current.model, inliers));
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
  double inverse_bound2_;
  Sampler sampler_;
  SequentialTest test_;
  RansacResult<Model> best_ = {};
  bool has_best_ = false;
};

}  // namespace plumb
