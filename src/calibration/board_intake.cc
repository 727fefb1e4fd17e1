// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/board_intake.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "calibration/photo_size.h"
#include "calibration/wording.h"
#include "plumbline/marker/marker_sheet.h"

namespace plumb {
namespace {

using Kind = CalibrationFinding::Kind;

// A photo with three markers gives as many equations as its pose has unknowns.
constexpr std::size_t kMinMarkersPerPhoto = 4;

struct Sighting {
  std::size_t photo = 0;  // Into the given photos.
  std::size_t detection = 0;
  int id = 0;
};

bool IsUsable(const MarkerDetection& marker) {
  const Ellipse& ellipse = marker.ellipse;
  const Eigen::Matrix2d& covariance = marker.center_covariance_px2;
  return marker.center_px.allFinite() && covariance.allFinite() && covariance(0, 0) >= 0.0 &&
         covariance.determinant() >= 0.0 && ellipse.center_px.allFinite() &&
         std::isfinite(ellipse.angle_rad) && ellipse.semi_minor_px > 0.5 &&
         ellipse.semi_major_px >= ellipse.semi_minor_px && std::isfinite(ellipse.semi_major_px);
}

class Intake {
 public:
  Intake(const CalibrationOptions& options, const std::vector<CalibrationPhoto>& photos)
      : options_(options), photos_(photos) {
    std::tie(intake_.board.width_px, intake_.board.height_px) = UsualSize(photos);
    if (!options.fixed_grid.empty()) {
      const MarkerSheet sheet = LayOutGrid(options.fixed_grid == "a3" ? Paper::kA3 : Paper::kA4,
                                           Arrangement::kFixed,
                                           options.first_id);
      for (const PrintedMarker& marker : sheet.markers) {
        const Eigen::Vector2d center = (marker.center_mm - 0.5 * sheet.page_mm) / sheet.diameter_mm;
        printed_[marker.id] = {center.x(), -center.y()};
      }
    }
  }

  BoardIntake Run() {
    ChoosePhotos();
    for (const std::size_t photo : usual_photos_) ChooseMarkers(photo);
    Report(Kind::kMarkerTwice,
           twice_ids_,
           twice_photos_,
           " there twice in one photo: two sheets with the same IDs, or a mirror image. Left out "
           "there; print a second set with another --first-id, keep off glass and wet floors.",
           /*is_serious=*/false);
    Report(Kind::kUnknownMarker,
           unknown_ids_,
           unknown_photos_,
           " not on the fixed grid of the IDs from " + std::to_string(options_.first_id) +
               ". Left out; give the sheet's first ID, or calibrate without a fixed grid.",
           /*is_serious=*/false);
    DropLonely();
    Build();
    NameLeftOut();
    return std::move(intake_);
  }

 private:
  void ChoosePhotos() {
    std::set<std::string> names;
    std::vector<std::string> repeated;
    std::vector<std::string> odd;
    for (std::size_t i = 0; i < photos_.size(); ++i) {
      const CalibrationPhoto& photo = photos_[i];
      if (!names.insert(photo.name).second) {
        repeated.push_back(photo.name);
      } else if (photo.width_px != intake_.board.width_px ||
                 photo.height_px != intake_.board.height_px) {
        odd.push_back(photo.name);
      } else {
        usual_photos_.push_back(i);
      }
    }
    if (!repeated.empty()) {
      Add({Kind::kSameName,
           false,
           NamePhotos(repeated) + " came twice; only the first one counts.",
           {},
           repeated});
    }
    if (!odd.empty()) {
      Add({Kind::kMixedSizes,
           false,
           NamePhotos(odd) + (odd.size() == 1 ? " is" : " are") + " not of " +
               std::to_string(intake_.board.width_px) + " x " +
               std::to_string(intake_.board.height_px) +
               " px as most. Left out; one camera, one zoom, one image size, and no automatic "
               "turning of photos.",
           {},
           odd});
    }
  }

  void ChooseMarkers(std::size_t photo) {
    std::map<int, int> counts;
    for (const MarkerDetection& marker : photos_[photo].markers) ++counts[marker.id];
    for (std::size_t i = 0; i < photos_[photo].markers.size(); ++i) {
      const MarkerDetection& marker = photos_[photo].markers[i];
      if (counts[marker.id] > 1) {
        twice_ids_.insert(marker.id);
        twice_photos_.insert(photo);
      } else if (!printed_.empty() && printed_.count(marker.id) == 0) {
        unknown_ids_.insert(marker.id);
        unknown_photos_.insert(photo);
      } else if (IsUsable(marker)) {
        sightings_.push_back({photo, i, marker.id});
      }
    }
  }

  // Photos with too few markers and, where they are strewn, markers in one photo only; one may make
  // the other.
  void DropLonely() {
    const std::size_t min_photos = printed_.empty() ? 2 : 1;
    for (bool has_changed = true; has_changed;) {
      std::map<std::size_t, std::size_t> of_photo;
      std::map<int, std::size_t> of_marker;
      for (const Sighting& sighting : sightings_) {
        ++of_photo[sighting.photo];
        ++of_marker[sighting.id];
      }
      const auto end =
          std::remove_if(sightings_.begin(), sightings_.end(), [&](const Sighting& sighting) {
            return of_photo[sighting.photo] < kMinMarkersPerPhoto ||
                   of_marker[sighting.id] < min_photos;
          });
      has_changed = end != sightings_.end();
      sightings_.erase(end, sightings_.end());
    }
    std::set<std::size_t> kept;
    for (const Sighting& sighting : sightings_) kept.insert(sighting.photo);
    std::vector<std::string> poor;
    for (const std::size_t photo : usual_photos_) {
      if (kept.count(photo) == 0) poor.push_back(photos_[photo].name);
    }
    const bool is_alone = usual_photos_.size() < 2;  // A first photo can share nothing yet.
    if (poor.empty() || (is_alone && printed_.empty())) return;
    Add({Kind::kTooFewMarkers,
         false,
         NamePhotos(poor) + (poor.size() == 1 ? " shows" : " show") + " fewer than " +
             std::to_string(kMinMarkersPerPhoto) +
             " markers that others show too. Left out; have most markers wholly in every photo, "
             "sharp and not covered.",
         {},
         poor});
  }

  void Build() {
    std::map<int, int> marker_idxs;
    for (const Sighting& sighting : sightings_) marker_idxs[sighting.id] = 0;
    for (auto& [id, idx] : marker_idxs) {
      idx = static_cast<int>(intake_.marker_ids.size());
      intake_.marker_ids.push_back(id);
      if (!printed_.empty()) intake_.board.printed.push_back(printed_[id]);
    }
    const double extra_px2 = options_.extra_sigma_px * options_.extra_sigma_px;
    for (const Sighting& sighting : sightings_) {
      if (intake_.photo_of_board.empty() || intake_.photo_of_board.back() != sighting.photo) {
        intake_.photo_of_board.push_back(sighting.photo);
      }
      const MarkerDetection& marker = photos_[sighting.photo].markers[sighting.detection];
      MarkerView view;
      view.photo_idx = static_cast<int>(intake_.photo_of_board.size()) - 1;
      view.marker_idx = marker_idxs[sighting.id];
      view.pixel = marker.center_px;
      view.covariance_px2 = marker.center_covariance_px2 + extra_px2 * Eigen::Matrix2d::Identity();
      view.ellipse = marker.ellipse;
      intake_.board.views.push_back(view);
      intake_.detection_of_view.push_back(sighting.detection);
    }
    intake_.board.num_photos = static_cast<int>(intake_.photo_of_board.size());
    intake_.board.num_markers = static_cast<int>(intake_.marker_ids.size());
  }

  void NameLeftOut() {
    std::map<int, std::set<std::size_t>> photos_of_marker;
    for (std::size_t i = 0; i < photos_.size(); ++i) {
      for (const MarkerDetection& marker : photos_[i].markers) {
        photos_of_marker[marker.id].insert(i);
      }
    }
    for (const int id : intake_.marker_ids) photos_of_marker.erase(id);
    for (const auto& [id, photos] : photos_of_marker) {
      intake_.left_out.push_back({id, WhyLeftOut(id, photos)});
    }
  }

  std::string WhyLeftOut(int id, const std::set<std::size_t>& photos) const {
    if (unknown_ids_.count(id) != 0) return "not on the fixed grid";
    if (photos.size() == 1) {
      const std::string& name = photos_[*photos.begin()].name;
      return (twice_ids_.count(id) != 0 ? "twice in one photo, " : "in one photo only, ") + name;
    }
    return "in no two photos that can be used";
  }

  void Report(Kind kind,
              const std::set<int>& ids,
              const std::set<std::size_t>& photos,
              const std::string& what,
              bool is_serious) {
    if (ids.empty()) return;
    CalibrationFinding finding{kind, is_serious, "", {ids.begin(), ids.end()}, {}};
    for (const std::size_t photo : photos) finding.photos.push_back(photos_[photo].name);
    finding.text = NamePhotos(finding.photos) + ": " + NameMarkers(finding.marker_ids) +
                   (ids.size() == 1 ? " is" : " are") + what;
    Add(finding);
  }

  void Add(CalibrationFinding finding) {
    finding.text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(finding.text[0])));
    intake_.findings.push_back(std::move(finding));
  }

  const CalibrationOptions& options_;
  const std::vector<CalibrationPhoto>& photos_;
  BoardIntake intake_;
  std::map<int, Eigen::Vector2d> printed_;
  std::vector<std::size_t> usual_photos_;
  std::vector<Sighting> sightings_;
  std::set<int> twice_ids_;
  std::set<std::size_t> twice_photos_;
  std::set<int> unknown_ids_;
  std::set<std::size_t> unknown_photos_;
};

}  // namespace

BoardIntake TakeInBoard(const CalibrationOptions& options,
                        const std::vector<CalibrationPhoto>& photos) {
  return Intake(options, photos).Run();
}

}  // namespace plumb
