// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/map/map_delta.h"
#include "test/support/random.h"

namespace plumb::test {

// Maps whose surface is plain to see; every camera sees every landmark.
class SimpleMap {
 public:
  // 4 m x 2 m in y = 0, all but a centimetre of noise, before two rows of cameras at y = -4 m.
  static SimpleMap Wall() {
    SimpleMap map;
    Random random(3);
    for (int i = 0; i < 400; ++i) {
      const double x = random.Uniform(0, 4);
      map.AddLandmark({x, random.Uniform(-0.005, 0.005), random.Uniform(0, 2)});
    }
    for (int i = 0; i < 10; ++i) map.AddView({0.5 * (i % 5) + 1, -4, i < 5 ? 0.5 : 1.5});
    return map;
  }

  // The same without noise: exactly in a plane.
  static SimpleMap FlatWall() {
    SimpleMap map = Wall();
    for (LandmarkState& landmark : map.landmarks_) landmark.position_in_map.y() = 0.0;
    return map;
  }

  static SimpleMap Line() {
    SimpleMap map = FlatWall();
    for (LandmarkState& landmark : map.landmarks_) landmark.position_in_map.z() = 1.0;
    return map;
  }

  // Only its first cameras.
  static SimpleMap WallSeenBy(std::size_t num_views) {
    SimpleMap map = Wall();
    map.centers_.resize(num_views);
    return map;
  }

  static SimpleMap FirstOf(std::size_t num_landmarks) {
    SimpleMap map = Wall();
    map.landmarks_.resize(num_landmarks);
    return map;
  }

  MapDelta Snapshot() const {
    MapDelta snapshot;
    snapshot.sequence = 1;
    snapshot.is_snapshot = true;
    snapshot.landmarks_set = landmarks_;
    for (std::uint32_t i = 0; i < centers_.size(); ++i) {
      ViewState view;
      view.photo = PhotoId{i};
      view.cam_from_map = Rigid3(Eigen::Quaterniond::Identity(), -centers_[i]);
      snapshot.views_set.push_back(view);
      for (const LandmarkState& landmark : landmarks_) {
        snapshot.observations_added.push_back({landmark.id, PhotoId{i}, landmark.id.value, {0, 0}});
      }
    }
    return snapshot;
  }

  void Move(const Eigen::Vector3d& by) {
    for (LandmarkState& landmark : landmarks_) landmark.position_in_map += by;
    for (Eigen::Vector3d& center : centers_) center += by;
  }

  const std::vector<LandmarkState>& landmarks() const { return landmarks_; }
  Eigen::Vector3d CenterOf(std::uint32_t photo) const { return centers_[photo]; }

 private:
  void AddLandmark(const Eigen::Vector3d& position) {
    landmarks_.push_back(
        {LandmarkId{static_cast<std::uint32_t>(landmarks_.size())}, position, {9, 8, 7}});
  }
  void AddView(const Eigen::Vector3d& center) { centers_.push_back(center); }

  std::vector<LandmarkState> landmarks_;
  std::vector<Eigen::Vector3d> centers_;
};

}  // namespace plumb::test
