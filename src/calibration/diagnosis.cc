// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/diagnosis.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calibration/moved_markers.h"
#include "calibration/result_tables.h"
#include "calibration/wording.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

using Kind = CalibrationFinding::Kind;

// Paper curls by as much; what a sheet's bend is told from [marker diameters, and deviations].
constexpr double kMinHeightDiameters = 0.015;
constexpr double kMinHeightSigmas = 4.0;
constexpr double kOffFloorDiameters = 0.5;
constexpr double kMaxShareOut = 0.25;  // Of photos or markers: beyond, the rest may be wrong too.
constexpr double kMinStretch = 0.002;
constexpr double kMaxPrintDiameters = 0.015;  // Five times what a printer does.
constexpr double kSameSpotShare = 0.15;       // Of the distance to the markers.
constexpr double kUnclearFocalPercent = 2.0;
constexpr double kMinRise = 1.1;         // Of the error function from its minimum to either end.
constexpr double kMinHiddenShare = 0.1;  // Of the markers seen.
constexpr int kRimPoints = 12;
constexpr double kNoisy = 4.0;
constexpr double kTooNoisy = 15.0;

class Diagnosis {
 public:
  Diagnosis(const CalibrationOptions& options,
            const std::vector<CalibrationPhoto>& photos,
            const BoardIntake& intake,
            const BoardSolution& solution,
            const CalibrationResult& result)
      : options_(options),
        photos_(photos),
        intake_(intake),
        solution_(solution),
        result_(result),
        unit_(LengthUnit(options)) {}

  std::vector<CalibrationFinding> Run() {
    CheckPhotos();
    CheckMoved();
    CheckViews();
    CheckHidden();
    CheckHeights();
    if (!options_.fixed_grid.empty()) CheckPrint();
    CheckSpots();
    CheckFocal();
    CheckNoise();
    return std::move(findings_);
  }

 private:
  std::string NameOf(int board_photo) const {
    return photos_[intake_.photo_of_board[static_cast<std::size_t>(board_photo)]].name;
  }

  std::vector<std::string> NamesOf(const std::vector<int>& board_photos) const {
    std::vector<std::string> names;
    for (const int photo : board_photos) names.push_back(NameOf(photo));
    return names;
  }

  void Add(CalibrationFinding finding) {
    finding.text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(finding.text[0])));
    findings_.push_back(std::move(finding));
  }

  // Photos whose markers lie otherwise.
  void CheckPhotos() {
    std::vector<int> out;
    for (std::size_t i = 0; i < solution_.is_photo_out.size(); ++i) {
      if (solution_.is_photo_out[i] != 0) out.push_back(static_cast<int>(i));
    }
    if (out.empty()) return;
    const bool is_serious = static_cast<double>(out.size()) >
                            kMaxShareOut * static_cast<double>(solution_.is_photo_out.size());
    const std::vector<std::string> names = NamesOf(out);
    Add({Kind::kBadPhoto,
         is_serious,
         NamePhotos(names) + (names.size() == 1 ? " shows" : " show") +
             " the markers otherwise than the others do, or too few that they share. Left out; "
             "were "
             "the markers moved, or are there two sets with the same IDs?",
         {},
         names});
  }

  void CheckMoved() {
    std::size_t num_out = 0;
    for (const char is_out : solution_.is_marker_out) num_out += is_out != 0 ? 1 : 0;
    const bool is_serious = static_cast<double>(num_out) >
                            kMaxShareOut * static_cast<double>(solution_.is_marker_out.size());
    for (std::size_t i = 0; i < solution_.is_marker_out.size(); ++i) {
      if (solution_.is_marker_out[i] == 0) continue;
      const MarkerPlaces places = FindMarkerPlaces(solution_, static_cast<int>(i));
      if (places.elsewhere_photos.empty()) {
        Add({Kind::kWrongView,
             is_serious,
             NameMarkers({intake_.marker_ids[i]}) +
                 " fits in with the others nowhere: covered, crumpled or mirrored. Left out.",
             {intake_.marker_ids[i]},
             {}});
        continue;
      }
      const std::vector<std::string> names = NamesOf(places.elsewhere_photos);
      Add({Kind::kMoved,
           is_serious,
           NameMarkers({intake_.marker_ids[i]}) + " lies " +
               Length(unit_ * places.distance, result_.is_metric) + " elsewhere in " +
               NamePhotos(names) + " than in " + Count(places.usual_photos.size(), "other photo") +
               ": it was moved, or is there twice. Left out; fix it and photograph again.",
           {intake_.marker_ids[i]},
           names});
    }
  }

  // Single views, where both the marker and the photo are good otherwise.
  void CheckViews() {
    std::set<int> ids;
    std::vector<std::string> names;
    for (const CalibrationResidual& residual : result_.residuals) {
      if (!residual.is_wrong) continue;
      const int id = result_.markers[static_cast<std::size_t>(residual.marker_idx)].id;
      const std::string& name = result_.photos[static_cast<std::size_t>(residual.photo_idx)].name;
      ids.insert(id);
      if (names.empty() || names.back() != name) names.push_back(name);
    }
    if (ids.empty()) return;
    const std::vector<int> marker_ids(ids.begin(), ids.end());
    Add({Kind::kWrongView,
         false,
         NameMarkers(marker_ids) + (ids.size() == 1 ? " is" : " are") +
             " not where the other photos have " + (ids.size() == 1 ? "it" : "them") + " in " +
             NamePhotos(names) + ": partly hidden, mirrored or blurred. Left out there.",
         marker_ids,
         names});
  }

  // Markers that lie in the image and were not found.
  void CheckHidden() {
    std::set<std::pair<int, int>> found;  // Photo of the board, ID.
    for (std::size_t i = 0; i < intake_.photo_of_board.size(); ++i) {
      for (const MarkerDetection& marker : photos_[intake_.photo_of_board[i]].markers) {
        found.emplace(static_cast<int>(i), marker.id);
      }
    }
    std::set<int> ids;
    std::vector<int> photos;
    std::size_t num_hidden = 0;
    for (std::size_t i = 0; i < intake_.photo_of_board.size(); ++i) {
      const auto photo = static_cast<int>(i);
      if (solution_.is_photo_out[i] != 0) continue;
      for (std::size_t k = 0; k < intake_.marker_ids.size(); ++k) {
        const int id = intake_.marker_ids[k];
        if (found.count({photo, id}) > 0 || !IsWhollyInImage(photo, k)) continue;
        ++num_hidden;
        ids.insert(id);
        if (photos.empty() || photos.back() != photo) photos.push_back(photo);
      }
    }
    if (static_cast<double>(num_hidden) <
        kMinHiddenShare * static_cast<double>(solution_.board.views.size())) {
      return;
    }
    const std::vector<std::string> names = NamesOf(photos);
    const std::vector<int> marker_ids(ids.begin(), ids.end());
    Add({Kind::kWrongView,
         false,
         Count(num_hidden, "marker") + " that should show in " + NamePhotos(names) +
             (num_hidden == 1 ? " was" : " were") + " not found (" + NameMarkers(marker_ids) +
             "): covered, blurred or in glare.",
         marker_ids,
         names});
  }

  // With its white rim.
  bool IsWhollyInImage(int photo, std::size_t marker) const {
    if (solution_.is_marker_out[marker] != 0) return false;
    const Rigid3& cam_from_plane = solution_.state.cams_from_plane[static_cast<std::size_t>(photo)];
    for (int i = 0; i < kRimPoints; ++i) {
      const double angle_rad = 2.0 * M_PI * i / kRimPoints;
      const Eigen::Vector3d rim(std::cos(angle_rad), std::sin(angle_rad), 0.0);
      const auto pixel = solution_.camera.Project(
          cam_from_plane * (solution_.state.centers_in_plane[marker] + 0.5 * kQuietRadius * rim));
      if (!pixel || !solution_.camera.IsInImage(*pixel)) return false;
    }
    return true;
  }

  void CheckHeights() {
    std::vector<int> bent;
    std::vector<int> off;
    double most = 0.0;
    for (std::size_t i = 0; i < result_.markers.size(); ++i) {
      const CalibratedMarker& marker = result_.markers[i];
      if (!marker.is_used) continue;
      const double height = std::abs(marker.center_in_plane.z());
      if (height < unit_ * kMinHeightDiameters) continue;
      if (height < kMinHeightSigmas * marker.height_sigma) continue;
      (height > unit_ * kOffFloorDiameters ? off : bent).push_back(marker.id);
      most = std::max(most, height);
    }
    const std::string length = Length(most, result_.is_metric);
    if (!off.empty()) {
      Add({Kind::kOffPlane,
           false,
           NameMarkers(off) + (off.size() == 1 ? " lies" : " lie") + " up to " + length +
               " off the others' plane: mirrored, or not on the same floor. Lay all in one plane.",
           off,
           {}});
    }
    if (!bent.empty()) {
      Add({Kind::kOffPlane,
           false,
           NameMarkers(bent) + (bent.size() == 1 ? " stands" : " stand") + " up to " + length +
               " off the plane: the paper is bent. It is allowed for; flat paper on a board is "
               "better.",
           bent,
           {}});
    }
  }

  void CheckPrint() {
    const double stretch = solution_.state.stretch - 1.0;
    if (std::abs(stretch) > kMinStretch) {
      Add({Kind::kStretched,
           false,
           "the sheet is printed " + Number(100.0 * std::abs(stretch), 2) + " % too " +
               (stretch > 0.0 ? "long" : "short") +
               " for its width. It is allowed for; print at 100 % without fitting to the page.",
           {},
           {}});
    }
    std::vector<int> off;
    for (std::size_t i = 0; i < solution_.is_marker_out.size(); ++i) {
      if (solution_.is_marker_out[i] != 0) continue;
      const Eigen::Vector2d& printed = solution_.board.printed[i];
      const Eigen::Vector2d expected(printed.x() + solution_.state.shear * printed.y(),
                                     solution_.state.stretch * printed.y());
      const Eigen::Vector2d found = solution_.state.centers_in_plane[i].head<2>();
      if ((found - expected).norm() > kMaxPrintDiameters) off.push_back(intake_.marker_ids[i]);
    }
    if (off.empty()) return;
    Add({Kind::kMoved,
         true,
         NameMarkers(off) + (off.size() == 1 ? " does" : " do") + " not lie as on the grid " +
             options_.fixed_grid + ". Calibrate without a fixed grid if they were cut out.",
         off,
         {}});
  }

  void CheckSpots() {
    std::vector<Eigen::Vector3d> spots;
    double distance = 0.0;
    for (const CalibratedPhoto& photo : result_.photos) {
      if (!photo.is_used) continue;
      spots.push_back(photo.cam_from_plane.TargetOriginInSource());
      distance = std::max(distance, photo.distance);
    }
    double apart = 0.0;
    for (const Eigen::Vector3d& a : spots) {
      for (const Eigen::Vector3d& b : spots) apart = std::max(apart, (a - b).norm());
    }
    if (apart > kSameSpotShare * distance) return;
    Add({Kind::kSameSpot,
         true,
         "all photos are from one spot, which does not tell the focal length. Move around the "
         "markers, and look at them from the side.",
         {},
         {}});
  }

  void CheckFocal() {
    const FocalSearch& search = result_.focal_search;
    const double best = *std::min_element(search.error.begin(), search.error.end());
    const double rise = std::min(search.error.front(), search.error.back()) / best;
    const double focal_px = result_.estimate->camera.lens()[kFx];
    const double width_px = result_.estimate->camera.width_px();
    const bool is_outside = focal_px < options_.min_focal_per_width * width_px ||
                            focal_px > options_.max_focal_per_width * width_px;
    const double percent = result_.estimate->focal_sigma_percent;
    if (percent < kUnclearFocalPercent && rise > kMinRise && !is_outside) return;
    Add({Kind::kFocalUnclear,
         true,
         (percent < kUnclearFocalPercent
              ? std::string("the error over the focal length has no clear minimum")
              : "the photos tell the focal length only to " + Number(percent, 1) + " %") +
             ". Take photos from the side, tilted by 30 to 45 degrees, in several directions.",
         {},
         {}});
  }

  void CheckNoise() {
    if (solution_.noise_factor < kNoisy) return;
    Add({Kind::kNoise,
         solution_.noise_factor > kTooNoisy,
         "the markers fit " + Number(solution_.noise_factor, 1) +
             " times worse than their edges promise. Look for blurred photos, moved or bent "
             "markers, and switch off the camera's own distortion correction and stabiliser.",
         {},
         {}});
  }

  const CalibrationOptions& options_;
  const std::vector<CalibrationPhoto>& photos_;
  const BoardIntake& intake_;
  const BoardSolution& solution_;
  const CalibrationResult& result_;
  double unit_;
  std::vector<CalibrationFinding> findings_;
};

}  // namespace

std::vector<CalibrationFinding> Diagnose(const CalibrationOptions& options,
                                         const std::vector<CalibrationPhoto>& photos,
                                         const BoardIntake& intake,
                                         const BoardSolution& solution,
                                         const CalibrationResult& result) {
  return Diagnosis(options, photos, intake, solution, result).Run();
}

}  // namespace plumb
