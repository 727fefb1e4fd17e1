// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "plumbline/map/map_delta.h"
#include "test/support/random.h"

namespace plumb::test {

// A stream of deltas as the mapper sends them, of a size that need not be flown: photos in three
// rows of courses before a wall with windows; each brings landmarks and rays, and then a local
// bundle that moves the last views and what they see.
class SyntheticFlight {
 public:
  struct Options {
    int num_photos = 500;
    int num_landmarks = 300'000;
    double width_m = 50.0;
    double height_m = 20.0;
    double seen_ratio = 0.25;       // Of the landmarks in a photo, those that it observes.
    int num_moved_views = 20;       // By the bundle after each photo.
    double landmark_move_m = 3e-4;  // Standard deviation, each axis.
    double view_move_m = 1e-3;
    int seed = 1;
  };

  explicit SyntheticFlight(const Options& options) : options_(options), random_(options.seed) {
    cell_of_column_.resize(static_cast<std::size_t>(options.width_m / kCell_m + 1.0));
    for (int i = 0; i < options.num_landmarks; ++i) AddPoint();
  }

  std::vector<MapDelta> Fly() {
    std::vector<MapDelta> deltas;
    for (int i = 0; i < options_.num_photos; ++i) {
      deltas.push_back(Photo(i));
      deltas.back().sequence = static_cast<std::uint32_t>(deltas.size());
    }
    return deltas;
  }

 private:
  static constexpr double kCell_m = 0.5;

  struct Point {
    Eigen::Vector3d position;
    std::vector<std::uint32_t> pending;  // Photos that saw it before it was a landmark.
    bool is_landmark = false;
  };

  void AddPoint() {
    const double x = random_.Uniform(0.0, options_.width_m);
    const double z = random_.Uniform(0.0, options_.height_m);
    // Windows of 1 m x 1.5 m lie 0.2 m deep, one every 2.5 m x 3.3 m.
    const bool is_window = std::fmod(x, 2.5) < 1.0 && std::fmod(z, 3.3) < 1.5;
    const double y = (is_window ? 0.2 : 0.0) + random_.Normal(0.001);
    cell_of_column_[static_cast<std::size_t>(x / kCell_m)].push_back(
        static_cast<std::uint32_t>(points_.size()));
    points_.push_back({{x, y, z}, {}, false});
  }

  // Courses from left to right and back, the rows one after the other: 10 m, 6 m, 4 m.
  Eigen::Vector3d CenterOf(int photo) const {
    const int row = std::min(2, 3 * photo / options_.num_photos);
    const double distance_m = std::vector<double>{10.0, 6.0, 4.0}[static_cast<std::size_t>(row)];
    const int first = row * options_.num_photos / 3;
    const int num = std::max(1, options_.num_photos / 3);
    const int num_courses = 2 + 2 * row;
    const int in_course = std::max(1, num / num_courses);
    const int course = std::min((photo - first) / in_course, num_courses - 1);
    double along = (photo - first - course * in_course + 0.5) / in_course;
    if (course % 2 == 1) along = 1.0 - along;
    return {
        along * options_.width_m, -distance_m, (course + 0.5) * options_.height_m / num_courses};
  }

  bool IsInPhoto(const Eigen::Vector3d& point, const Eigen::Vector3d& center) const {
    const double depth_m = point.y() - center.y();
    return std::abs(point.x() - center.x()) < 0.7 * depth_m &&
           std::abs(point.z() - center.z()) < 0.47 * depth_m;
  }

  MapDelta Photo(int index) {
    MapDelta delta;
    const auto photo = static_cast<std::uint32_t>(index);
    centers_.push_back(CenterOf(index));
    seen_.emplace_back();
    SetView(photo, &delta);
    const Eigen::Vector3d center = centers_.back();
    for (std::size_t column = 0; column < cell_of_column_.size(); ++column) {
      if (std::abs((static_cast<double>(column) + 0.5) * kCell_m - center.x()) > 0.72 * 11.0)
        continue;
      for (const std::uint32_t id : cell_of_column_[column]) {
        if (!IsInPhoto(points_[id].position, center)) continue;
        if (random_.Uniform(0.0, 1.0) < options_.seen_ratio) See(id, photo, &delta);
      }
    }
    MoveNeighbors(photo, &delta);
    return delta;
  }

  void See(std::uint32_t id, std::uint32_t photo, MapDelta* delta) {
    Point& point = points_[id];
    if (!point.is_landmark) {
      point.pending.push_back(photo);
      if (point.pending.size() < 2) return;
      point.is_landmark = true;
      delta->landmarks_set.push_back({LandmarkId{id}, point.position, {128, 128, 128}});
      for (const std::uint32_t earlier : point.pending) Observe(id, earlier, delta);
      point.pending.clear();
      point.pending.shrink_to_fit();
      return;
    }
    Observe(id, photo, delta);
  }

  void Observe(std::uint32_t id, std::uint32_t photo, MapDelta* delta) {
    delta->observations_added.push_back({LandmarkId{id}, PhotoId{photo}, id, {0, 0}});
    seen_[photo].push_back(id);
  }

  void SetView(std::uint32_t photo, MapDelta* delta) {
    ViewState view;
    view.photo = PhotoId{photo};
    view.cam_from_map = Rigid3(Eigen::Quaterniond::Identity(), -centers_[photo]);
    delta->views_set.push_back(view);
  }

  // The nearest views and what they see.
  void MoveNeighbors(std::uint32_t photo, MapDelta* delta) {
    std::vector<std::uint32_t> views(photo);
    for (std::uint32_t i = 0; i < photo; ++i) views[i] = i;
    std::sort(views.begin(), views.end(), [&](std::uint32_t a, std::uint32_t b) {
      return (centers_[a] - centers_[photo]).squaredNorm() <
             (centers_[b] - centers_[photo]).squaredNorm();
    });
    views.resize(
        std::min<std::size_t>(views.size(), static_cast<std::size_t>(options_.num_moved_views)));
    std::vector<std::uint32_t> moved;
    for (const std::uint32_t view : views) {
      centers_[view] += random_.InBox(1.7 * options_.view_move_m);
      SetView(view, delta);
      moved.insert(moved.end(), seen_[view].begin(), seen_[view].end());
    }
    std::sort(moved.begin(), moved.end());
    moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
    for (const std::uint32_t id : moved) {
      points_[id].position += random_.InBox(1.7 * options_.landmark_move_m);
      delta->landmarks_set.push_back({LandmarkId{id}, points_[id].position, {128, 128, 128}});
    }
  }

  Options options_;
  Random random_;
  std::vector<Point> points_;
  std::vector<std::vector<std::uint32_t>> cell_of_column_;
  std::vector<Eigen::Vector3d> centers_;
  std::vector<std::vector<std::uint32_t>> seen_;
};

}  // namespace plumb::test
