// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/surface/surface_report.h"

namespace plumb {

std::string Describe(const SurfaceProblem& problem) {
  const std::string landmark = "landmark " + std::to_string(problem.landmark.value);
  const std::string photo = "photo " + std::to_string(problem.photo.value);
  using Kind = SurfaceProblem::Kind;
  switch (problem.kind) {
    case Kind::kLandmarkNotFinite:
      return landmark + ": its position is not finite or too large; left out of the surface";
    case Kind::kLandmarkDoubled:
      return landmark + ": exactly where landmark " + std::to_string(problem.other.value) + " is";
    case Kind::kViewNotFinite:
      return photo + ": its pose is not finite or too large; its rays are left out";
    case Kind::kCameraOnLandmark:
      return landmark + ": exactly where the camera of " + photo + " is; that ray is left out";
    case Kind::kUnknownLandmark:
      return landmark + ": " + photo + " observes it, but the map does not hold it";
    case Kind::kUnknownView:
      return photo + ": landmarks are observed in it, but the map does not hold its pose";
  }
  return "unknown problem";
}

}  // namespace plumb
