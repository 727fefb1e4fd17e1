// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/calibration/calibration_coverage.h"
#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"

// Plain values, to be copied freely between threads. The frame `plane`: x and y in the plane of the
// markers (a fixed grid's x to the right and y up as printed), z out of it, towards the cameras;
// origin in the middle of the markers. Lengths in
// marker diameters, in metres where the diameter is known (CalibrationResult::is_metric).

namespace plumb {

// The error function over the plausible focal lengths, evaluated one by one.
struct FocalSearch {
  std::vector<double> focal_px;  // Ascending.
  // What the best planar reconstruction with this focal length leaves, robust RMS [standard
  // deviations of a centre].
  std::vector<double> error;
  double best_focal_px = 0.0;  // Of the smallest error.
};

// A lens and how well it is known.
struct LensEstimate {
  Camera camera;
  LensParameters<double> sigma{};  // Standard deviations; 0 for what was held.
  double focal_sigma_percent = 0.0;
  double principal_sigma_px = 0.0;  // The larger one of the two.
  // Standard deviation of where a ray meets the image, RMS over the image, less what another focal
  // length, principal point and turn of the camera would take away.
  double distortion_sigma_px = 0.0;
};

struct CalibratedPhoto {
  std::string name;
  bool is_used = false;
  Rigid3 cam_from_plane;  // Only if used, as what has no other word.
  int num_found = 0;      // Markers found in it; also if not used, as the two that follow.
  int num_markers = 0;    // Of them, that others show too.
  int num_wrong = 0;      // Of them, that do not count: they do not fit, or their marker does not.
  double rms_px = 0.0;    // Of those that are not wrong.
  double tilt_deg = 0.0;  // Between the plane's normal and the optical axis.
  double distance = 0.0;  // From the camera to the middle of its markers.
};

struct CalibratedMarker {
  int id = -1;
  bool is_used = false;  // False: seen once only, or never at one place.
  Eigen::Vector3d center_in_plane = Eigen::Vector3d::Zero();
  double angle_rad = 0.0;  // From the plane's x axis to the marker's, about z; to a degree.
  double height_sigma = 0.0;
  int num_photos = 0;
  int num_wrong = 0;
  double rms_px = 0.0;  // Of those that are not wrong.
};

// A marker that was found but is not among CalibrationResult::markers.
struct LeftOutMarker {
  int id = -1;
  std::string reason;  // "in one photo only, 0001.jpg".
};

struct CalibrationResidual {
  int photo_idx = -1;                                     // Into CalibrationResult::photos.
  int marker_idx = -1;                                    // Into CalibrationResult::markers.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();        // As seen, raw.
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  // Seen less projected.
  double sigmas = 0.0;  // The residual's length in standard deviations.
  bool is_wrong = false;
};

// Something that is off, with its cure.
struct CalibrationFinding {
  enum class Kind {
    kTooFewPhotos,
    kTooFewMarkers,
    kMixedSizes,     // Photos of another size than most.
    kSameName,       // A photo given twice.
    kMarkerTwice,    // A marker twice in one photo: two sheets with the same IDs, or a mirror.
    kUnknownMarker,  // Not of the fixed grid.
    kWrongView,      // A marker fits nothing in single photos: partly hidden, mirrored, blurred.
    kMoved,          // A marker lies elsewhere in some photos.
    kOffPlane,       // A marker stands off the plane: the sheet is bent, or it is no floor.
    kStretched,      // The printer's scale is not the same along and across.
    kBadPhoto,       // Most markers of a photo fit nothing.
    kSameSpot,       // The camera was not moved.
    kFocalUnclear,   // The error function has no clear minimum.
    kFoldedLens,     // The distortion found is not one-to-one within the image.
    kNoise           // Residuals far larger than the detector's covariances.
  };
  Kind kind = Kind::kTooFewPhotos;
  // True: the result cannot be relied on as long as this stands.
  bool is_serious = false;
  std::string text;  // What is off, by IDs and photos, and what to do. One or two sentences.
  std::vector<int> marker_ids;
  std::vector<std::string> photos;
};

enum class CalibrationVerdict {
  kGood,        // Use it.
  kMorePhotos,  // There is an estimate, but it is not good enough; the advice says what to do.
  kFailed       // No estimate; findings and advice say why and what to do.
};

const char* ToString(CalibrationVerdict verdict);
const char* ToString(CalibrationFinding::Kind kind);

struct CalibrationResult {
  CalibrationVerdict verdict = CalibrationVerdict::kFailed;
  std::string advice;  // One sentence: that it is good, or what to photograph next.
  std::vector<CalibrationFinding> findings;  // Serious ones first.

  std::optional<LensEstimate> estimate;  // Nothing if kFailed.
  double rms_px = 0.0;                   // Of all residuals that are not wrong.
  // Standard deviation of the residuals over what the detector's covariances say.
  double noise_factor = 1.0;
  bool is_metric = false;
  FocalSearch focal_search;
  CalibrationCoverage coverage;
  std::vector<CalibratedPhoto> photos;    // As given.
  std::vector<CalibratedMarker> markers;  // By ID.
  std::vector<LeftOutMarker> left_out;    // By ID.
  std::vector<CalibrationResidual> residuals;
};

}  // namespace plumb
