// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How long Georeferencer::Update takes in a flight of so many photos, with 17 targets, GPS and 600
// landmarks a photo: after a photo whose local bundle moved seven views, and after a global bundle.
#include <benchmark/benchmark.h>

#include "plumbline/georeference/georeferencer.h"
#include "test/georeference/survey_scene.h"

namespace plumb {
namespace {

constexpr int kRows = 3;
constexpr int kLandmarksPerPhoto = 600;
constexpr std::size_t kMovedViews = 7;

struct Flight {
  test::SurveyScene scene;
  Georeferencer georeferencer;
};

// `num_wrong` of the targets are wrong, the first two of them exchanged.
Flight MakeFlight(int num_photos, int num_wrong) {
  test::SurveySceneOptions options;
  options.num_columns = num_photos / kRows;
  test::SurveyScene scene = test::MakeSurveyScene(options);
  const std::size_t num_known = scene.map.landmarks_set.size();
  for (int i = 0; i < num_photos * kLandmarksPerPhoto; ++i) {
    LandmarkState landmark = scene.map.landmarks_set[static_cast<std::size_t>(i) % num_known];
    landmark.id = LandmarkId{static_cast<std::uint32_t>(i)};
    scene.map.landmarks_set.push_back(landmark);
  }
  std::vector<SurveyTarget>& targets = scene.survey.targets;
  if (num_wrong >= 2) std::swap(targets[3].point_in_crs, targets[9].point_in_crs);
  if (num_wrong >= 3) targets[6].point_in_crs.x() += 0.5;
  Georeferencer georeferencer = test::MakeGeoreferencer(scene);
  for (const ViewState& view : scene.map.views_set) {
    const Eigen::Vector3d in_enu =
        scene.map_from_enu.Inverse() * view.cam_from_map.TargetOriginInSource();
    georeferencer.SetPosition(view.photo,
                              {48.2 + in_enu.y() / 111e3, 16.4 + in_enu.x() / 74e3, in_enu.z()});
  }
  georeferencer.Update();
  return {std::move(scene), std::move(georeferencer)};
}

void RunUpdates(benchmark::State& state, std::size_t num_moved, int num_wrong) {
  Flight flight = MakeFlight(static_cast<int>(state.range(0)), num_wrong);
  const std::vector<ViewState>& views = flight.scene.map.views_set;
  MapDelta delta;
  delta.sequence = flight.scene.map.sequence;
  std::size_t first = 0;
  for (auto _ : state) {
    state.PauseTiming();
    ++delta.sequence;
    delta.views_set.clear();
    for (std::size_t i = 0; i < std::min(num_moved, views.size()); ++i) {
      delta.views_set.push_back(views[(first + i) % views.size()]);
    }
    first += 11;
    flight.georeferencer.Apply(delta);
    state.ResumeTiming();
    benchmark::DoNotOptimize(flight.georeferencer.Update());
  }
}

void AfterAPhoto(benchmark::State& state) { RunUpdates(state, kMovedViews, 0); }
void AfterAPhotoWithThreeWrong(benchmark::State& state) { RunUpdates(state, kMovedViews, 3); }
void AfterAGlobalBundle(benchmark::State& state) { RunUpdates(state, 1'000'000, 0); }

BENCHMARK(AfterAPhoto)->Arg(50)->Arg(500)->Unit(benchmark::kMillisecond);
BENCHMARK(AfterAPhotoWithThreeWrong)->Arg(500)->Unit(benchmark::kMillisecond);
BENCHMARK(AfterAGlobalBundle)->Arg(500)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb

BENCHMARK_MAIN();
