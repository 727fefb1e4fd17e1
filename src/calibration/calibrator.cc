// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/calibration/calibrator.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "calibration/advice.h"
#include "calibration/board_intake.h"
#include "calibration/board_refinement.h"
#include "calibration/diagnosis.h"
#include "calibration/focal_search.h"
#include "calibration/result_tables.h"
#include "calibration/view_slant.h"
#include "plumbline/common/options.h"

namespace plumb {
namespace {

using Kind = CalibrationFinding::Kind;

// Three planes determine the focal length and the shape of the plane; two do not.
constexpr int kMinPhotos = 3;

// The best of the search's minima, refined.
std::optional<BoardSolution> RefineBest(const CalibrationOptions& options,
                                        const std::vector<CalibrationPhoto>& photos,
                                        const BoardIntake& intake,
                                        const FocalSearchResult& search) {
  std::vector<char> knows_lens;
  for (const std::size_t photo : intake.photo_of_board) {
    knows_lens.push_back(photos[photo].is_lens_known ? 1 : 0);
  }
  std::optional<BoardSolution> best;
  double best_score = 0.0;
  for (const FocalCandidate& candidate : search.candidates) {
    std::optional<BoardSolution> solution =
        RefineBoard(options, intake.board, knows_lens, candidate.start);
    if (!solution) continue;
    // A small noise of few views is no better.
    const auto& views = solution->board.views;
    const auto num_right = std::count_if(
        views.begin(), views.end(), [](const MarkerView& view) { return !view.is_wrong; });
    const double score = solution->noise_factor / static_cast<double>(num_right);
    if (best && score >= best_score) continue;
    best_score = score;
    best = std::move(solution);
  }
  return best;
}

CalibrationFinding TooFewPhotos(const BoardIntake& intake) {
  return {Kind::kTooFewPhotos,
          true,
          std::to_string(intake.board.num_photos) + " of the photos can be used, " +
              std::to_string(kMinPhotos) +
              " are the least. Take some twelve from all sides, from near and far, tilted by up to "
              "45 degrees.",
          {},
          {}};
}

CalibrationFinding NoReconstruction(const CalibrationOptions& options) {
  const std::string text =
      options.fixed_grid.empty()
          ? "The photos do not show the markers in one arrangement. Leave the markers where they "
            "are, use no ID twice, and show at least four of the same in every photo."
          : "The markers do not lie as on the fixed grid " + options.fixed_grid +
                ". Calibrate without a fixed grid if they were cut out.";
  return {Kind::kMoved, true, text, {}, {}};
}

CalibrationFinding NoLens() {
  return {Kind::kFoldedLens,
          true,
          "No lens explains the photos. Take more of them, with markers in all parts of the image, "
          "and look whether the markers were moved.",
          {},
          {}};
}

// So that the bars tell the same tilts as the table of the photos.
void CountEstimatedSlants(CalibrationResult* result) {
  std::vector<ViewSlant> slants;
  for (const CalibratedPhoto& photo : result->photos) {
    if (photo.is_used) slants.push_back(SlantOf(photo.cam_from_plane.rotation));
  }
  CountSlants(slants, &result->coverage);
  result->coverage.is_tilt_estimated = true;
}

void Fail(CalibrationFinding finding, CalibrationResult* result) {
  result->verdict = CalibrationVerdict::kFailed;
  for (CalibrationFinding& other : result->findings) other.is_serious = true;
  // What was left out before is the reason.
  result->advice = result->findings.empty() ? finding.text : result->findings.front().text;
  result->findings.push_back(std::move(finding));
}

}  // namespace

CalibrationResult CalibrateCamera(const CalibrationOptions& options,
                                  const std::vector<CalibrationPhoto>& photos,
                                  const std::string& camera_name) {
  ThrowIfProblems("calibration", options.Problems());
  CalibrationResult result;
  result.coverage = MeasureCoverage(photos);
  const BoardIntake intake = TakeInBoard(options, photos);
  result.findings = intake.findings;
  result.left_out = intake.left_out;
  FillNames(options, photos, intake, &result);
  if (intake.board.num_photos < kMinPhotos) {
    Fail(TooFewPhotos(intake), &result);
    return result;
  }
  const FocalSearchResult search = SearchFocalLength(options, intake.board);
  result.focal_search = search.curve;
  if (search.candidates.empty()) {
    Fail(NoReconstruction(options), &result);
    return result;
  }
  const std::optional<BoardSolution> solution = RefineBest(options, photos, intake, search);
  if (!solution || solution->covariance.size() == 0) {
    Fail(NoLens(), &result);
    return result;
  }
  FillEstimate(options, photos, intake, *solution, camera_name, &result);
  CountEstimatedSlants(&result);
  for (CalibrationFinding& finding : Diagnose(options, photos, intake, *solution, result)) {
    result.findings.push_back(std::move(finding));
  }
  std::stable_partition(result.findings.begin(),
                        result.findings.end(),
                        [](const CalibrationFinding& finding) { return finding.is_serious; });
  std::tie(result.verdict, result.advice) = Advise(options, result);
  return result;
}

const char* ToString(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::kGood:
      return "good";
    case CalibrationVerdict::kMorePhotos:
      return "more_photos";
    case CalibrationVerdict::kFailed:
      return "failed";
  }
  return "unknown";
}

const char* ToString(CalibrationFinding::Kind kind) {
  switch (kind) {
    case Kind::kTooFewPhotos:
      return "too_few_photos";
    case Kind::kTooFewMarkers:
      return "too_few_markers";
    case Kind::kMixedSizes:
      return "mixed_sizes";
    case Kind::kSameName:
      return "same_name";
    case Kind::kMarkerTwice:
      return "marker_twice";
    case Kind::kUnknownMarker:
      return "unknown_marker";
    case Kind::kWrongView:
      return "wrong_view";
    case Kind::kMoved:
      return "moved";
    case Kind::kOffPlane:
      return "off_plane";
    case Kind::kStretched:
      return "stretched";
    case Kind::kBadPhoto:
      return "bad_photo";
    case Kind::kSameSpot:
      return "same_spot";
    case Kind::kFocalUnclear:
      return "focal_unclear";
    case Kind::kFoldedLens:
      return "folded_lens";
    case Kind::kNoise:
      return "noise";
  }
  return "unknown";
}

}  // namespace plumb
