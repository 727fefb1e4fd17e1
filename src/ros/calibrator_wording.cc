// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_wording.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace plumb::ros_adapter {
namespace {

int NumUsed(const CalibrationResult& result) {
  return static_cast<int>(std::count_if(
      result.photos.begin(), result.photos.end(), [](const auto& photo) { return photo.is_used; }));
}

}  // namespace

std::string CountOf(int count, const std::string& noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string NumberOf(double value, int digits) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

ValueText DescribeValue(double value, double sigma) {
  constexpr int kMaxDigits = 6;
  int digits = kMaxDigits;
  if (sigma > 0.0) {
    digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, kMaxDigits);
  }
  return {NumberOf(value, digits), NumberOf(sigma, digits)};
}

Outcome DescribeResult(const CalibrationResult& result) {
  if (!result.estimate) return {Outcome::Kind::kFailed, "Not calibrated: " + result.advice};
  const LensEstimate& estimate = *result.estimate;
  const ValueText focal = DescribeValue(estimate.camera.lens()[kFx], estimate.sigma[kFx]);
  const std::string facts = "Calibrated from " + CountOf(NumUsed(result), "photo") +
                            ": f = " + focal.value + " ± " + focal.sigma + " px, residuals " +
                            NumberOf(result.rms_px, 3) + " px.";
  if (result.verdict == CalibrationVerdict::kGood) {
    return {Outcome::Kind::kDone, facts + " Good: save it."};
  }
  return {Outcome::Kind::kDoubtful, facts + " Not good enough yet: " + result.advice};
}

Outcome DescribeSaved(const CalibrationResult& result, const std::string& folder) {
  const std::string where = "Saved: " + folder + "/camera.yaml, with report.md beside it.";
  if (result.verdict == CalibrationVerdict::kGood) return {Outcome::Kind::kDone, where};
  return {Outcome::Kind::kDoubtful, where + " It is not good enough yet: " + result.advice};
}

}  // namespace plumb::ros_adapter
