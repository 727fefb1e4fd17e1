// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace plumb {

template <typename Model>
struct RansacResult {
  Model model;
  double cost = std::numeric_limits<double>::infinity();  // Sum of min(error^2 / bound^2, 1).
  int num_inliers = 0;
  int num_iterations = 0;
};

// How well a model fits all matches: truncated squared errors (Torr & Zisserman's MSAC, CVIU
// 78(1), 2000). `Problem` as Ransac takes it; must outlive this.
template <typename Problem>
class TruncatedCost {
 public:
  using Model = typename Problem::Model;

  TruncatedCost(double max_error, const Problem& problem)
      : problem_(problem), inverse_bound2_(1.0 / (max_error * max_error)) {}

  // Squared error over the squared bound: an inlier's is below 1.
  double RelativeError2(const Model& model, int match) const {
    return problem_.SquaredError(model, match) * inverse_bound2_;
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

  // The matches whose relative squared error is below `bound2`.
  std::vector<int> Within(const Model& model, double bound2) const {
    std::vector<int> matches;
    for (int i = 0; i < problem_.size(); ++i) {
      if (RelativeError2(model, i) < bound2) matches.push_back(i);
    }
    return matches;
  }

  std::vector<char> InlierMask(const Model& model) const {
    std::vector<char> is_inlier(static_cast<std::size_t>(problem_.size()), 0);
    for (const int i : Within(model, 1.0)) is_inlier[static_cast<std::size_t>(i)] = 1;
    return is_inlier;
  }

 private:
  const Problem& problem_;
  double inverse_bound2_;
};

}  // namespace plumb
