// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/result_tables.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/board_bundle.h"
#include "calibration/lens_accuracy.h"
#include "calibration/sheet_point.h"
#include "plumbline/marker/marker_sheet.h"

namespace plumb {
namespace {

constexpr double kDegPerRad = 180.0 / M_PI;

LensEstimate MakeEstimate(const BoardSolution& solution, const std::string& camera_name) {
  const Camera& camera = solution.camera;
  LensEstimate estimate{
      Camera(camera_name, camera.width_px(), camera.height_px(), camera.model(), camera.lens())};
  for (int i = 0; i < kNumLensParameters; ++i) {
    estimate.sigma[static_cast<std::size_t>(i)] =
        std::sqrt(std::max(0.0, solution.covariance(i, i)));
  }
  estimate.focal_sigma_percent = 100.0 * estimate.sigma[kFx] / camera.lens()[kFx];
  estimate.principal_sigma_px = std::max(estimate.sigma[kCx], estimate.sigma[kCy]);
  estimate.distortion_sigma_px =
      DistortionSigma(camera.width_px(), camera.height_px(), camera.lens(), solution.covariance);
  return estimate;
}

// Middle of the markers that count; heights stay.
Eigen::Vector3d MiddleOf(const BoardSolution& solution) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < solution.is_marker_out.size(); ++i) {
    if (solution.is_marker_out[i] != 0) continue;
    middle += solution.state.centers_in_plane[i];
    ++count;
  }
  if (count == 0) return Eigen::Vector3d::Zero();
  middle /= count;
  middle.z() = 0.0;
  return middle;
}

class TableWriter {
 public:
  TableWriter(const std::vector<CalibrationPhoto>& photos,
              const BoardIntake& intake,
              const BoardSolution& solution,
              double unit,
              CalibrationResult* result)
      : photos_(photos),
        intake_(intake),
        solution_(solution),
        unit_(unit),
        middle_(MiddleOf(solution)),
        result_(result) {}

  void Write() {
    const std::size_t num_photos = intake_.photo_of_board.size();
    square_of_photo_.assign(num_photos, 0.0);
    square_of_marker_.assign(intake_.marker_ids.size(), 0.0);
    height_sigmas_ = HeightSigmas();
    turns_.assign(intake_.marker_ids.size(), Eigen::Vector2d::Zero());
    for (std::size_t i = 0; i < solution_.board.views.size(); ++i) WriteView(i);
    for (std::size_t i = 0; i < num_photos; ++i) WritePhoto(i);
    for (std::size_t i = 0; i < intake_.marker_ids.size(); ++i) WriteMarker(i);
    const int num_right = static_cast<int>(
        std::count_if(result_->residuals.begin(),
                      result_->residuals.end(),
                      [](const CalibrationResidual& residual) { return !residual.is_wrong; }));
    double sum = 0.0;
    for (const double square : square_of_photo_) sum += square;
    result_->rms_px = num_right > 0 ? std::sqrt(sum / num_right) : 0.0;
  }

 private:
  void WriteView(std::size_t idx) {
    const MarkerView& view = solution_.board.views[idx];
    const auto photo = static_cast<std::size_t>(view.photo_idx);
    const auto marker = static_cast<std::size_t>(view.marker_idx);
    CalibratedPhoto& photo_row = result_->photos[intake_.photo_of_board[photo]];
    CalibratedMarker& marker_row = result_->markers[marker];
    ++photo_row.num_markers;
    ++marker_row.num_photos;
    if (view.is_wrong) {
      ++photo_row.num_wrong;
      ++marker_row.num_wrong;
    }
    if (solution_.is_photo_out[photo] != 0 || solution_.is_marker_out[marker] != 0) return;
    CalibrationResidual residual;
    residual.photo_idx = static_cast<int>(intake_.photo_of_board[photo]);
    residual.marker_idx = view.marker_idx;
    residual.pixel = view.pixel;
    residual.residual_px = PixelResidual(view, solution_.state);
    residual.sigmas = WhitenedResidual(view, solution_.state).norm() / solution_.noise_factor;
    residual.is_wrong = view.is_wrong;
    if (!residual.residual_px.allFinite()) return;
    result_->residuals.push_back(residual);
    if (view.is_wrong) return;
    square_of_photo_[photo] += residual.residual_px.squaredNorm();
    square_of_marker_[marker] += residual.residual_px.squaredNorm();
    AddTurn(idx);
  }

  // The direction of a marker's x axis in the plane.
  void AddTurn(std::size_t idx) {
    const MarkerView& view = solution_.board.views[idx];
    const std::size_t photo = intake_.photo_of_board[static_cast<std::size_t>(view.photo_idx)];
    const MarkerDetection& detection = photos_[photo].markers[intake_.detection_of_view[idx]];
    const Eigen::Matrix3d& h = detection.pixel_from_marker;
    const Eigen::Vector2d along =
        (h * Eigen::Vector3d(0.5, 0.0, 1.0)).hnormalized() - h.col(2).hnormalized();
    const auto from = PointInPlane(solution_, view.photo_idx, view.pixel, 0.0);
    const auto to = PointInPlane(solution_, view.photo_idx, view.pixel + along, 0.0);
    if (!from || !to || !((*to - *from).norm() > 0.0)) return;
    turns_[static_cast<std::size_t>(view.marker_idx)] += (*to - *from).normalized();
  }

  void WritePhoto(std::size_t idx) {
    CalibratedPhoto& row = result_->photos[intake_.photo_of_board[idx]];
    row.is_used = solution_.is_photo_out[idx] == 0;
    if (!row.is_used) return;
    const Rigid3& cam_from_plane = solution_.state.cams_from_plane[idx];
    row.cam_from_plane = {cam_from_plane.rotation, unit_ * (cam_from_plane * middle_)};
    row.rms_px = std::sqrt(square_of_photo_[idx] / std::max(1, row.num_markers - row.num_wrong));
    const Eigen::Vector3d normal = cam_from_plane.rotation * Eigen::Vector3d::UnitZ();
    row.tilt_deg = std::acos(std::clamp(std::abs(normal.z()), 0.0, 1.0)) * kDegPerRad;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    int count = 0;
    for (const MarkerView& view : solution_.board.views) {
      if (static_cast<std::size_t>(view.photo_idx) != idx || view.is_wrong) continue;
      middle += solution_.state.centers_in_plane[static_cast<std::size_t>(view.marker_idx)];
      ++count;
    }
    if (count > 0) row.distance = unit_ * (cam_from_plane * (middle / count)).norm();
  }

  // Standard deviations of the heights against the plane through all of them: place and slope of
  // the plane itself are held by the heights' prior only.
  Eigen::VectorXd HeightSigmas() const {
    std::vector<Eigen::Index> used;
    for (std::size_t i = 0; i < solution_.is_marker_out.size(); ++i) {
      if (solution_.is_marker_out[i] == 0) used.push_back(static_cast<Eigen::Index>(i));
    }
    const auto count = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd covariance(count, count);
    Eigen::MatrixXd plane(count, 3);
    for (Eigen::Index a = 0; a < count; ++a) {
      const Eigen::Index row = used[static_cast<std::size_t>(a)];
      const Eigen::Vector3d& center =
          solution_.state.centers_in_plane[static_cast<std::size_t>(row)];
      plane.row(a) << center.x(), center.y(), 1.0;
      for (Eigen::Index b = 0; b < count; ++b) {
        covariance(a, b) = solution_.covariance(
            kNumLensParameters + row, kNumLensParameters + used[static_cast<std::size_t>(b)]);
      }
    }
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(count, count) -
                                 plane * plane.completeOrthogonalDecomposition().pseudoInverse();
    const Eigen::MatrixXd relative = left * covariance * left.transpose();
    Eigen::VectorXd sigmas =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(solution_.is_marker_out.size()));
    for (Eigen::Index a = 0; a < count; ++a) {
      sigmas(used[static_cast<std::size_t>(a)]) = std::sqrt(std::max(0.0, relative(a, a)));
    }
    return sigmas;
  }

  void WriteMarker(std::size_t idx) {
    CalibratedMarker& row = result_->markers[idx];
    row.is_used = solution_.is_marker_out[idx] == 0;
    if (!row.is_used) return;
    row.center_in_plane = unit_ * (solution_.state.centers_in_plane[idx] - middle_);
    row.height_sigma = unit_ * height_sigmas_(static_cast<Eigen::Index>(idx));
    row.rms_px = std::sqrt(square_of_marker_[idx] / std::max(1, row.num_photos - row.num_wrong));
    row.angle_rad = std::atan2(turns_[idx].y(), turns_[idx].x());
  }

  const std::vector<CalibrationPhoto>& photos_;
  const BoardIntake& intake_;
  const BoardSolution& solution_;
  double unit_;
  Eigen::Vector3d middle_;
  CalibrationResult* result_;
  std::vector<double> square_of_photo_;
  std::vector<double> square_of_marker_;
  std::vector<Eigen::Vector2d> turns_;
  Eigen::VectorXd height_sigmas_;
};

}  // namespace

double LengthUnit(const CalibrationOptions& options) {
  if (!options.fixed_grid.empty()) {
    const Paper paper = options.fixed_grid == "a3" ? Paper::kA3 : Paper::kA4;
    return 0.001 * LayOutGrid(paper, Arrangement::kFixed, options.first_id).diameter_mm;
  }
  return options.marker_diameter_m > 0.0 ? options.marker_diameter_m : 1.0;
}

void FillNames(const CalibrationOptions& options,
               const std::vector<CalibrationPhoto>& photos,
               const BoardIntake& intake,
               CalibrationResult* result) {
  result->is_metric = !options.fixed_grid.empty() || options.marker_diameter_m > 0.0;
  for (const CalibrationPhoto& photo : photos) {
    result->photos.emplace_back();
    result->photos.back().name = photo.name;
    result->photos.back().num_found = static_cast<int>(photo.markers.size());
  }
  for (const int id : intake.marker_ids) {
    result->markers.emplace_back();
    result->markers.back().id = id;
  }
}

void FillEstimate(const CalibrationOptions& options,
                  const std::vector<CalibrationPhoto>& photos,
                  const BoardIntake& intake,
                  const BoardSolution& solution,
                  const std::string& camera_name,
                  CalibrationResult* result) {
  result->estimate = MakeEstimate(solution, camera_name);
  result->noise_factor = solution.noise_factor;
  TableWriter(photos, intake, solution, LengthUnit(options), result).Write();
}

}  // namespace plumb
