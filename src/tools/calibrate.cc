// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/calibrate.h"

#include <iomanip>
#include <optional>
#include <sstream>

#include "plumbline/calibration/calibration_report.h"
#include "plumbline/calibration/calibrator.h"
#include "plumbline/common/atomic_file.h"
#include "tools/count_text.h"
#include "tools/detect.h"
#include "tools/photo_list.h"

namespace plumb::tools {
namespace {

CalibrationPhoto ToCalibrationPhoto(const DetectedPhoto& detected, bool is_lens_known) {
  CalibrationPhoto photo;
  photo.name = detected.name;
  photo.width_px = detected.width_px;
  photo.height_px = detected.height_px;
  photo.markers = detected.markers;
  photo.is_lens_known = is_lens_known;
  return photo;
}

// All photos that can be read, and lines on those that cannot.
std::vector<CalibrationPhoto> DetectAll(const CalibrateArguments& arguments, Console* console) {
  const PhotoListing listing = ListPhotos(arguments.photos);
  for (const std::string& line : Describe(listing)) console->PrintLine(line);
  std::vector<CalibrationPhoto> photos;
  for (const std::string& name : listing.photos) {
    const DetectedPhoto detected =
        DetectInPhoto(arguments.detector, std::nullopt, arguments.photos, name);
    if (!detected.problem.empty()) {
      console->PrintLine(name + ": " + detected.problem);
      continue;
    }
    console->PrintLine(name + ": " + CountOf(detected.markers.size(), "marker"));
    photos.push_back(ToCalibrationPhoto(detected, false));
  }
  return photos;
}

// The used photos once more, with the lens that is known now; the others stay as they are.
std::vector<CalibrationPhoto> DetectAgain(const CalibrateArguments& arguments,
                                          const CalibrationResult& result,
                                          std::vector<CalibrationPhoto> photos) {
  const Camera& camera = result.estimate->camera;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    if (!result.photos[i].is_used) continue;
    const DetectedPhoto detected =
        DetectInPhoto(arguments.detector, camera, arguments.photos, photos[i].name);
    if (detected.problem.empty()) photos[i] = ToCalibrationPhoto(detected, true);
  }
  return photos;
}

std::string Fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

}  // namespace

CalibrateOutcome Calibrate(const CalibrateArguments& arguments, Console* console) {
  RequireWritable(arguments.output);  // Before minutes of work.
  std::vector<CalibrationPhoto> photos = DetectAll(arguments, console);
  CalibrateOutcome outcome;
  outcome.result = CalibrateCamera(arguments.calibration, photos, arguments.camera_name);
  if (outcome.result.estimate && !arguments.detect_once) {
    photos = DetectAgain(arguments, outcome.result, std::move(photos));
    outcome.result = CalibrateCamera(arguments.calibration, photos, arguments.camera_name);
  }
  const CalibrationResult& result = outcome.result;
  if (!arguments.report.empty()) WriteCalibrationReport(result, arguments.report);
  const bool is_wanted = result.verdict == CalibrationVerdict::kGood || arguments.keep_poor;
  if (result.estimate && is_wanted) {
    WriteFileAtomically(arguments.output, ToCameraYaml(result.estimate->camera));
    outcome.has_written = true;
  }
  return outcome;
}

std::vector<std::string> Describe(const CalibrationResult& result) {
  std::vector<std::string> lines;
  if (result.estimate) {
    const LensEstimate& estimate = *result.estimate;
    const LensParameters<double>& lens = estimate.camera.lens();
    lines.push_back("focal length " + Fixed(lens[kFx], 2) + " px +- " +
                    Fixed(estimate.sigma[kFx], 2) + ", principal point (" + Fixed(lens[kCx], 2) +
                    ", " + Fixed(lens[kCy], 2) + ") px +- " +
                    Fixed(estimate.principal_sigma_px, 2) + ", distortion +- " +
                    Fixed(estimate.distortion_sigma_px, 3) + " px, residuals " +
                    Fixed(result.rms_px, 3) + " px RMS");
  }
  for (const CalibrationFinding& finding : result.findings) lines.push_back("- " + finding.text);
  lines.push_back(result.advice);
  return lines;
}

}  // namespace plumb::tools
