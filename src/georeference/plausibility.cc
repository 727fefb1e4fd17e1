// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/plausibility.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "georeference/finding_text.h"

namespace plumb {
namespace {

using Severity = Finding::Severity;

// What surveys are kept in by mistake.
struct LengthUnit {
  const char* name;
  double per_metre;
};
constexpr std::array<LengthUnit, 4> kOtherUnits = {{{"feet", 1.0 / 0.3048},
                                                    {"centimetres", 100.0},
                                                    {"millimetres", 1000.0},
                                                    {"kilometres", 0.001}}};

// GPS gives the scale of a flight of 15 m to some 5 %, the face of a marker to 2 %.
constexpr double kUnitTolerance = 0.1;

// A marker's size is off by more than this only if it is another marker, or another unit.
constexpr double kDiameterTolerance = 0.1;

// Of the disagreement of scales; their own uncertainty is a standard deviation.
constexpr double kMaxNormalizedError = 4.0;

// The first photo is taken to be upright; pilots tilt cameras by less than this.
constexpr double kMaxTiltDeg = 50.0;

// The unit that makes lengths so many times as large as in metres; null if it is none of those.
const char* OtherUnit(double ratio) {
  const auto found =
      std::find_if(kOtherUnits.begin(), kOtherUnits.end(), [&](const LengthUnit& unit) {
        return std::abs(ratio / unit.per_metre - 1.0) < kUnitTolerance;
      });
  return found != kOtherUnits.end() ? found->name : nullptr;
}

void CheckUnit(const GeoreferencerOptions& options,
               const Survey& survey,
               Georeference* georeference) {
  std::vector<Finding>* findings = &georeference->findings;
  const auto& gps = georeference->gps;
  if (gps && gps->scale_ratio) {
    const double ratio = *gps->scale_ratio;
    const double error = std::abs(ratio - 1.0) / std::max(gps->scale_ratio_sigma, 1e-3);
    if (const char* unit = OtherUnit(ratio)) {
      return AddFinding(Severity::kError,
                        "unit",
                        Text(survey.source,
                             ": the model would be ",
                             ratio,
                             " times as large as by the photos' GPS: the survey seems to be in ",
                             unit,
                             "; convert it to metres"),
                        findings);
    }
    if (error > kMaxNormalizedError) {
      AddFinding(Severity::kWarning,
                 "implausible_scale",
                 Text("the model is ",
                      ratio,
                      " times as large by the targets as by the photos' "
                      "GPS (expected 1 +- ",
                      gps->scale_ratio_sigma,
                      "); check the unit of the survey"),
                 findings);
    }
  }
  if (!georeference->marker_diameter_m || options.marker_diameter_m <= 0.0) return;
  const double diameter_m = *georeference->marker_diameter_m;
  const double ratio = diameter_m / options.marker_diameter_m;
  // GPS, where it is, has ruled other units out.
  const bool has_scale_by_gps = gps && gps->scale_ratio;
  const char* unit = has_scale_by_gps ? nullptr : OtherUnit(ratio);
  if (unit != nullptr) {
    AddFinding(Severity::kError,
               "unit",
               Text(survey.source,
                    ": the markers would be ",
                    diameter_m,
                    " m across instead of ",
                    options.marker_diameter_m,
                    ": the survey seems to be in ",
                    unit,
                    "; convert it to metres, or give the markers' true diameter "
                    "(marker_diameter_m)"),
               findings);
  } else if (std::abs(ratio - 1.0) > kDiameterTolerance) {
    AddFinding(Severity::kWarning,
               "marker_diameter",
               Text("by the survey the markers are ",
                    diameter_m,
                    " m across, marker_diameter_m is ",
                    options.marker_diameter_m,
                    "; give their true diameter, or check the unit of the survey"),
               findings);
  }
}

void CheckUpright(const Similarity3& enu_from_map, std::vector<Finding>* findings) {
  const Eigen::Vector3d up = enu_from_map.rotation * Eigen::Vector3d::UnitZ();
  const double tilt_deg = std::acos(std::clamp(up.z(), -1.0, 1.0)) * 180.0 / M_PI;
  if (tilt_deg <= kMaxTiltDeg) return;
  AddFinding(Severity::kWarning,
             "tilted",
             Text("by the survey the first camera was tilted by ",
                  tilt_deg,
                  " deg: if it was upright, the height is not in the column z_m"),
             findings);
}

}  // namespace

void CompareWithGps(const RobustSimilarity* by_targets,
                    const RobustSimilarity& by_gps,
                    const GeoFrame* frame,
                    const std::vector<GpsPhoto>& photos,
                    Georeference* georeference) {
  GpsComparison comparison;
  comparison.num_photos = static_cast<int>(photos.size());
  if (by_targets != nullptr) {
    if (by_gps.status == RobustSimilarity::Status::kOk) {
      comparison.scale_ratio =
          by_targets->target_from_source.scale / by_gps.target_from_source.scale;
      comparison.scale_ratio_sigma =
          *comparison.scale_ratio *
          std::sqrt(by_gps.covariance(3, 3) + by_targets->covariance(3, 3));
    }
    comparison.offset_m = OffsetFromGps(by_targets->target_from_source, *frame, photos);
  }
  georeference->gps = comparison;
}

void CheckShape(const GeoreferencerOptions& options,
                const Survey& survey,
                const Similarity3& enu_from_map,
                Georeference* georeference) {
  CheckUnit(options, survey, georeference);
  CheckUpright(enu_from_map, &georeference->findings);
}

void CheckPlace(const GeoreferencerOptions& options,
                HeightReference heights,
                Georeference* georeference) {
  if (!georeference->gps || !georeference->gps->offset_m) return;
  const Eigen::Vector3d& offset = *georeference->gps->offset_m;
  const double horizontal_m = offset.head<2>().norm();
  if (horizontal_m > options.max_gps_offset_m) {
    AddFinding(Severity::kWarning,
               "gps_disagrees",
               Text("by the targets the photos were taken ",
                    horizontal_m,
                    " m (east ",
                    offset.x(),
                    ", north ",
                    offset.y(),
                    ") from where GPS says; the targets are taken. Check "
                    "the CRS of the survey"),
               &georeference->findings);
  }
  // Twice: GPS heights are that much worse.
  if (std::abs(offset.z()) > 2.0 * options.max_gps_offset_m) {
    AddFinding(Severity::kWarning,
               "gps_height_disagrees",
               Text("by the targets the photos were taken ",
                    offset.z(),
                    " m higher than GPS says; "
                    "the targets are taken. The survey's heights are taken as ",
                    ToString(heights),
                    ", those of the photos as ellipsoidal"),
               &georeference->findings);
  }
}

}  // namespace plumb
