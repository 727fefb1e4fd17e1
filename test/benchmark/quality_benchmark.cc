// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the quality of the surface takes a photo beside the surface itself, over a made-up flight of
// the paper's size, in time of the processor. Prints JSON.
//   quality_benchmark PHOTOS LANDMARKS
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plumbline/map/run_report.h"
#include "plumbline/quality/gaps.h"
#include "plumbline/quality/quality_map.h"
#include "plumbline/surface/surface_mesher.h"
#include "test/benchmark/cpu_watch.h"
#include "test/benchmark/synthetic_flight.h"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

// 16 mm before APS-C with 16 megapixels.
Camera PaperCamera() {
  LensParameters<double> lens = {3344.0, 3344.0, 2456.0, 1632.0, -0.072, 0.041, 0.0004, -0.0003};
  return Camera("paper", 4912, 3264, DistortionModel::kPlumbBob, lens);
}

// The made-up flight tells only where its cameras are: they look along y, upright in z.
void TurnToWall(MapDelta* delta) {
  Eigen::Matrix3d cam_from_map;
  cam_from_map << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  for (ViewState& view : delta->views_set) {
    const Eigen::Vector3d center = view.cam_from_map.TargetOriginInSource();
    view.cam_from_map = Rigid3(Eigen::Quaterniond(cam_from_map), -(cam_from_map * center));
  }
}

struct Step {
  double surface_s = 0.0;
  double quality_s = 0.0;
  double gaps_s = 0.0;
  double num_rays = 0.0;
  double num_blocks = 0.0;
};

Json Summarize(const std::vector<Step>& steps, std::size_t begin, std::size_t end) {
  begin = std::min(begin, steps.size());
  end = std::min(end, steps.size());
  const auto quantile = [&](double share, auto&& value_of) {
    std::vector<double> values;
    for (std::size_t i = begin; i < end; ++i) values.push_back(value_of(steps[i]));
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const auto total = [](const Step& step) { return 1e3 * (step.surface_s + step.quality_s); };
  return {{"surface_ms", quantile(0.5, [](const Step& s) { return 1e3 * s.surface_s; })},
          {"quality_ms", quantile(0.5, [](const Step& s) { return 1e3 * s.quality_s; })},
          {"both_ms", quantile(0.5, total)},
          {"both_p95_ms", quantile(0.95, total)},
          {"gaps_ms", quantile(0.5, [](const Step& s) { return 1e3 * s.gaps_s; })},
          {"rays", quantile(0.5, [](const Step& s) { return s.num_rays; })},
          {"blocks", quantile(0.5, [](const Step& s) { return s.num_blocks; })}};
}

int Main(int num_photos, int num_landmarks) {
  test::SyntheticFlight::Options options;
  options.num_photos = num_photos;
  options.num_landmarks = num_landmarks;
  const std::vector<MapDelta> deltas = test::SyntheticFlight(options).Fly();
  const std::uint64_t bytes_before = CurrentProcessUsage().peak_memory_bytes;
  SurfaceMesher surface{SurfaceOptions()};
  QualityMap quality{QualityOptions()};
  quality.SetCamera(PaperCamera());
  const Measure measure{1.0, 3344.0, 0.5, /*half_photo_px=*/1632.0};
  std::vector<Step> steps;
  for (MapDelta delta : deltas) {
    TurnToWall(&delta);
    test::CpuWatch watch;
    Step step;
    const SurfaceUpdate update = surface.Apply(delta).value();
    step.surface_s = watch.Restart();
    const QualityUpdate changed = quality.Apply(delta, update.mesh);
    step.quality_s = watch.Restart();
    FindGaps(GapOptions(), quality.blocks(), measure, 1.0);
    step.gaps_s = watch.Restart();
    step.num_rays = static_cast<double>(changed.num_rays);
    step.num_blocks = static_cast<double>(changed.blocks.size());
    steps.push_back(step);
  }
  std::size_t num_faces = 0;
  for (const auto& [id, block] : quality.blocks()) num_faces += block.mesh.faces.size();
  const std::uint64_t bytes = CurrentProcessUsage().peak_memory_bytes - bytes_before;
  const Json result = {
      {"photos", steps.size()},
      {"faces", num_faces},
      {"memory_mib", static_cast<double>(bytes) / 1048576.0},
      {"all", Summarize(steps, 0, steps.size())},
      {"100_to_200", Summarize(steps, 100, 200)},
      {"last_100", Summarize(steps, steps.size() > 100 ? steps.size() - 100 : 0, steps.size())}};
  std::cout << result.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "quality_benchmark PHOTOS LANDMARKS\n";
    return 2;
  }
  return plumb::Main(std::stoi(argv[1]), std::stoi(argv[2]));
}
