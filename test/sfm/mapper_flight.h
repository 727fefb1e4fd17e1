// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "plumbline/geometry/alignment.h"
#include "plumbline/map/map_replica.h"
#include "plumbline/sfm/mapper.h"
#include "test/sfm/scene_photos.h"

namespace plumb::test {

// Keeps all that a mapper says, and the map as its deltas tell it.
class Recorder : public MapperListener {
 public:
  void OnVerdict(const PhotoVerdict& verdict) override {
    const auto last = latest.find(verdict.photo);
    EXPECT_EQ(verdict.attempt, last == latest.end() ? 1 : last->second.attempt + 1);
    verdicts.push_back(verdict);
    latest[verdict.photo] = verdict;
    num_deltas_before.push_back(deltas.size());
  }

  void OnMapDelta(const MapDelta& delta) override {
    EXPECT_TRUE(replica.Apply(delta)) << "delta " << delta.sequence << " leaves a gap";
    deltas.push_back(delta);
  }

  void OnSeconds(PhotoId photo, const StageSeconds& seconds) override {
    seconds_of_photo[photo] = seconds;
  }

  int NumAccepted() const {
    return static_cast<int>(std::count_if(latest.begin(), latest.end(), [](const auto& entry) {
      return entry.second.status == VerdictStatus::kAccepted;
    }));
  }

  std::vector<PhotoVerdict> verdicts;
  std::vector<std::size_t> num_deltas_before;  // Of each verdict.
  std::map<PhotoId, PhotoVerdict> latest;
  std::vector<MapDelta> deltas;
  MapReplica replica;
  std::map<PhotoId, StageSeconds> seconds_of_photo;
};

// Twelve photos along a facade; each sees a quarter to a third of it and some 450 features, and
// shares nothing with the seventh after it.
inline SceneOptions RowOfTwelve() {
  SceneOptions options;
  options.num_points = 1300;
  options.width_m = 44.0;
  options.num_cameras = 12;
  options.spacing_m = 2.5;
  options.noise_px = 0.5;
  return options;
}

inline MapperPhoto MakeMapperPhoto(std::uint32_t id, FeatureSet features) {
  MapperPhoto photo;
  photo.id = {id};
  photo.name = PhotoName(id);
  photo.analysis.status = PhotoStatus::kOk;
  photo.analysis.content_hash = 1000 + id;
  photo.analysis.features = std::move(features);
  return photo;
}

// A photo of nothing that any other photo shows.
inline MapperPhoto MakeForeignPhoto(std::uint32_t id) {
  Random random(static_cast<int>(id));
  FeatureSet features;
  for (int i = 0; i < 400; ++i) {
    features.features.push_back({static_cast<float>(random.Uniform(0.0, 3999.0)),
                                 static_cast<float>(random.Uniform(0.0, 2999.0)),
                                 5.0F - 0.01F * static_cast<float>(i),
                                 0.0F});
  }
  features.colors.resize(features.features.size());
  features.descriptors = RandomDescriptors(400, 1000 + id);
  return MakeMapperPhoto(id, std::move(features));
}

// A mapper, the photos of a scene, and what was heard.
class Flight {
 public:
  explicit Flight(const SceneOptions& scene_options,
                  const MapperOptions& options = {},
                  unsigned looks_seed = 1)
      : scene_(MakeScene(scene_options)),
        photos_(MakeScenePhotos(scene_, looks_seed)),
        mapper_(options, scene_.camera, &heard_) {}

  MapperPhoto PhotoOf(std::size_t camera) const {
    return MakeMapperPhoto(static_cast<std::uint32_t>(camera), photos_[camera].features);
  }

  // Photo `camera` of the scene under that id.
  void Add(std::size_t camera) { AddAs(static_cast<std::uint32_t>(camera), camera); }

  void AddAs(std::uint32_t id, std::size_t camera) {
    camera_of_photo_[{id}] = camera;
    mapper_.Add(MakeMapperPhoto(id, photos_[camera].features));
  }

  void AddFirst(std::size_t number) {
    for (std::size_t camera = 0; camera < number; ++camera) Add(camera);
  }

  // Largest distance of a view's centre from the truth, after the best similarity [m].
  double LargestCenterError() const {
    std::vector<Eigen::Vector3d> found;
    std::vector<Eigen::Vector3d> truth;
    for (const auto& [photo, view] : mapper_.map().views()) {
      found.push_back(view.cam_from_map.TargetOriginInSource());
      truth.push_back(scene_.cams_from_map[camera_of_photo_.at(photo)].TargetOriginInSource());
    }
    const auto truth_from_map = AlignPoints(found, truth);
    if (!truth_from_map) return std::numeric_limits<double>::infinity();
    const std::vector<double> errors = AlignmentResiduals(*truth_from_map, found, truth);
    return *std::max_element(errors.begin(), errors.end());
  }

  const Scene& scene() const { return scene_; }
  std::vector<ScenePhoto>& photos() { return photos_; }
  Mapper& mapper() { return mapper_; }
  const Map& map() const { return mapper_.map(); }
  const Recorder& heard() const { return heard_; }
  Recorder& heard() { return heard_; }
  const PhotoVerdict& verdict(std::uint32_t id) const { return heard_.latest.at({id}); }

 private:
  Scene scene_;
  std::vector<ScenePhoto> photos_;
  Recorder heard_;
  Mapper mapper_;
  std::map<PhotoId, std::size_t> camera_of_photo_;
};

}  // namespace plumb::test
