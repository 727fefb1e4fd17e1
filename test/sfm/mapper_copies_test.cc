// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Facades of exact copies: no photo may be put a bay further on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "plumbline/geometry/alignment.h"
#include "test/sfm/copied_bays.h"
#include "test/sfm/mapper_flight.h"

namespace plumb {
namespace {

using test::CopiedBays;
using test::CopiedBaysOptions;

void Fly(const CopiedBays& bays, Mapper* mapper) {
  for (std::uint32_t i = 0; i < bays.photos.size(); ++i) {
    mapper->Add(test::MakeMapperPhoto(i, bays.photos[i].features));
  }
  mapper->Finish();
}

double LargestCenterError_m(const CopiedBays& bays, const Map& map) {
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> truth;
  for (const auto& [photo, view] : map.views()) {
    found.push_back(view.cam_from_map.TargetOriginInSource());
    truth.push_back(bays.scene.cams_from_map[photo.value].TargetOriginInSource());
  }
  const auto truth_from_map = AlignPoints(found, truth);
  if (!truth_from_map) return std::numeric_limits<double>::infinity();
  const std::vector<double> errors = AlignmentResiduals(*truth_from_map, found, truth);
  return *std::max_element(errors.begin(), errors.end());
}

// Landmarks of which all features show one point of the facade; 1 for an empty map.
double ShareOfTrueLandmarks(const CopiedBays& bays, const Map& map) {
  int num_true = 0;
  for (const LandmarkId id : map.LandmarkIds()) {
    const std::vector<Observation>& track = map.landmark(id).track;
    const auto point_of = [&](const Observation& observation) {
      return bays.photos[observation.photo.value].point_of_feature[observation.feature_idx];
    };
    const bool is_true = std::all_of(track.begin(), track.end(), [&](const Observation& other) {
      return point_of(other) == point_of(track[0]);
    });
    if (is_true) ++num_true;
  }
  return map.num_landmarks() == 0 ? 1.0 : num_true / static_cast<double>(map.num_landmarks());
}

// The search is what keeps copies apart: without it a map is folded.
TEST(MapperCopiedBays, AreFoldedIfNothingIsLookedForElsewhere) {
  const CopiedBays bays = MakeCopiedBays(CopiedBaysOptions());
  MapperOptions options;
  options.lookalike.min_common_share = 1.0;  // A place a bay further on never has all in view.
  test::Recorder heard;
  Mapper mapper(options, bays.scene.camera, &heard);
  Fly(bays, &mapper);
  EXPECT_GE(heard.NumAccepted(), 2);
  EXPECT_LT(ShareOfTrueLandmarks(bays, mapper.map()), 0.5);
}

TEST(MapperCopiedBays, NothingIsBuiltOfCopiesAlone) {
  const CopiedBays bays = MakeCopiedBays(CopiedBaysOptions());
  test::Recorder heard;
  Mapper mapper({}, bays.scene.camera, &heard);
  Fly(bays, &mapper);
  EXPECT_EQ(heard.NumAccepted(), 0);
  int num_ambiguous = 0;
  for (const auto& [photo, verdict] : heard.latest) {
    EXPECT_NE(verdict.hint, "") << verdict.name;
    if (verdict.reason == RefusalReason::kAmbiguous) ++num_ambiguous;
  }
  EXPECT_GE(num_ambiguous, 3);
}

TEST(MapperCopiedBays, CopiesAmongMuchThatIsUniqueDoNoHarm) {
  CopiedBaysOptions options;
  options.points_per_bay = 30;
  options.num_unique_points = 1200;
  const CopiedBays bays = MakeCopiedBays(options);
  test::Recorder heard;
  Mapper mapper({}, bays.scene.camera, &heard);
  Fly(bays, &mapper);
  EXPECT_EQ(heard.NumAccepted(), options.num_cameras);
  EXPECT_LT(LargestCenterError_m(bays, mapper.map()), 0.05);
}

TEST(MapperCopiedBays, NoShareOfCopiesGivesAWrongPose) {
  for (const int num_unique : {60, 150, 400}) {
    CopiedBaysOptions options;
    options.num_unique_points = num_unique;
    const CopiedBays bays = MakeCopiedBays(options);
    test::Recorder heard;
    Mapper mapper({}, bays.scene.camera, &heard);
    Fly(bays, &mapper);
    EXPECT_GT(ShareOfTrueLandmarks(bays, mapper.map()), 0.9) << num_unique << " unique points";
  }
}

}  // namespace
}  // namespace plumb
