// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/board_refinement.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "calibration/board_bundle.h"
#include "calibration/center_shift.h"
#include "common/median.h"

namespace plumb {
namespace {

constexpr int kNumRounds = 5;
constexpr int kIterationsPerRound = 30;
constexpr int kMinViewsPerPhoto = 4;
constexpr double kMaxWrongOfMarker = 0.3;
constexpr double kMaxWrongOfPhoto = 0.5;
constexpr double kRayleighMedian = 1.1774;  // Of the length of two standard normal values.
// Residuals count to the noise up to so many standard deviations: with 2 nearly half of them may be
// wrong. The mean square of two standard normal values that are cut off there, per value.
constexpr double kNoiseCut = 2.0;
constexpr double kCutMeanSquare = 0.8647;  // 1 - exp(-2).
constexpr int kNoiseIterations = 20;
constexpr double kMinNoiseFactor = 0.3;
constexpr int kMinRedundancy = 8;
constexpr int kMaxTightenings = 4;
constexpr double kTightenFactor = 1.3;

// Views in all and wrong ones, of one photo or marker.
struct Tally {
  int num_views = 0;
  int num_wrong = 0;
};

class Refiner {
 public:
  Refiner(const CalibrationOptions& options,
          const Board& board,
          const std::vector<char>& knows_lens,
          const BoardStart& start)
      : options_(options),
        seen_(board),
        knows_lens_(knows_lens),
        board_(board),
        state_(start.state) {
    for (const char has_pose : start.has_pose) is_photo_out_.push_back(has_pose != 0 ? 0 : 1);
    for (const char has_center : start.has_center)
      is_marker_out_.push_back(has_center != 0 ? 0 : 1);
    settings_.has_square_pixels = options.square_pixels;
    settings_.robust_width = options.robust_width;
    settings_.height_sigma = options.height_sigma;
    settings_.prior_focal_px = start.state.lens[kFx];
    settings_.max_iterations = kIterationsPerRound;
  }

  std::optional<BoardSolution> Run() {
    LeaveOut();
    if (!Start()) return std::nullopt;
    for (int round = 0; round < kNumRounds; ++round) {
      if (!Round()) return std::nullopt;
    }
    // What is judged last is what counts.
    BoardBundleReport report = SolveBoard(board_, settings_, &state_);
    std::optional<Camera> camera = MakeCamera();
    // Terms that the photos do not tell may fold the image. For a wider field the same shares of
    // the radius mean smaller terms; at last the highest ones go.
    for (int i = 0; i < kMaxTightenings && !camera && report.is_usable; ++i) {
      settings_.prior_focal_px /= kTightenFactor;
      report = SolveBoard(board_, settings_, &state_);
      camera = MakeCamera();
    }
    for (const int highest : {kK3, kK2}) {
      if (camera || !report.is_usable) break;
      for (const int k : std::initializer_list<int>{kK4, kK5, kK6, highest}) Hold(k);
      report = SolveBoard(board_, settings_, &state_);
      camera = MakeCamera();
    }
    if (!camera || !report.is_usable) return std::nullopt;
    return BoardSolution{board_,
                         state_,
                         *camera,
                         is_photo_out_,
                         is_marker_out_,
                         report.cost,
                         settings_.noise_factor,
                         settings_.height_sigma,
                         BoardCovariance(board_, settings_, state_)};
  }

 private:
  // Planar, so that the heights do not take what the lens has to explain.
  bool Start() {
    settings_.is_flat = true;
    settings_.is_free[kFx] = settings_.is_free[kK1] = settings_.is_free[kK2] = true;
    settings_.noise_factor = kSearchNoise;
    if (!SolveBoard(board_, settings_, &state_).is_usable) return false;
    for (const int k : {kFy, kCx, kCy, kP1, kP2}) Free(k);
    if (!SolveBoard(board_, settings_, &state_).is_usable) return false;
    // What a bent sheet leaves now must not count as wrong before the heights are free.
    EstimateNoise();
    settings_.is_flat = false;
    Free(kK3);
    if (!options_.rational) return true;
    for (const int k : {kK4, kK5, kK6}) Free(k);
    return true;
  }

  bool Round() {
    if (NumRedundant() < kMinRedundancy) return false;
    if (!SolveBoard(board_, settings_, &state_).is_usable) return false;
    CorrectCenters();
    EstimateNoise();
    EstimateHeightSigma();
    Judge();
    return true;
  }

  void Free(int parameter) { settings_.is_free[static_cast<std::size_t>(parameter)] = true; }
  void Hold(int parameter) {
    settings_.is_free[static_cast<std::size_t>(parameter)] = false;
    state_.lens[static_cast<std::size_t>(parameter)] = 0.0;
  }

  std::optional<Camera> MakeCamera() const {
    const auto model =
        options_.rational ? DistortionModel::kRationalPolynomial : DistortionModel::kPlumbBob;
    try {
      return Camera("camera", board_.width_px, board_.height_px, model, state_.lens);
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  }

  std::size_t PhotoOf(const MarkerView& view) const {
    return static_cast<std::size_t>(view.photo_idx);
  }
  std::size_t MarkerOf(const MarkerView& view) const {
    return static_cast<std::size_t>(view.marker_idx);
  }

  void LeaveOut() {
    for (MarkerView& view : board_.views) {
      if (is_photo_out_[PhotoOf(view)] != 0 || is_marker_out_[MarkerOf(view)] != 0) {
        view.is_wrong = true;
      }
    }
  }

  // Observed numbers less unknowns.
  int NumRedundant() const {
    std::vector<char> has_photo(is_photo_out_.size(), 0);
    std::vector<char> has_marker(is_marker_out_.size(), 0);
    int redundant = 0;
    for (const MarkerView& view : board_.views) {
      if (view.is_wrong) continue;
      redundant += 2;
      has_photo[PhotoOf(view)] = has_marker[MarkerOf(view)] = 1;
    }
    const auto num_photos = std::count(has_photo.begin(), has_photo.end(), 1);
    const auto num_markers = std::count(has_marker.begin(), has_marker.end(), 1);
    redundant -= static_cast<int>(6 * num_photos);
    if (board_.printed.empty()) redundant -= static_cast<int>(2 * num_markers - 4);
    return redundant -
           static_cast<int>(std::count(settings_.is_free.begin(), settings_.is_free.end(), true));
  }

  void CorrectCenters() {
    for (std::size_t i = 0; i < board_.views.size(); ++i) {
      MarkerView& view = board_.views[i];
      if (knows_lens_[PhotoOf(view)] != 0 || view.is_wrong) continue;
      view.pixel = seen_.views[i].pixel - CenterShift(view, state_);
    }
  }

  void EstimateNoise() {
    std::vector<double> lengths;
    for (const MarkerView& view : board_.views) {
      if (!view.is_wrong) lengths.push_back(WhitenedResidual(view, state_).norm());
    }
    if (lengths.empty()) return;
    // As Huber's proposal 2: sum of min(length, cut noise)^2 = mean square noise^2 redundancy.
    const double redundancy = std::max(1.0, static_cast<double>(NumRedundant()));
    double noise = MedianOf(lengths) / kRayleighMedian;
    for (int i = 0; i < kNoiseIterations; ++i) {
      double sum = 0.0;
      for (const double length : lengths) sum += std::pow(std::min(length, kNoiseCut * noise), 2);
      noise = std::sqrt(sum / (kCutMeanSquare * redundancy));
    }
    settings_.noise_factor = std::max(kMinNoiseFactor, noise);
  }

  // RMS of the heights, within the bounds of CalibrationOptions::height_sigma.
  void EstimateHeightSigma() {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < is_marker_out_.size(); ++i) {
      if (is_marker_out_[i] != 0) continue;
      sum += state_.centers_in_plane[i].z() * state_.centers_in_plane[i].z();
      ++count;
    }
    if (count == 0) return;
    settings_.height_sigma = std::clamp(
        std::sqrt(sum / count), 0.1 * options_.height_sigma, 10.0 * options_.height_sigma);
  }

  // Marks wrong views, and puts out markers and photos of which too many are.
  void Judge() {
    std::vector<Tally> of_photo(is_photo_out_.size());
    std::vector<Tally> of_marker(is_marker_out_.size());
    const double bound = options_.max_residual_sigmas * settings_.noise_factor;
    for (MarkerView& view : board_.views) {
      if (is_photo_out_[PhotoOf(view)] != 0 || is_marker_out_[MarkerOf(view)] != 0) continue;
      view.is_wrong = !(WhitenedResidual(view, state_).norm() < bound);
      for (Tally* tally : {&of_photo[PhotoOf(view)], &of_marker[MarkerOf(view)]}) {
        ++tally->num_views;
        tally->num_wrong += view.is_wrong ? 1 : 0;
      }
    }
    for (std::size_t i = 0; i < of_marker.size(); ++i) {
      const Tally& tally = of_marker[i];
      if (tally.num_wrong >= 2 && tally.num_wrong > kMaxWrongOfMarker * tally.num_views) {
        is_marker_out_[i] = 1;
      }
    }
    for (std::size_t i = 0; i < of_photo.size(); ++i) {
      const Tally& tally = of_photo[i];
      if (tally.num_views - tally.num_wrong < kMinViewsPerPhoto ||
          tally.num_wrong > kMaxWrongOfPhoto * tally.num_views) {
        is_photo_out_[i] = 1;
      }
    }
    LeaveOut();
  }

  const CalibrationOptions& options_;
  const Board& seen_;
  const std::vector<char>& knows_lens_;
  Board board_;
  BoardState state_;
  BoardBundleSettings settings_;
  std::vector<char> is_photo_out_;
  std::vector<char> is_marker_out_;
};

}  // namespace

std::optional<BoardSolution> RefineBoard(const CalibrationOptions& options,
                                         const Board& board,
                                         const std::vector<char>& knows_lens,
                                         const BoardStart& start) {
  return Refiner(options, board, knows_lens, start).Run();
}

}  // namespace plumb
