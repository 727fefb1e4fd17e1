// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/relative_pose.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/epipolar.h"
#include "geometry/five_point.h"
#include "geometry/homography.h"
#include "geometry/ransac.h"
#include "geometry/two_view_support.h"
#include "plumbline/common/check.h"

namespace plumb {
namespace {

using Matches = std::vector<NormalizedMatch>;

Matches Select(const Matches& matches, const std::vector<int>& indices) {
  Matches selected;
  selected.reserve(indices.size());
  for (const int i : indices) selected.push_back(matches[static_cast<std::size_t>(i)]);
  return selected;
}

// The essential matrix as a problem of Ransac.
class EssentialProblem {
 public:
  using Model = Eigen::Matrix3d;
  static constexpr int kSampleSize = 5;

  EssentialProblem(const Matches& matches, double max_error)
      : matches_(matches), max_error_(max_error) {}

  int size() const { return static_cast<int>(matches_.size()); }

  void Solve(const std::array<int, 5>& sample, std::vector<Model>* models) const {
    std::array<Eigen::Vector2d, 5> xy1;
    std::array<Eigen::Vector2d, 5> xy2;
    for (std::size_t i = 0; i < 5; ++i) {
      xy1[i] = matches_[static_cast<std::size_t>(sample[i])].xy1;
      xy2[i] = matches_[static_cast<std::size_t>(sample[i])].xy2;
    }
    for (const Model& essential : SolveFivePoint(xy1, xy2)) models->push_back(essential);
  }

  double SquaredError(const Model& essential, int match) const {
    const NormalizedMatch& m = matches_[static_cast<std::size_t>(match)];
    return SquaredSampsonError(essential, m.xy1, m.xy2);
  }

  // The Sampson error is the same for all four poses of an essential matrix.
  Model Refine(const Model& essential, const std::vector<int>& inliers) const {
    constexpr int kMaxIterations = 10;
    return EssentialFromPose(MinimizeSampsonError(
        PosesFromEssential(essential)[0], Select(matches_, inliers), max_error_, kMaxIterations));
  }

 private:
  const Matches& matches_;
  double max_error_;
};

// The homography as a problem of Ransac.
class HomographyProblem {
 public:
  struct Model {
    Eigen::Matrix3d xy2_from_xy1;
    Eigen::Matrix3d xy1_from_xy2;
  };
  static constexpr int kSampleSize = 4;

  explicit HomographyProblem(const Matches& matches) : matches_(matches) {}

  int size() const { return static_cast<int>(matches_.size()); }

  void Solve(const std::array<int, 4>& sample, std::vector<Model>* models) const {
    std::array<NormalizedMatch, 4> chosen;
    for (std::size_t i = 0; i < 4; ++i) chosen[i] = matches_[static_cast<std::size_t>(sample[i])];
    const auto h = SolveHomography(chosen);
    if (h) models->push_back({*h, h->inverse()});
  }

  // The greater of the transfer errors into either view.
  double SquaredError(const Model& model, int match) const {
    const NormalizedMatch& m = matches_[static_cast<std::size_t>(match)];
    return std::max(SquaredTransferError(model.xy2_from_xy1, m.xy1, m.xy2),
                    SquaredTransferError(model.xy1_from_xy2, m.xy2, m.xy1));
  }

  Model Refine(const Model& model, const std::vector<int>& inliers) const {
    const Eigen::Matrix3d h = RefineHomography(model.xy2_from_xy1, Select(matches_, inliers));
    return {h, h.inverse()};
  }

 private:
  static double SquaredTransferError(const Eigen::Matrix3d& h,
                                     const Eigen::Vector2d& from,
                                     const Eigen::Vector2d& to) {
    const double w = h(2, 0) * from.x() + h(2, 1) * from.y() + h(2, 2);
    if (w == 0.0) return std::numeric_limits<double>::infinity();
    const double dx = (h(0, 0) * from.x() + h(0, 1) * from.y() + h(0, 2)) / w - to.x();
    const double dy = (h(1, 0) * from.x() + h(1, 1) * from.y() + h(1, 2)) / w - to.y();
    return dx * dx + dy * dy;
  }

  const Matches& matches_;
};

// Poses farther apart than this are two different ones.
constexpr double kMinTurnRad = 0.01;
constexpr double kMinDirectionRad = 0.1;

struct Candidate {
  TwoViewResult::Model model;
  Rigid3 cam2_from_cam1;
  TwoViewSupport support;
};

RansacOptions SearchOptions(const TwoViewOptions& options) {
  constexpr int kMinIterations = 30;
  return {options.max_error,
          options.confidence,
          kMinIterations,
          options.max_iterations,
          options.random_seed};
}

// The poses that both models allow, with the counts of the models' inliers.
std::vector<Candidate> FindCandidates(const TwoViewOptions& options,
                                      const Matches& matches,
                                      TwoViewResult* counts) {
  std::vector<Candidate> candidates;
  const auto add = [&](TwoViewResult::Model model, const Rigid3& pose) {
    candidates.push_back({model, pose, SupportOf(pose, matches, options.max_error)});
  };
  const EssentialProblem essential_problem(matches, options.max_error);
  if (const auto best = Ransac<EssentialProblem>(SearchOptions(options), essential_problem).Run()) {
    counts->num_essential_inliers = best->num_inliers;
    for (const Rigid3& pose : PosesFromEssential(best->model)) {
      add(TwoViewResult::Model::kEssential, pose);
    }
  }
  const HomographyProblem homography_problem(matches);
  if (const auto best =
          Ransac<HomographyProblem>(SearchOptions(options), homography_problem).Run()) {
    counts->num_homography_inliers = best->num_inliers;
    for (const Rigid3& pose : PosesFromHomography(best->model.xy2_from_xy1)) {
      add(TwoViewResult::Model::kHomography, pose);
    }
  }
  return candidates;
}

Matches InliersOf(const Matches& matches, const TwoViewSupport& support) {
  Matches inliers;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (support.is_inlier[i]) inliers.push_back(matches[i]);
  }
  return inliers;
}

// Refines a pose on its inliers until they no longer change for the better.
void RefineCandidate(const Matches& matches, double max_error, Candidate* candidate) {
  constexpr int kMaxRounds = 4;
  constexpr int kMaxIterations = 10;
  for (int round = 0; round < kMaxRounds; ++round) {
    const Rigid3 pose = MinimizeSampsonError(candidate->cam2_from_cam1,
                                             InliersOf(matches, candidate->support),
                                             max_error,
                                             kMaxIterations);
    TwoViewSupport support = SupportOf(pose, matches, max_error);
    if (!(support.cost < candidate->support.cost)) return;
    candidate->cam2_from_cam1 = pose;
    candidate->support = std::move(support);
  }
}

// Whether two poses, each a local optimum, are not the same one.
bool AreDifferent(const Rigid3& a, const Rigid3& b) {
  return a.rotation.angularDistance(b.rotation) > kMinTurnRad ||
         std::acos(std::clamp(a.translation.dot(b.translation), -1.0, 1.0)) > kMinDirectionRad;
}

// Whether poses that differ from a candidate by little in their errors differ by much from it:
// too few matches, too near to each other, or with too little parallax.
bool IsUncertain(const Matches& matches, double max_error, const Candidate& candidate) {
  constexpr double kErrorSigma = 1.0 / 3.0;  // Of max_error, as the bound is usually chosen.
  const RelativePoseSigmas sigmas = SigmasOf(
      candidate.cam2_from_cam1, InliersOf(matches, candidate.support), kErrorSigma * max_error);
  return !(sigmas.turn_rad < kMinTurnRad && sigmas.direction_rad < kMinDirectionRad);
}

bool HasTwin(const std::vector<Candidate>& candidates, const Candidate& best) {
  // A twin of a plane with some relief loses the matches off the plane; one that loses
  // fewer than a tenth may be the true one.
  constexpr double kNearly = 0.9;
  return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
    return other.support.num_inliers >= kNearly * best.support.num_inliers &&
           AreDifferent(other.cam2_from_cam1, best.cam2_from_cam1);
  });
}

}  // namespace

std::optional<TwoViewResult> EstimateTwoView(const TwoViewOptions& options,
                                             const std::vector<Eigen::Vector2d>& xy1,
                                             const std::vector<Eigen::Vector2d>& xy2) {
  constexpr int kMinInliers = 8;  // Five fit some pose always, a few more by chance.
  constexpr double kWorthRefining = 0.5;
  PLUMB_CHECK_EQ(xy1.size(), xy2.size());
  PLUMB_CHECK_GT(options.max_error, 0.0);
  PLUMB_CHECK_GT(options.confidence, 0.0);
  PLUMB_CHECK_LT(options.confidence, 1.0);
  Matches matches;
  matches.reserve(xy1.size());
  for (std::size_t i = 0; i < xy1.size(); ++i) matches.push_back({xy1[i], xy2[i]});

  TwoViewResult result;
  std::vector<Candidate> candidates = FindCandidates(options, matches, &result);
  int most_inliers = 0;
  for (const Candidate& candidate : candidates) {
    most_inliers = std::max(most_inliers, candidate.support.num_inliers);
  }
  candidates.erase(std::remove_if(candidates.begin(),
                                  candidates.end(),
                                  [&](const Candidate& candidate) {
                                    return candidate.support.num_inliers <
                                           kWorthRefining * most_inliers;
                                  }),
                   candidates.end());
  for (Candidate& candidate : candidates) RefineCandidate(matches, options.max_error, &candidate);
  const auto best = std::min_element(
      candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.support.cost < b.support.cost;
      });
  if (best == candidates.end() || best->support.num_inliers < kMinInliers) return std::nullopt;
  result.model = best->model;
  result.cam2_from_cam1 = best->cam2_from_cam1;
  result.num_inliers = best->support.num_inliers;
  result.is_inlier = best->support.is_inlier;
  result.median_parallax_rad = MedianParallax(result.cam2_from_cam1, matches, result.is_inlier);
  result.is_ambiguous =
      HasTwin(candidates, *best) || IsUncertain(matches, options.max_error, *best);
  return result;
}

}  // namespace plumb
