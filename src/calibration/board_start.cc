// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/board_start.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibration/sheet_pose.h"

namespace plumb {
namespace {

constexpr std::size_t kMinShared = 3;    // Two lay a plane over another, one checks.
constexpr double kSameDiameters = 0.35;  // Shapes alone place a marker as well as that.
constexpr double kMinPairDiameters = 0.8;

// plane_from_sheet = scale [c -s; s c] x + shift.
struct PlaneSimilarity {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const { return linear * point + shift; }
};

struct SharedCenter {
  Eigen::Vector2d in_sheet;
  Eigen::Vector2d in_plane;
};

// Least squares (Umeyama, TPAMI 13(4), 1991, in the plane), as complex numbers.
PlaneSimilarity FitSimilarity(const std::vector<SharedCenter>& shared) {
  Eigen::Vector2d sheet_mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d plane_mean = Eigen::Vector2d::Zero();
  const auto count = static_cast<double>(shared.size());
  for (const SharedCenter& center : shared) {
    sheet_mean += center.in_sheet / count;
    plane_mean += center.in_plane / count;
  }
  double real = 0.0;
  double imaginary = 0.0;
  double norm = 0.0;
  for (const SharedCenter& center : shared) {
    const Eigen::Vector2d a = center.in_sheet - sheet_mean;
    const Eigen::Vector2d b = center.in_plane - plane_mean;
    real += a.dot(b);
    imaginary += a.x() * b.y() - a.y() * b.x();
    norm += a.squaredNorm();
  }
  PlaneSimilarity similarity;
  similarity.linear << real, -imaginary, imaginary, real;
  similarity.linear /= norm;
  similarity.shift = plane_mean - similarity.linear * sheet_mean;
  return similarity;
}

std::vector<SharedCenter> Agreeing(const PlaneSimilarity& plane_from_sheet,
                                   const std::vector<SharedCenter>& shared) {
  std::vector<SharedCenter> agreeing;
  for (const SharedCenter& center : shared) {
    // Far off a wrong tilt shows more.
    const double bound = kSameDiameters + 0.05 * center.in_sheet.norm();
    const double off = (plane_from_sheet * center.in_sheet - center.in_plane).norm();
    if (off < bound) agreeing.push_back(center);
  }
  return agreeing;
}

// From every pair of shared centres; the one that most others agree with. Nothing if fewer than
// kMinShared do, or the sizes differ by half.
std::optional<PlaneSimilarity> LayOver(const std::vector<SharedCenter>& shared) {
  if (shared.size() < kMinShared) return std::nullopt;
  std::vector<SharedCenter> best;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if ((shared[i].in_sheet - shared[k].in_sheet).norm() < kMinPairDiameters) continue;
      const PlaneSimilarity candidate = FitSimilarity({shared[i], shared[k]});
      const double scale = std::sqrt(candidate.linear.determinant());
      if (!(scale > 0.6 && scale < 1.6)) continue;
      std::vector<SharedCenter> agreeing = Agreeing(candidate, shared);
      if (agreeing.size() > best.size()) best = std::move(agreeing);
    }
  }
  if (best.size() < kMinShared) return std::nullopt;
  return FitSimilarity(best);
}

class Starter {
 public:
  Starter(const Board& board, double focal_px) : board_(board) {
    const Eigen::Vector2d principal_px(0.5 * (board.width_px - 1), 0.5 * (board.height_px - 1));
    start_.state.lens[kFx] = start_.state.lens[kFy] = focal_px;
    start_.state.lens[kCx] = principal_px.x();
    start_.state.lens[kCy] = principal_px.y();
    views_.resize(static_cast<std::size_t>(board.num_photos));
    for (const MarkerView& view : board.views) {
      if (!view.is_wrong) views_[static_cast<std::size_t>(view.photo_idx)].push_back(view);
    }
    for (const auto& views : views_)
      sheets_.push_back(FindSheetPose(views, focal_px, principal_px));
    start_.state.cams_from_plane.resize(views_.size());
    start_.has_pose.assign(views_.size(), 0);
    seen_.resize(static_cast<std::size_t>(board.num_markers));
    centers_.resize(seen_.size());
    for (std::size_t i = 0; i < board.printed.size(); ++i) centers_[i] = board.printed[i];
  }

  std::optional<BoardStart> Run() {
    if (board_.printed.empty() && !PlaceFirst()) return std::nullopt;
    // The photo that shares most comes next.
    for (std::vector<char> is_tried(views_.size(), 0);;) {
      std::size_t next = views_.size();
      std::size_t most = 0;
      for (std::size_t i = 0; i < views_.size(); ++i) {
        if (start_.has_pose[i] != 0 || is_tried[i] != 0 || !sheets_[i]) continue;
        const std::size_t num_shared = Shared(i).size();
        if (num_shared <= most) continue;
        most = num_shared;
        next = i;
      }
      if (next == views_.size()) break;
      const std::optional<PlaneSimilarity> plane_from_sheet = LayOver(Shared(next));
      if (plane_from_sheet) {
        Place(next, *plane_from_sheet);
        std::fill(is_tried.begin(), is_tried.end(), 0);  // There are more centres now.
      }
      is_tried[next] = 1;
    }
    return Finish();
  }

 private:
  bool PlaceFirst() {
    std::size_t first = views_.size();
    for (std::size_t i = 0; i < views_.size(); ++i) {
      if (!sheets_[i]) continue;
      if (first < views_.size() && views_[i].size() <= views_[first].size()) continue;
      first = i;
    }
    if (first == views_.size()) return false;
    Place(first, {});
    return true;
  }

  std::vector<SharedCenter> Shared(std::size_t photo) const {
    std::vector<SharedCenter> shared;
    for (std::size_t k = 0; k < views_[photo].size(); ++k) {
      const auto& center = centers_[static_cast<std::size_t>(views_[photo][k].marker_idx)];
      if (center) shared.push_back({sheets_[photo]->centers_in_sheet[k], *center});
    }
    return shared;
  }

  void Place(std::size_t photo, const PlaneSimilarity& plane_from_sheet) {
    const double scale = std::sqrt(plane_from_sheet.linear.determinant());
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = plane_from_sheet.linear / scale;
    const Eigen::Vector3d shift(plane_from_sheet.shift.x(), plane_from_sheet.shift.y(), 0.0);
    const Rigid3 sheet_from_plane = Rigid3(Eigen::Quaterniond(turn), shift).Inverse();
    Rigid3 cam_from_scaled = sheets_[photo]->cam_from_sheet;
    cam_from_scaled.translation *= scale;
    start_.state.cams_from_plane[photo] = cam_from_scaled * sheet_from_plane;
    start_.has_pose[photo] = 1;
    for (std::size_t k = 0; k < views_[photo].size(); ++k) {
      const auto marker = static_cast<std::size_t>(views_[photo][k].marker_idx);
      seen_[marker].push_back(plane_from_sheet * sheets_[photo]->centers_in_sheet[k]);
      if (!centers_[marker]) centers_[marker] = seen_[marker].back();
    }
  }

  // Where markers are strewn, the median of where the photos place each.
  std::optional<BoardStart> Finish() {
    start_.has_center.assign(centers_.size(), 0);
    start_.state.centers_in_plane.assign(centers_.size(), Eigen::Vector3d::Zero());
    bool has_any = false;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if (seen_[i].empty()) continue;
      start_.has_center[i] = 1;
      has_any = true;
      Eigen::Vector2d center = *centers_[i];
      if (board_.printed.empty()) {
        for (const int axis : {0, 1}) center(axis) = MedianAlong(seen_[i], axis);
      }
      start_.state.centers_in_plane[i] << center, 0.0;
    }
    if (!has_any) return std::nullopt;
    return start_;
  }

  static double MedianAlong(const std::vector<Eigen::Vector2d>& points, int axis) {
    std::vector<double> values;
    for (const Eigen::Vector2d& point : points) values.push_back(point(axis));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  const Board& board_;
  BoardStart start_;
  std::vector<std::vector<MarkerView>> views_;  // Of each photo.
  std::vector<std::optional<SheetPose>> sheets_;
  std::vector<std::vector<Eigen::Vector2d>> seen_;       // Of each marker, in the plane.
  std::vector<std::optional<Eigen::Vector2d>> centers_;  // As far as known.
};

}  // namespace

std::optional<BoardStart> StartBoard(const Board& board, double focal_px) {
  return Starter(board, focal_px).Run();
}

}  // namespace plumb
