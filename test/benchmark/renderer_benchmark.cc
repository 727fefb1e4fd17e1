// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time of Renderer::Render for the paper's camera (16.1 megapixels, 2 x 2 samples) before the
// default facade, at the distances of its flight and from afar; and of the renderer's
// construction.
#include <benchmark/benchmark.h>

#include "plumbline/simulation/facade.h"
#include "plumbline/simulation/renderer.h"
#include "test/simulation/test_world.h"

namespace plumb {
namespace {

const World& Facade() {
  static const World world = BuildFacade({});
  return world;
}

void BuildRenderer(benchmark::State& state) {
  for (auto _ : state) {
    const Renderer renderer(Facade());
    benchmark::DoNotOptimize(&renderer);
  }
}
BENCHMARK(BuildRenderer)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void RenderPhoto(benchmark::State& state) {
  static const Renderer renderer(Facade());
  const Camera camera = test::MakePaperCamera();
  const auto distance_m = static_cast<double>(state.range(0));
  const auto height_m = static_cast<double>(state.range(1));
  const Rigid3 cam_from_world = test::LookAtWall({14.0, -distance_m, height_m});
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.Render(camera, cam_from_world, {}).data);
  }
}
BENCHMARK(RenderPhoto)
    ->ArgNames({"distance_m", "height_m"})
    ->Args({4, 9})
    ->Args({6, 16})
    ->Args({10, 9})
    ->Args({10, 22})
    ->Args({35, 15})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace plumb

BENCHMARK_MAIN();
