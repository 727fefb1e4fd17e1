// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two bays of a facade that look the same: a photo of one of them alone must not be guessed.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "test/sfm/mapper_flight.h"

namespace plumb {
namespace {

using test::Scene;
using test::SceneOptions;
using test::ScenePhoto;

constexpr double kBaySpacing_m = 18.0;  // More than a photo shows.

constexpr double kBayBottom_m = 2.5;  // The upper quarter of the facade.

// Above kBayBottom_m the right half of the facade is the left half again, relief and looks; what is
// below is unique.
struct TwinBays {
  Scene scene;
  std::vector<ScenePhoto> photos;
};

// `num_extra` more photos are taken of the left bay alone.
TwinBays MakeTwinBays(int num_extra = 0) {
  SceneOptions options = test::RowOfTwelve();
  options.num_points = 1100;
  options.width_m = 2.0 * kBaySpacing_m;
  options.num_cameras = 13;
  options.spacing_m = 1.8;
  options.max_turn_rad = 0.05;
  Scene scene = MakeScene(options);
  DescriptorMatrix looks = RandomDescriptors(options.num_points, 5);
  std::vector<Eigen::Vector3d> left;
  std::vector<Eigen::Index> left_looks;
  for (Eigen::Index i = 0; i < options.num_points; ++i) {
    const Eigen::Vector3d& point = scene.points_in_map[static_cast<std::size_t>(i)];
    if (point.z() < kBayBottom_m || point.x() > 0.0) continue;
    left.push_back(point);
    left_looks.push_back(i);
  }
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < options.num_points && next < left.size(); ++i) {
    Eigen::Vector3d& point = scene.points_in_map[static_cast<std::size_t>(i)];
    if (point.z() < kBayBottom_m || point.x() <= 0.0) continue;
    point = left[next] + Eigen::Vector3d(kBaySpacing_m, 0.0, 0.0);
    looks.row(i) = looks.row(left_looks[next]);
    ++next;
  }
  test::Random random(6);
  for (int i = 0; i < num_extra; ++i) {
    const Eigen::Vector3d center(random.Uniform(-11.5, -10.0), random.Uniform(-10.5, -9.5), 0.3);
    const Eigen::Quaterniond rotation = test::FacingFacade();
    scene.cams_from_map.push_back({rotation, -(rotation * center)});
    scene.observations.emplace_back();
  }
  for (std::size_t k = 0; k < scene.cams_from_map.size(); ++k) {
    scene.observations[k].clear();
    for (std::size_t i = 0; i < scene.points_in_map.size(); ++i) {
      auto seen = test::Observe(options, scene.cams_from_map[k], scene.points_in_map[i], &random);
      if (!seen) continue;
      seen->point_idx = static_cast<int>(i);
      scene.observations[k].push_back(*seen);
    }
  }
  TwinBays bays{std::move(scene), {}};
  for (std::size_t k = 0; k < bays.scene.cams_from_map.size(); ++k) {
    bays.photos.push_back(test::MakeScenePhoto(bays.scene, k, looks));
  }
  return bays;
}

// The photo without its features below the bays, as if a canopy hid them.
FeatureSet WithoutWhatIsUnique(const Scene& scene, const ScenePhoto& photo) {
  FeatureSet features;
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < photo.features.size(); ++i) {
    const auto point = static_cast<std::size_t>(photo.point_of_feature[i]);
    if (scene.points_in_map[point].z() < kBayBottom_m) continue;
    features.features.push_back(photo.features.features[i]);
    features.colors.push_back(photo.features.colors[i]);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  features.descriptors.resize(static_cast<Eigen::Index>(kept.size()), kDescriptorSize);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    features.descriptors.row(static_cast<Eigen::Index>(i)) =
        photo.features.descriptors.row(kept[i]);
  }
  return features;
}

// Distance of a photo's centre from the truth, after the row's best similarity [m].
double CenterError(const Scene& scene, const Map& map, PhotoId photo, std::size_t camera) {
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> truth;
  for (const auto& [id, view] : map.views()) {
    if (id == photo || id.value >= scene.cams_from_map.size()) continue;
    found.push_back(view.cam_from_map.TargetOriginInSource());
    truth.push_back(scene.cams_from_map[id.value].TargetOriginInSource());
  }
  const auto truth_from_map = AlignPoints(found, truth);
  EXPECT_TRUE(truth_from_map);
  return (*truth_from_map * map.view(photo).cam_from_map.TargetOriginInSource() -
          scene.cams_from_map[camera].TargetOriginInSource())
      .norm();
}

TEST(MapperTwinBays, RowIsLocatedByWhatIsUnique) {
  const TwinBays bays = MakeTwinBays();
  test::Recorder heard;
  Mapper mapper({}, bays.scene.camera, &heard);
  for (std::uint32_t i = 0; i < bays.photos.size(); ++i) {
    mapper.Add(test::MakeMapperPhoto(i, bays.photos[i].features));
  }
  mapper.Finish();
  EXPECT_EQ(heard.NumAccepted(), 13);
  for (const auto& [photo, view] : mapper.map().views()) {
    EXPECT_LT(CenterError(bays.scene, mapper.map(), photo, photo.value), 0.1) << view.name;
  }
}

// All of the most alike views show the left bay.
TEST(MapperTwinBays, PhotoOfTheBayWithFewerViewsIsNotPutInTheOther) {
  const TwinBays bays = MakeTwinBays(/*num_extra=*/12);
  constexpr std::size_t kCamera = 10;  // Before the right bay.
  MapperOptions options;
  options.retrieval.num_training_photos = 1000;  // Never: likeness is the number of matches.
  test::Recorder heard;
  Mapper mapper(options, bays.scene.camera, &heard);
  for (std::uint32_t i = 0; i < bays.photos.size(); ++i) {
    if (i != kCamera) mapper.Add(test::MakeMapperPhoto(i, bays.photos[i].features));
  }
  ASSERT_EQ(heard.NumAccepted(), 24);
  const PhotoId photo{50};
  mapper.Add(test::MakeMapperPhoto(50, WithoutWhatIsUnique(bays.scene, bays.photos[kCamera])));
  const PhotoVerdict& verdict = heard.latest.at(photo);
  if (verdict.status == VerdictStatus::kAccepted) {
    EXPECT_LT(CenterError(bays.scene, mapper.map(), photo, kCamera), 0.1);
  } else {
    EXPECT_EQ(verdict.reason, RefusalReason::kAmbiguous);
  }
}

TEST(MapperTwinBays, PhotoOfOneBayAloneIsNeverPutInTheOther) {
  const TwinBays bays = MakeTwinBays();
  int num_ambiguous = 0;
  for (const std::size_t camera : {1U, 2U, 10U, 11U}) {
    test::Recorder heard;
    Mapper mapper({}, bays.scene.camera, &heard);
    for (std::uint32_t i = 0; i < bays.photos.size(); ++i) {
      if (i != camera) mapper.Add(test::MakeMapperPhoto(i, bays.photos[i].features));
    }
    ASSERT_EQ(heard.NumAccepted(), 12);
    const PhotoId photo{50};
    mapper.Add(test::MakeMapperPhoto(50, WithoutWhatIsUnique(bays.scene, bays.photos[camera])));
    mapper.Finish();
    const PhotoVerdict& verdict = heard.latest.at(photo);
    if (verdict.status == VerdictStatus::kAccepted) {
      EXPECT_LT(CenterError(bays.scene, mapper.map(), photo, camera), 0.1) << "camera " << camera;
    } else {
      EXPECT_EQ(verdict.reason, RefusalReason::kAmbiguous) << "camera " << camera;
      EXPECT_NE(verdict.hint, "");
      ++num_ambiguous;
    }
  }
  EXPECT_GE(num_ambiguous, 1);
}

}  // namespace
}  // namespace plumb
