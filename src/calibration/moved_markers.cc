// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/moved_markers.h"

#include <algorithm>

#include "calibration/sheet_point.h"

namespace plumb {
namespace {

constexpr double kSamePlaceDiameters = 0.05;

struct Place {
  int photo_idx = 0;
  Eigen::Vector2d point;
};

}  // namespace

MarkerPlaces FindMarkerPlaces(const BoardSolution& solution, int marker_idx) {
  std::vector<Place> places;
  for (const MarkerView& view : solution.board.views) {
    if (view.marker_idx != marker_idx) continue;
    if (solution.is_photo_out[static_cast<std::size_t>(view.photo_idx)] != 0) continue;
    const auto point = PointInPlane(solution, view.photo_idx, view.pixel, 0.0);
    if (point) places.push_back({view.photo_idx, *point});
  }
  const auto is_same = [](const Place& a, const Place& b) {
    return (a.point - b.point).norm() < kSamePlaceDiameters;
  };
  const Place* usual = nullptr;
  std::ptrdiff_t most = 0;
  for (const Place& place : places) {
    const auto count = std::count_if(
        places.begin(), places.end(), [&](const Place& other) { return is_same(place, other); });
    if (count <= most) continue;
    most = count;
    usual = &place;
  }
  MarkerPlaces result;
  if (usual == nullptr) return result;
  std::vector<double> distances;
  for (const Place& place : places) {
    if (is_same(*usual, place)) {
      result.usual_photos.push_back(place.photo_idx);
    } else {
      result.elsewhere_photos.push_back(place.photo_idx);
      distances.push_back((place.point - usual->point).norm());
    }
  }
  if (distances.empty()) return result;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  result.distance = *middle;
  return result;
}

}  // namespace plumb
