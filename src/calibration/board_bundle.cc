// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/board_bundle.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>

#include "calibration/board_costs.h"

namespace plumb {
namespace {

using PoseBlock = std::array<double, 6>;

// Standard deviations of what a lens is expected to be like. Weak: they only hold what the
// photos do not tell. Each radial term at the image's corner, as a share of the radius there.
constexpr double kRadialSigma = 0.3;
constexpr double kTangentialSigma = 0.02;
constexpr double kPrincipalSigmaPerWidth = 0.1;
constexpr double kAspectSigma = 0.05;
// What a printer does to a grid, as shares, and to a single marker, in marker diameters.
constexpr double kStretchSigma = 0.01;
constexpr double kShearSigma = 0.002;
constexpr double kPrintSigma = 0.003;

// Upper triangular U with U^T U = covariance^-1.
Eigen::Matrix2d SqrtInformation(const Eigen::Matrix2d& covariance) {
  return covariance.inverse().llt().matrixU();
}

class Bundle {
 public:
  Bundle(const Board& board, const BoardBundleSettings& settings, const BoardState& state)
      : board_(board),
        settings_(settings),
        loss_(settings.robust_width),
        lens_(state.lens),
        centers_(state.centers_in_plane),
        sheet_{state.stretch, state.shear} {
    lens_[kAspect] = settings.has_square_pixels ? 1.0 : state.lens[kFy] / state.lens[kFx];
    for (const Rigid3& cam_from_plane : state.cams_from_plane) {
      references_.push_back(cam_from_plane.rotation.toRotationMatrix());
      const Eigen::Vector3d& t = cam_from_plane.translation;
      poses_.push_back({0.0, 0.0, 0.0, t.x(), t.y(), t.z()});
    }
    is_pose_used_.assign(poses_.size(), 0);
    is_center_used_.assign(centers_.size(), 0);
    for (const MarkerView& view : board.views) {
      if (view.is_wrong) continue;
      is_pose_used_[static_cast<std::size_t>(view.photo_idx)] = 1;
      is_center_used_[static_cast<std::size_t>(view.marker_idx)] = 1;
    }
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    problem_ = std::make_unique<ceres::Problem>(options);
    AddBlocks();
    AddViews();
    AddLensPrior();
    AddCenterPriors();
  }

  BoardBundleReport Solve() {
    ceres::Solver::Options options;
    options.max_num_iterations = settings_.max_iterations;
    options.function_tolerance = 1e-9;
    options.num_threads = settings_.num_threads;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    // Poses do not meet one another in a residual, nor do centres: the larger set is eliminated.
    const int pose_group = 6 * poses_.size() > 3 * centers_.size() ? 0 : 1;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (is_pose_used_[i] == 0) continue;
      options.linear_solver_ordering->AddElementToGroup(poses_[i].data(), pose_group);
    }
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if (is_center_used_[i] == 0) continue;
      options.linear_solver_ordering->AddElementToGroup(centers_[i].data(), 1 - pose_group);
    }
    options.linear_solver_ordering->AddElementToGroup(lens_.data(), 1);
    if (!board_.printed.empty()) options.linear_solver_ordering->AddElementToGroup(sheet_, 1);
    ceres::Solver::Summary summary;
    ceres::Solve(options, problem_.get(), &summary);
    return {summary.IsSolutionUsable(), summary.final_cost};
  }

  void WriteTo(BoardState* state) const {
    state->lens = lens_;
    state->lens[kFy] = lens_[kFx] * lens_[kAspect];
    state->centers_in_plane = centers_;
    state->stretch = sheet_[0];
    state->shear = sheet_[1];
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      Eigen::Matrix3d turn;
      ceres::AngleAxisToRotationMatrix(poses_[i].data(), turn.data());
      state->cams_from_plane[i] = {Eigen::Quaterniond(turn * references_[i]),
                                   {poses_[i][3], poses_[i][4], poses_[i][5]}};
    }
  }

  Eigen::MatrixXd Covariance();

 private:
  void AddBlocks() {
    problem_->AddParameterBlock(lens_.data(), kNumLensParameters);
    std::vector<int> held;
    for (int i = 0; i < kNumLensParameters; ++i) {
      const bool is_held = i == kAspect && settings_.has_square_pixels;
      if (is_held || !settings_.is_free[static_cast<std::size_t>(i)]) held.push_back(i);
    }
    if (held.size() == kNumLensParameters) {
      problem_->SetParameterBlockConstant(lens_.data());
    } else if (!held.empty()) {
      problem_->SetManifold(lens_.data(), new ceres::SubsetManifold(kNumLensParameters, held));
    }
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (is_pose_used_[i] != 0) problem_->AddParameterBlock(poses_[i].data(), 6);
    }
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if (is_center_used_[i] != 0) problem_->AddParameterBlock(centers_[i].data(), 3);
    }
    if (!board_.printed.empty()) problem_->AddParameterBlock(sheet_, 2);
    HoldPlane();
  }

  // Where markers are strewn, two that are far apart hold place, direction and scale. The heights'
  // priors hold the rest.
  void HoldPlane() {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if (is_center_used_[i] != 0) used.push_back(i);
    }
    std::array<std::size_t, 2> anchors{0, 0};
    double farthest = 0.0;
    for (const std::size_t i : used) {
      for (const std::size_t k : used) {
        const double distance = (centers_[i] - centers_[k]).squaredNorm();
        if (distance <= farthest) continue;
        farthest = distance;
        anchors = {i, k};
      }
    }
    for (const std::size_t i : used) {
      const bool is_anchor = board_.printed.empty() && (i == anchors[0] || i == anchors[1]);
      double* center = centers_[i].data();
      if (is_anchor && settings_.is_flat) {
        problem_->SetParameterBlockConstant(center);
      } else if (is_anchor) {
        problem_->SetManifold(center, new ceres::SubsetManifold(3, {0, 1}));
      } else if (settings_.is_flat) {
        problem_->SetManifold(center, new ceres::SubsetManifold(3, {2}));
      }
    }
  }

  void AddViews() {
    using Cost = ceres::AutoDiffCostFunction<CenterCost, 2, kNumLensParameters, 6, 3>;
    for (const MarkerView& view : board_.views) {
      if (view.is_wrong) continue;
      const auto photo = static_cast<std::size_t>(view.photo_idx);
      const auto marker = static_cast<std::size_t>(view.marker_idx);
      auto* cost =
          new Cost(new CenterCost{view.pixel,
                                  SqrtInformation(view.covariance_px2) / settings_.noise_factor,
                                  &references_[photo]});
      problem_->AddResidualBlock(
          cost, &loss_, lens_.data(), poses_[photo].data(), centers_[marker].data());
    }
  }

  void AddLensPrior() {
    using Prior = PriorCost<kNumLensParameters>;
    const double radius =
        0.5 * std::hypot(board_.width_px, board_.height_px) / settings_.prior_focal_px;
    const double radius2 = radius * radius;
    Prior prior;
    prior.expected.setZero();
    prior.weight.setZero();
    prior.expected(kAspect) = 1.0;
    prior.weight(kAspect) = 1.0 / kAspectSigma;
    prior.expected(kCx) = 0.5 * (board_.width_px - 1);
    prior.expected(kCy) = 0.5 * (board_.height_px - 1);
    prior.weight(kCx) = prior.weight(kCy) = 1.0 / (kPrincipalSigmaPerWidth * board_.width_px);
    prior.weight(kP1) = prior.weight(kP2) = radius / kTangentialSigma;
    prior.weight(kK1) = prior.weight(kK4) = radius2 / kRadialSigma;
    prior.weight(kK2) = prior.weight(kK5) = radius2 * radius2 / kRadialSigma;
    prior.weight(kK3) = prior.weight(kK6) = radius2 * radius2 * radius2 / kRadialSigma;
    problem_->AddResidualBlock(
        new ceres::AutoDiffCostFunction<Prior, kNumLensParameters, kNumLensParameters>(
            new Prior(prior)),
        nullptr,
        lens_.data());
  }

  void AddCenterPriors() {
    using Printed = ceres::AutoDiffCostFunction<PrintedCost, 2, 3, 2>;
    for (std::size_t i = 0; i < board_.printed.size(); ++i) {
      if (is_center_used_[i] == 0) continue;
      problem_->AddResidualBlock(new Printed(new PrintedCost{board_.printed[i], 1.0 / kPrintSigma}),
                                 nullptr,
                                 centers_[i].data(),
                                 sheet_);
    }
    if (!board_.printed.empty()) {
      problem_->AddResidualBlock(
          new ceres::AutoDiffCostFunction<PriorCost<2>, 2, 2>(
              new PriorCost<2>{{1.0, 0.0}, {1.0 / kStretchSigma, 1.0 / kShearSigma}}),
          nullptr,
          sheet_);
    }
    if (settings_.is_flat) return;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if (is_center_used_[i] == 0) continue;
      problem_->AddResidualBlock(
          new ceres::AutoDiffCostFunction<PriorCost<3>, 3, 3>(new PriorCost<3>{
              Eigen::Vector3d::Zero(), Eigen::Vector3d(0.0, 0.0, 1.0 / settings_.height_sigma)}),
          nullptr,
          centers_[i].data());
    }
  }

  const Board& board_;
  const BoardBundleSettings& settings_;
  ceres::CauchyLoss loss_;
  LensParameters<double> lens_;
  std::vector<Eigen::Matrix3d> references_;
  std::vector<PoseBlock> poses_;
  std::vector<Eigen::Vector3d> centers_;
  double sheet_[2];
  std::vector<char> is_pose_used_;
  std::vector<char> is_center_used_;
  std::unique_ptr<ceres::Problem> problem_;
};

// Columns of the tangent space are put back to where they stand in `full_size` values.
std::vector<int> TangentPlaces(const ceres::Problem& problem, const double* block, int full_size) {
  std::vector<int> places;
  if (problem.IsParameterBlockConstant(block)) return places;
  const ceres::Manifold* manifold = problem.GetManifold(block);
  if (manifold == nullptr) {
    for (int i = 0; i < full_size; ++i) places.push_back(i);
    return places;
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> plus(
      full_size, manifold->TangentSize());
  manifold->PlusJacobian(block, plus.data());
  for (int k = 0; k < plus.cols(); ++k) {
    int place = 0;
    plus.col(k).maxCoeff(&place);
    places.push_back(place);
  }
  return places;
}

Eigen::MatrixXd Bundle::Covariance() {
  ceres::Problem::EvaluateOptions options;
  std::vector<int> rows_of_interest(static_cast<std::size_t>(kNumLensParameters) + centers_.size(),
                                    -1);
  int column = 0;
  if (!problem_->IsParameterBlockConstant(lens_.data())) {
    options.parameter_blocks.push_back(lens_.data());
    for (const int place : TangentPlaces(*problem_, lens_.data(), kNumLensParameters)) {
      rows_of_interest[static_cast<std::size_t>(place)] = column++;
    }
  }
  for (std::size_t i = 0; i < centers_.size(); ++i) {
    if (is_center_used_[i] == 0) continue;
    if (problem_->IsParameterBlockConstant(centers_[i].data())) continue;
    options.parameter_blocks.push_back(centers_[i].data());
    for (const int place : TangentPlaces(*problem_, centers_[i].data(), 3)) {
      if (place == 2) rows_of_interest[kNumLensParameters + i] = column;
      ++column;
    }
  }
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (is_pose_used_[i] != 0) options.parameter_blocks.push_back(poses_[i].data());
  }
  if (!board_.printed.empty()) options.parameter_blocks.push_back(sheet_);
  ceres::CRSMatrix jacobian;
  if (!problem_->Evaluate(options, nullptr, nullptr, nullptr, &jacobian)) return {};
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(jacobian.num_cols, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    const auto begin = static_cast<std::size_t>(jacobian.rows[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(jacobian.rows[static_cast<std::size_t>(row) + 1]);
    for (std::size_t a = begin; a < end; ++a) {
      for (std::size_t b = begin; b < end; ++b) {
        normal(jacobian.cols[a], jacobian.cols[b]) += jacobian.values[a] * jacobian.values[b];
      }
    }
  }
  // Pixels and coefficients differ by many powers of ten.
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> solver(scale.asDiagonal() * normal * scale.asDiagonal());
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-14)) return {};
  const Eigen::MatrixXd all =
      scale.asDiagonal() * solver.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols())) *
      scale.asDiagonal();
  const auto size = static_cast<Eigen::Index>(rows_of_interest.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index a = 0; a < size; ++a) {
    for (Eigen::Index b = 0; b < size; ++b) {
      const int row = rows_of_interest[static_cast<std::size_t>(a)];
      const int col = rows_of_interest[static_cast<std::size_t>(b)];
      if (row >= 0 && col >= 0) covariance(a, b) = all(row, col);
    }
  }
  return covariance;
}

}  // namespace

BoardBundleReport SolveBoard(const Board& board,
                             const BoardBundleSettings& settings,
                             BoardState* state) {
  for (const MarkerView& view : board.views) {
    if (!view.is_wrong && !PixelResidual(view, *state).allFinite()) return {};
  }
  Bundle bundle(board, settings, *state);
  const BoardBundleReport report = bundle.Solve();
  if (report.is_usable) bundle.WriteTo(state);
  return report;
}

Eigen::MatrixXd BoardCovariance(const Board& board,
                                const BoardBundleSettings& settings,
                                const BoardState& state) {
  Eigen::MatrixXd covariance = Bundle(board, settings, state).Covariance();
  if (covariance.size() == 0) return covariance;
  // From (f, fy / f) to (fx, fy).
  const double aspect = settings.has_square_pixels ? 1.0 : state.lens[kFy] / state.lens[kFx];
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols());
  jacobian(kFy, kFx) = aspect;
  jacobian(kFy, kAspect) = state.lens[kFx];
  return jacobian * covariance * jacobian.transpose();
}

Eigen::Vector2d PixelResidual(const MarkerView& view, const BoardState& state) {
  const Eigen::Vector3d in_cam = state.cams_from_plane[static_cast<std::size_t>(view.photo_idx)] *
                                 state.centers_in_plane[static_cast<std::size_t>(view.marker_idx)];
  if (!(in_cam.z() > 1e-6)) {
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  }
  Eigen::Vector2d projected;
  ProjectToPixel(state.lens.data(), in_cam.data(), projected.data());
  return view.pixel - projected;
}

Eigen::Vector2d WhitenedResidual(const MarkerView& view, const BoardState& state) {
  return SqrtInformation(view.covariance_px2) * PixelResidual(view, state);
}

}  // namespace plumb
