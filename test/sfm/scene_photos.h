// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/map/map.h"
#include "sfm/photo_record.h"
#include "test/matching/random_descriptors.h"
#include "test/support/synthetic_scene.h"

namespace plumb::test {

// A photo of a scene: features as AnalyzePhoto gives them, and the point that each of them shows.
struct ScenePhoto {
  FeatureSet features;
  std::vector<int> point_of_feature;
};

// Scale at which a camera sees a point's texture, 5 to 20 mm large on the facade.
inline double FeatureScalePx(const Scene& scene, std::size_t camera, int point_idx) {
  const double size_m = 0.005 * std::pow(4.0, static_cast<double>(point_idx * 37 % 101) / 100.0);
  const Eigen::Vector3d& point_in_map = scene.points_in_map[static_cast<std::size_t>(point_idx)];
  return size_m * scene.camera.MeanFocalLength() / (scene.cams_from_map[camera] * point_in_map).z();
}

// Row p of `descriptor_of_point` is how point p looks; every photo sees it a little different.
inline ScenePhoto MakeScenePhoto(const Scene& scene,
                                 std::size_t camera,
                                 const DescriptorMatrix& descriptor_of_point) {
  std::vector<SceneObservation> seen = scene.observations[camera];
  std::stable_sort(seen.begin(), seen.end(), [&](const auto& a, const auto& b) {
    return FeatureScalePx(scene, camera, a.point_idx) > FeatureScalePx(scene, camera, b.point_idx);
  });
  ScenePhoto photo;
  photo.features.descriptors.resize(static_cast<Eigen::Index>(seen.size()), kDescriptorSize);
  for (const SceneObservation& observation : seen) {
    const auto row = static_cast<Eigen::Index>(photo.features.size());
    const double scale_px = FeatureScalePx(scene, camera, observation.point_idx);
    photo.features.features.push_back({static_cast<float>(observation.pixel.x()),
                                       static_cast<float>(observation.pixel.y()),
                                       static_cast<float>(scale_px),
                                       0.0F});
    photo.features.colors.push_back({100, 110, 120});
    photo.features.descriptors.row(row) = descriptor_of_point.row(observation.point_idx);
    photo.point_of_feature.push_back(observation.point_idx);
  }
  photo.features.descriptors =
      Perturbed(photo.features.descriptors, 3, static_cast<unsigned>(camera) + 1);
  return photo;
}

// All photos of a scene whose points look like nothing else.
inline std::vector<ScenePhoto> MakeScenePhotos(const Scene& scene, unsigned seed = 1) {
  const DescriptorMatrix descriptors =
      RandomDescriptors(static_cast<int>(scene.points_in_map.size()), seed);
  std::vector<ScenePhoto> photos;
  for (std::size_t i = 0; i < scene.cams_from_map.size(); ++i) {
    photos.push_back(MakeScenePhoto(scene, i, descriptors));
  }
  return photos;
}

inline std::string PhotoName(std::uint32_t id) { return "photo" + std::to_string(id) + ".jpg"; }

// Photo k has id k.
inline PhotoRecords MakeRecords(const Camera& camera, const std::vector<ScenePhoto>& photos) {
  PhotoRecords records;
  for (std::uint32_t i = 0; i < photos.size(); ++i) {
    records[{i}] = MakePhotoRecord(camera, {i}, PhotoName(i), Timestamp{}, photos[i].features);
  }
  return records;
}

inline void AddViewAt(const PhotoRecords& records,
                      PhotoId photo,
                      const Rigid3& cam_from_map,
                      Map* map) {
  const PhotoRecord& record = records.at(photo);
  map->AddView(photo, {record.name, record.exposure_time, cam_from_map, record.features, {}, 0});
}

// Adds a landmark for each point that at least two of `photo_ids` see, by the truth; those of
// points that have one already grow.
inline void AddTrueLandmarks(const Scene& scene,
                             const std::vector<ScenePhoto>& photos,
                             const std::vector<std::uint32_t>& photo_ids,
                             Map* map) {
  std::vector<std::vector<Observation>> tracks(scene.points_in_map.size());
  for (const std::uint32_t id : photo_ids) {
    for (std::uint32_t i = 0; i < photos[id].point_of_feature.size(); ++i) {
      tracks[static_cast<std::size_t>(photos[id].point_of_feature[i])].push_back({{id}, i});
    }
  }
  for (std::size_t p = 0; p < tracks.size(); ++p) {
    LandmarkId known;
    for (const Observation& observation : tracks[p]) {
      if (map->LandmarkOf(observation).IsValid()) known = map->LandmarkOf(observation);
    }
    if (!known.IsValid()) {
      if (tracks[p].size() >= 2) map->AddLandmark(scene.points_in_map[p], tracks[p]);
      continue;
    }
    for (const Observation& observation : tracks[p]) {
      if (!map->LandmarkOf(observation).IsValid()) map->AddObservation(known, observation);
    }
  }
}

// The true map of all photos of a scene.
inline Map MakeTrueMap(const Scene& scene, const std::vector<ScenePhoto>& photos) {
  const PhotoRecords records = MakeRecords(scene.camera, photos);
  Map map;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < photos.size(); ++i) {
    AddViewAt(records, {i}, scene.cams_from_map[i], &map);
    ids.push_back(i);
  }
  AddTrueLandmarks(scene, photos, ids, &map);
  return map;
}

}  // namespace plumb::test
