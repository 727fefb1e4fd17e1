// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/map.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <tuple>

namespace plumb {
namespace {

constexpr int kNumFeatures = 12;

std::shared_ptr<const FeatureSet> MakeFeatures(int seed) {
  auto features = std::make_shared<FeatureSet>();
  for (int i = 0; i < kNumFeatures; ++i) {
    Feature feature;
    feature.x_px = static_cast<float>(10 * i + seed);
    feature.y_px = static_cast<float>(5 * i);
    features->features.push_back(feature);
    features->colors.push_back({static_cast<std::uint8_t>(10 * i), 0, 255});
  }
  features->descriptors.resize(kNumFeatures, kDescriptorSize);
  return features;
}

View MakeView(int seed) {
  View view;
  view.name = "photo" + std::to_string(seed);
  view.cam_from_map.translation.x() = seed;
  view.features = MakeFeatures(seed);
  return view;
}

Map MakeMapWithViews(int num_views) {
  Map map;
  for (int i = 0; i < num_views; ++i) {
    map.AddView(PhotoId{static_cast<std::uint32_t>(i)}, MakeView(i));
  }
  return map;
}

// What a listener knows after applying deltas in the documented order.
struct Mirror {
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  std::map<std::uint32_t, double> view_x;
  std::map<std::uint32_t, double> landmark_x;
  std::map<Key, std::uint32_t> observations;
  std::uint32_t sequence = 0;

  void Apply(const MapDelta& delta) {
    if (delta.is_snapshot) *this = Mirror();
    sequence = delta.sequence;
    for (const auto& gone : delta.observations_removed) {
      EXPECT_EQ(observations.erase({gone.photo.value, gone.feature_idx}), 1U);
    }
    for (const LandmarkId id : delta.landmarks_removed) {
      EXPECT_EQ(landmark_x.erase(id.value), 1U) << "landmark " << id.value;
      EraseObservations([&](const Key&, std::uint32_t landmark) { return landmark == id.value; });
    }
    for (const PhotoId photo : delta.views_removed) {
      EXPECT_EQ(view_x.erase(photo.value), 1U) << "view " << photo.value;
      EraseObservations([&](const Key& key, std::uint32_t) { return key.first == photo.value; });
    }
    for (const auto& view : delta.views_set) {
      view_x[view.photo.value] = view.cam_from_map.translation.x();
    }
    for (const auto& landmark : delta.landmarks_set) {
      landmark_x[landmark.id.value] = landmark.position_in_map.x();
    }
    for (const auto& added : delta.observations_added) {
      EXPECT_TRUE(landmark_x.count(added.landmark.value) != 0);
      EXPECT_TRUE(view_x.count(added.photo.value) != 0);
      const bool is_new =
          observations.emplace(Key{added.photo.value, added.feature_idx}, added.landmark.value)
              .second;
      EXPECT_TRUE(is_new);
    }
  }

  template <typename Predicate>
  void EraseObservations(Predicate&& predicate) {
    for (auto it = observations.begin(); it != observations.end();) {
      it = predicate(it->first, it->second) ? observations.erase(it) : std::next(it);
    }
  }

  friend bool operator==(const Mirror& a, const Mirror& b) {
    return std::tie(a.view_x, a.landmark_x, a.observations) ==
           std::tie(b.view_x, b.landmark_x, b.observations);
  }
};

// Changes a map in every way there is, at random.
class RandomEditor {
 public:
  explicit RandomEditor(unsigned seed) : random_(seed) {}

  void Edit(Map* map) {
    switch (Pick(8)) {
      case 0:
        return AddView(map);
      case 1:
        if (map->views().size() > 4 && Pick(4) == 0) map->RemoveView(AnyView(*map));
        return;
      case 2:
      case 3:
        return AddLandmark(map);
      case 4:
        return WithLandmark(map, [&](LandmarkId id) { Observe(map, id); });
      case 5:
        return WithLandmark(
            map, [&](LandmarkId id) { map->RemoveObservation(map->landmark(id).track.front()); });
      case 6:
        return WithLandmark(map, [&](LandmarkId id) {
          map->MoveLandmark(id, Eigen::Vector3d(Pick(1000), 0.0, 0.0));
          map->MoveView(AnyView(*map), {Eigen::Quaterniond::Identity(), {1.0 * Pick(1000), 0, 0}});
        });
      default:
        return Merge(map);
    }
  }

 private:
  int Pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  PhotoId AnyView(const Map& map) {
    return std::next(map.views().begin(), Pick(static_cast<int>(map.views().size())))->first;
  }

  void AddView(Map* map) {
    const PhotoId photo{static_cast<std::uint32_t>(Pick(10))};  // Also ids that were removed.
    if (!map->HasView(photo)) map->AddView(photo, MakeView(static_cast<int>(photo.value)));
  }

  std::vector<Observation> FreeFeatures(const Map& map, const std::set<PhotoId>& taken) {
    std::vector<Observation> free;
    for (const auto& [photo, view] : map.views()) {
      const auto feature_idx = static_cast<std::uint32_t>(Pick(kNumFeatures));
      const bool is_free = !view.landmark_of_feature[feature_idx].IsValid();
      if (is_free && taken.count(photo) == 0) free.push_back({photo, feature_idx});
    }
    return free;
  }

  void AddLandmark(Map* map) {
    std::vector<Observation> track = FreeFeatures(*map, {});
    if (track.size() > 3) track.resize(3);
    if (track.size() >= 2) map->AddLandmark(Eigen::Vector3d(Pick(1000), 0.0, 0.0), track);
  }

  template <typename Action>
  void WithLandmark(Map* map, Action&& action) {
    const std::vector<LandmarkId> ids = map->LandmarkIds();
    if (!ids.empty()) action(ids[static_cast<std::size_t>(Pick(static_cast<int>(ids.size())))]);
  }

  void Observe(Map* map, LandmarkId id) {
    std::set<PhotoId> taken;
    for (const Observation& observation : map->landmark(id).track) taken.insert(observation.photo);
    const std::vector<Observation> free = FreeFeatures(*map, taken);
    if (!free.empty()) map->AddObservation(id, free.front());
  }

  void Merge(Map* map) {
    const std::vector<LandmarkId> ids = map->LandmarkIds();
    if (ids.size() >= 2) map->MergeLandmarks(ids.front(), ids.back());
  }

  std::mt19937 random_;
};

TEST(Map, DeltasAppliedInOrderGiveTheMap) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Map map = MakeMapWithViews(5);
    RandomEditor editor(seed);
    Mirror listener;
    std::uint32_t last_sequence = 0;
    for (int step = 0; step < 60; ++step) {
      for (int i = 0; i < 7; ++i) editor.Edit(&map);
      const auto delta = map.TakeDelta();
      if (!delta) continue;
      EXPECT_EQ(delta->sequence, ++last_sequence);
      listener.Apply(*delta);
      Mirror late;
      late.Apply(map.Snapshot());
      ASSERT_TRUE(listener == late) << "seed " << seed << " step " << step;
      EXPECT_EQ(late.sequence, last_sequence);
    }
  }
}

TEST(Map, SnapshotRebuildsTheSameMap) {
  Map map = MakeMapWithViews(6);
  RandomEditor editor(7);
  for (int i = 0; i < 300; ++i) editor.Edit(&map);
  map.TakeDelta();
  std::map<PhotoId, std::shared_ptr<const FeatureSet>> features;
  for (const auto& [photo, view] : map.views()) features[photo] = view.features;

  Map rebuilt = Map::FromSnapshot(map.Snapshot(), features);
  Mirror original;
  original.Apply(map.Snapshot());
  Mirror copy;
  copy.Apply(rebuilt.Snapshot());
  EXPECT_TRUE(original == copy);
  EXPECT_EQ(rebuilt.num_landmarks(), map.num_landmarks());
  EXPECT_EQ(rebuilt.num_observations(), map.num_observations());
  EXPECT_FALSE(rebuilt.TakeDelta().has_value());
}

TEST(Map, SuccessorTellsListenersToForgetTheOldMap) {
  Map map = MakeMapWithViews(4);
  map.AddLandmark({1, 2, 3}, {{PhotoId{0}, 0}, {PhotoId{1}, 0}});
  Mirror listener;
  listener.Apply(*map.TakeDelta());
  map.AddLandmark({4, 5, 6}, {{PhotoId{2}, 3}, {PhotoId{3}, 3}});  // Never told.

  map = Map::SuccessorOf(map);
  map.AddView(PhotoId{2}, MakeView(2));
  map.AddView(PhotoId{9}, MakeView(9));
  const LandmarkId id = map.AddLandmark({7, 8, 9}, {{PhotoId{2}, 3}, {PhotoId{9}, 1}});
  EXPECT_EQ(id.value, 2U) << "ids are never used again";
  listener.Apply(*map.TakeDelta());
  EXPECT_EQ(listener.view_x.size(), 2U);
  EXPECT_EQ(listener.landmark_x.size(), 1U);
  EXPECT_EQ(listener.observations.size(), 2U);
}

TEST(Map, RefusesASnapshotThatContradictsItself) {
  Map map = MakeMapWithViews(3);
  map.AddLandmark({1, 2, 3}, {{PhotoId{0}, 0}, {PhotoId{1}, 0}});
  std::map<PhotoId, std::shared_ptr<const FeatureSet>> features;
  for (const auto& [photo, view] : map.views()) features[photo] = view.features;
  const MapDelta good = map.Snapshot();

  MapDelta loose = good;
  loose.landmarks_set.clear();
  EXPECT_THROW(Map::FromSnapshot(loose, features), std::runtime_error);
  MapDelta twice = good;
  twice.observations_added.push_back(twice.observations_added.front());
  EXPECT_THROW(Map::FromSnapshot(twice, features), std::runtime_error);
  MapDelta out_of_range = good;
  out_of_range.observations_added.front().feature_idx = kNumFeatures;
  EXPECT_THROW(Map::FromSnapshot(out_of_range, features), std::runtime_error);
  features.erase(PhotoId{0});
  EXPECT_THROW(Map::FromSnapshot(good, features), std::runtime_error);
}

TEST(Map, LandmarkWithOneObservationLeftIsGone) {
  Map map = MakeMapWithViews(3);
  const LandmarkId id = map.AddLandmark({1, 2, 3}, {{PhotoId{0}, 0}, {PhotoId{1}, 4}});
  map.RemoveObservation({PhotoId{0}, 0});
  EXPECT_FALSE(map.HasLandmark(id));
  EXPECT_FALSE(map.LandmarkOf({PhotoId{1}, 4}).IsValid());
  EXPECT_EQ(map.num_observations(), 0U);
}

TEST(Map, MergedLandmarkKeepsItsOwnObservationWhereBothAreSeen) {
  Map map = MakeMapWithViews(4);
  const LandmarkId kept = map.AddLandmark({0, 0, 0}, {{PhotoId{0}, 0}, {PhotoId{1}, 0}});
  const LandmarkId gone =
      map.AddLandmark({0, 0, 0}, {{PhotoId{1}, 5}, {PhotoId{2}, 5}, {PhotoId{3}, 5}});
  map.MergeLandmarks(kept, gone);
  EXPECT_EQ(map.landmark(kept).track.size(), 4U);
  EXPECT_EQ(map.LandmarkOf({PhotoId{1}, 0}), kept);
  EXPECT_FALSE(map.LandmarkOf({PhotoId{1}, 5}).IsValid());
  EXPECT_EQ(map.LandmarkOf({PhotoId{3}, 5}), kept);
}

TEST(Map, RefusesASecondObservationInOneView) {
  Map map = MakeMapWithViews(2);
  const LandmarkId id = map.AddLandmark({0, 0, 0}, {{PhotoId{0}, 0}, {PhotoId{1}, 0}});
  EXPECT_THROW(map.AddObservation(id, {PhotoId{1}, 3}), std::logic_error);
  EXPECT_THROW(map.AddObservation(id, {PhotoId{7}, 3}), std::logic_error);
}

TEST(Map, TheRefinedLensIsInOneDeltaAndInEverySnapshot) {
  const LensParameters<double> lens = {600, 601, 320, 240};
  Map map = MakeMapWithViews(2);
  EXPECT_FALSE(map.Snapshot().lens);
  map.SetLens(lens);
  EXPECT_EQ(map.Snapshot().lens, lens);
  EXPECT_EQ(Map::SuccessorOf(map).TakeDelta()->lens, lens);  // Not said yet.
  EXPECT_EQ(map.TakeDelta()->lens, lens);
  EXPECT_FALSE(map.TakeDelta());
  EXPECT_EQ(map.Snapshot().lens, lens);  // A late listener hears it too.

  Map successor = Map::SuccessorOf(map);
  EXPECT_FALSE(successor.TakeDelta()->lens);
  EXPECT_EQ(successor.Snapshot().lens, lens);
  Map restored =
      Map::FromSnapshot(map.Snapshot(), {{{0}, MakeFeatures(0)}, {{1}, MakeFeatures(1)}});
  EXPECT_EQ(restored.Snapshot().lens, lens);
  EXPECT_FALSE(restored.TakeDelta());
}

}  // namespace
}  // namespace plumb
