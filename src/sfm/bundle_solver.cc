// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <ceres/ceres.h>

#include <array>
#include <memory>
#include <vector>

#include "plumbline/sfm/bundle_problem.h"
#include "sfm/measured_position_cost.h"
#include "sfm/reprojection_cost.h"

namespace plumb {
namespace {

// Above this many free views the reduced camera matrix is sparse enough for SuiteSparse to win.
constexpr int kMaxDenseViews = 60;

// Measured positions that hold a gauge of seven degrees of freedom.
constexpr std::size_t kAnchors = 3;

class CancelCallback : public ceres::IterationCallback {
 public:
  explicit CancelCallback(const std::atomic<bool>* cancel) : cancel_(cancel) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return *cancel_ ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::atomic<bool>* cancel_;
};

// The parameter blocks of a problem and the Ceres problem over them.
class Solver {
 public:
  Solver(const BundleOptions& options, BundleProblem* problem)
      : options_(options), bundle_(*problem), loss_(options.huber_width_px) {
    ceres::Problem::Options ceres_options;
    ceres_options.cost_function_ownership = ceres::TAKE_OWNERSHIP;
    ceres_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres_options.manifold_ownership = ceres::TAKE_OWNERSHIP;
    ceres_options.disable_all_safety_checks = true;
    ceres_ = std::make_unique<ceres::Problem>(ceres_options);
    FillBlocks();
    AddFeatures();
    AddMarkers();
    AddCenters();
    HoldLens();
    HoldViews();
  }

  BundleReport Solve(int max_iterations,
                     double function_tolerance,
                     const std::atomic<bool>* cancel) {
    ceres::Solver::Options options = SolverOptions(max_iterations, function_tolerance);
    CancelCallback callback(cancel);
    if (cancel != nullptr) options.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(options, ceres_.get(), &summary);

    BundleReport report;
    report.is_usable = summary.IsSolutionUsable();
    report.num_iterations = summary.num_successful_steps;
    report.initial_cost = summary.initial_cost;
    report.final_cost = summary.final_cost;
    if (report.is_usable) WriteBack();
    return report;
  }

 private:
  bool RefinesLens() const {
    return options_.refine_focal_length || options_.refine_principal_point ||
           options_.refine_distortion;
  }

  void FillBlocks() {
    for (const BundleView& view : bundle_.views) {
      references_.push_back(view.cam_from_map.rotation.toRotationMatrix());
      const Eigen::Vector3d center = view.cam_from_map.TargetOriginInSource();
      poses_.push_back({0.0, 0.0, 0.0, center.x(), center.y(), center.z()});
    }
    lens_ = bundle_.lens;
  }

  void AddFeatures() {
    for (const BundleObservation& observation : bundle_.observations) {
      AddReprojection(observation.view_idx,
                      observation.pixel,
                      observation.weight,
                      &bundle_.landmarks[observation.landmark_idx].position_in_map);
    }
  }

  void AddMarkers() {
    for (const BundleSighting& sighting : bundle_.sightings) {
      AddReprojection(sighting.view_idx,
                      sighting.center_px,
                      options_.feature_sigma_px / sighting.sigma_px,
                      &bundle_.markers[sighting.marker_idx].position_in_map);
    }
    for (BundleMarker& marker : bundle_.markers) {
      if (marker.survey) AddMeasured(*marker.survey, marker.position_in_map.data(), 3, 0);
    }
  }

  void AddCenters() {
    for (const BundleCenter& prior : bundle_.centers) {
      AddMeasured(prior.center, poses_[prior.view_idx].data(), kPoseBlockSize, 3);
    }
  }

  void AddReprojection(std::uint32_t view_idx,
                       const Eigen::Vector2d& pixel,
                       double weight,
                       Eigen::Vector3d* position_in_map) {
    const bool refines_lens = RefinesLens();
    auto* cost = new ReprojectionCost(
        pixel, weight, &references_[view_idx], refines_lens ? nullptr : &bundle_.lens);
    std::vector<double*> blocks = {poses_[view_idx].data(), position_in_map->data()};
    if (refines_lens) blocks.push_back(lens_.data());
    ceres_->AddResidualBlock(cost, &loss_, blocks);
  }

  void AddMeasured(const MeasuredPosition& measured, double* block, int block_size, int offset) {
    const double weight = options_.feature_sigma_px / measured.sigma;
    auto* cost = new MeasuredPositionCost(measured.position_in_map, weight, block_size, offset);
    ceres_->AddResidualBlock(cost, &loss_, block);
  }

  // Whether measured positions leave nothing of the gauge open.
  bool IsAnchored() const {
    std::size_t num_measured = bundle_.centers.size();
    for (const BundleMarker& marker : bundle_.markers) num_measured += marker.survey ? 1 : 0;
    return num_measured >= kAnchors;
  }

  void HoldLens() {
    if (!RefinesLens() || !ceres_->HasParameterBlock(lens_.data())) return;
    std::vector<int> held;
    const auto hold = [&](bool is_refined, std::initializer_list<int> parameters) {
      if (is_refined) return;
      for (const int parameter : parameters) held.push_back(parameter);
    };
    hold(options_.refine_focal_length, {kFx, kFy});
    hold(options_.refine_principal_point, {kCx, kCy});
    hold(options_.refine_distortion, {kK1, kK2, kP1, kP2, kK3});
    // The denominator's terms trade against the numerator's over a real lens's field: held.
    hold(false, {kK4, kK5, kK6});
    ceres_->SetManifold(lens_.data(), new ceres::SubsetManifold(kNumLensParameters, held));
  }

  void HoldViews() {
    bool has_fixed = false;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (!bundle_.views[i].is_fixed) continue;
      has_fixed = true;
      if (ceres_->HasParameterBlock(poses_[i].data())) {
        ceres_->SetParameterBlockConstant(poses_[i].data());
      }
    }
    if (!has_fixed && !IsAnchored()) HoldGauge();
  }

  // Seven degrees of freedom: the first view's pose and, for the scale, the largest coordinate
  // of the way to the view farthest from it.
  void HoldGauge() {
    if (poses_.size() < 2) return;
    const Eigen::Map<const Eigen::Vector3d> first(poses_[0].data() + 3);
    std::size_t farthest = 0;
    Eigen::Vector3d longest = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      const Eigen::Vector3d way = Eigen::Map<const Eigen::Vector3d>(poses_[i].data() + 3) - first;
      if (way.squaredNorm() < longest.squaredNorm()) continue;
      longest = way;
      farthest = i;
    }
    int axis = 0;
    longest.cwiseAbs().maxCoeff(&axis);
    if (!ceres_->HasParameterBlock(poses_[0].data()) ||
        !ceres_->HasParameterBlock(poses_[farthest].data())) {
      return;
    }
    ceres_->SetParameterBlockConstant(poses_[0].data());
    ceres_->SetManifold(poses_[farthest].data(),
                        new ceres::SubsetManifold(kPoseBlockSize, {3 + axis}));
  }

  ceres::Solver::Options SolverOptions(int max_iterations, double function_tolerance) {
    ceres::Solver::Options options;
    int num_free = 0;
    for (const BundleView& view : bundle_.views) num_free += view.is_fixed ? 0 : 1;
    options.linear_solver_type =
        num_free <= kMaxDenseViews ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
    options.max_num_iterations = max_iterations;
    options.function_tolerance = function_tolerance;
    options.num_threads = options_.num_threads;
    options.logging_type = ceres::SILENT;
    options.initial_trust_region_radius = options_.initial_trust_radius;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    const auto eliminate_first = [&](double* point) {
      if (ceres_->HasParameterBlock(point))
        options.linear_solver_ordering->AddElementToGroup(point, 0);
    };
    for (auto& landmark : bundle_.landmarks) eliminate_first(landmark.position_in_map.data());
    for (auto& marker : bundle_.markers) eliminate_first(marker.position_in_map.data());
    for (auto& pose : poses_) {
      if (ceres_->HasParameterBlock(pose.data())) {
        options.linear_solver_ordering->AddElementToGroup(pose.data(), 1);
      }
    }
    if (ceres_->HasParameterBlock(lens_.data())) {
      options.linear_solver_ordering->AddElementToGroup(lens_.data(), 1);
    }
    return options;
  }

  void WriteBack() {
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (bundle_.views[i].is_fixed) continue;
      const Eigen::Map<const Eigen::Vector3d> angle_axis(poses_[i].data());
      const Eigen::Map<const Eigen::Vector3d> center(poses_[i].data() + 3);
      const Eigen::Quaterniond rotation(ExpSo3(angle_axis, nullptr) * references_[i]);
      const Eigen::Quaterniond unit = rotation.normalized();
      bundle_.views[i].cam_from_map = Rigid3(unit, -(unit * Eigen::Vector3d(center)));
    }
    if (RefinesLens()) bundle_.lens = lens_;
  }

  const BundleOptions& options_;
  BundleProblem& bundle_;
  ceres::HuberLoss loss_;
  std::vector<Eigen::Matrix3d> references_;
  std::vector<std::array<double, kPoseBlockSize>> poses_;
  LensParameters<double> lens_ = {};
  std::unique_ptr<ceres::Problem> ceres_;
};

}  // namespace

BundleReport SolveBundle(const BundleOptions& options,
                         int max_iterations,
                         double function_tolerance,
                         const std::atomic<bool>* cancel,
                         BundleProblem* problem) {
  ThrowIfProblems("bundle", options.Problems());
  if (problem->observations.empty()) return {};
  BundleProblem solved = *problem;
  const BundleReport report =
      Solver(options, &solved).Solve(max_iterations, function_tolerance, cancel);
  if (report.is_usable) *problem = std::move(solved);
  return report;
}

}  // namespace plumb
