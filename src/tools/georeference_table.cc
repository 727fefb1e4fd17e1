// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iomanip>
#include <sstream>

#include "tools/georeference.h"

namespace plumb::tools {
namespace {

constexpr double kMmPerM = 1000.0;

std::string LineOf(const TargetReport& target) {
  std::ostringstream line;
  line << std::fixed << std::setw(8) << target.name << "  " << std::left << std::setw(8)
       << (target.is_check ? "check" : "control") << std::setw(11) << ToString(target.state)
       << std::right << std::setw(3) << target.num_used << " of " << std::setw(3)
       << target.num_photos << std::setprecision(2) << std::setw(8);
  if (target.num_used > 0) {
    line << target.rms_error_px;
  } else {
    line << '-';
  }
  if (target.state != TargetState::kGood && target.state != TargetState::kWrong) return line.str();
  line << std::setprecision(1) << std::showpos;
  for (int axis = 0; axis < 3; ++axis) line << std::setw(9) << kMmPerM * target.residual_m[axis];
  line << std::noshowpos << std::setw(9) << kMmPerM * target.residual_m.norm() << std::setw(8)
       << kMmPerM * target.sigma_m;
  return line.str();
}

std::string LineOf(const char* role, const ResidualSummary& summary) {
  std::ostringstream line;
  line << std::fixed << std::setprecision(1) << role << ": ";
  if (summary.count == 0) return line.str() + "none";
  line << summary.count << ", mean " << summary.mean_mm << ", median " << summary.median_mm
       << ", max " << summary.max_mm << ", rms " << summary.rms_mm << " mm";
  return line.str();
}

std::string FrameLine(const Georeference& georeference) {
  const GeoFrame& frame = *georeference.frame;
  std::ostringstream line;
  line << std::setprecision(12) << "by " << ToString(georeference.source) << " in " << frame.crs()
       << " (heights " << ToString(frame.heights()) << "), origin " << frame.origin_in_crs().x()
       << ", " << frame.origin_in_crs().y() << ", " << frame.origin_in_crs().z()
       << std::setprecision(7) << "; " << georeference.enu_from_map.scale << " m a map unit";
  return line.str();
}

}  // namespace

std::string JoinedErrors(const Georeference& georeference) {
  std::string text;
  for (const Finding& finding : georeference.findings) {
    if (finding.severity != Finding::Severity::kError) continue;
    text += (text.empty() ? "" : "; ") + finding.text;
  }
  return text;
}

std::vector<std::string> Describe(const Georeference& georeference) {
  std::vector<std::string> lines;
  if (!georeference.targets.empty()) {
    lines.emplace_back(
        "  target  role    state       photos   rms px    dx mm    dy mm    dz mm   off mm   "
        "sigma");
  }
  for (const TargetReport& target : georeference.targets) lines.push_back(LineOf(target));
  if (!JoinedErrors(georeference).empty()) return lines;  // What else there is will not be used.
  if (georeference.source == GeoreferenceSource::kTargets) {
    lines.push_back(LineOf("control points", georeference.control));
    lines.push_back(LineOf("check points", georeference.check));
  }
  if (georeference.source != GeoreferenceSource::kNone) lines.push_back(FrameLine(georeference));
  if (georeference.gps && georeference.gps->scale_ratio) {
    std::ostringstream line;
    line << std::fixed << std::setprecision(4)
         << "scale by targets over scale by GPS: " << *georeference.gps->scale_ratio << " +- "
         << georeference.gps->scale_ratio_sigma;
    if (georeference.gps->offset_m) {
      line << std::setprecision(2) << "; off GPS by " << georeference.gps->offset_m->transpose()
           << " m (east, north, up)";
    }
    lines.push_back(line.str());
  }
  for (const Finding& finding : georeference.findings) {
    lines.push_back(std::string(ToString(finding.severity)) + ": " + finding.text);
  }
  return lines;
}

}  // namespace plumb::tools
