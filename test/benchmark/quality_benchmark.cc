// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the quality of the surface takes a photo beside the surface itself, in time of the thread
// that waits for it and, both together, by the clock. Prints JSON.
//   quality_benchmark PHOTOS LANDMARKS     over a made-up flight of the paper's size
//   quality_benchmark replay DELTAS CAMERA over a recorded one (surface_benchmark record)
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plumbline/common/stopwatch.h"
#include "plumbline/map/run_report.h"
#include "plumbline/quality/gaps.h"
#include "plumbline/quality/quality_map.h"
#include "plumbline/surface/surface_mesher.h"
#include "test/benchmark/cpu_watch.h"
#include "test/benchmark/delta_file.h"
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
  double wall_s = 0.0;  // Of surface and quality, by the clock.
  double num_rays = 0.0;
  double num_views = 0.0;
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
          {"both_wall_ms", quantile(0.5, [](const Step& s) { return 1e3 * s.wall_s; })},
          {"gaps_ms", quantile(0.5, [](const Step& s) { return 1e3 * s.gaps_s; })},
          {"rays", quantile(0.5, [](const Step& s) { return s.num_rays; })},
          {"views", quantile(0.5, [](const Step& s) { return s.num_views; })},
          {"blocks", quantile(0.5, [](const Step& s) { return s.num_blocks; })}};
}

std::vector<MapDelta> MadeUpFlight(int num_photos, int num_landmarks) {
  test::SyntheticFlight::Options options;
  options.num_photos = num_photos;
  options.num_landmarks = num_landmarks;
  std::vector<MapDelta> deltas = test::SyntheticFlight(options).Fly();
  for (MapDelta& delta : deltas) TurnToWall(&delta);
  return deltas;
}

void MeasureSteps(const std::vector<MapDelta>& deltas, const Camera& camera) {
  const std::uint64_t bytes_before = CurrentProcessUsage().peak_memory_bytes;
  SurfaceMesher surface{SurfaceOptions()};
  QualityMap quality{QualityOptions()};
  quality.SetCamera(camera);
  const double half_photo_px = 0.5 * std::min(camera.width_px(), camera.height_px());
  const Measure measure{1.0, camera.MeanFocalLength(), 0.5, half_photo_px};
  std::vector<Step> steps;
  for (const MapDelta& delta : deltas) {
    const Stopwatch stopwatch;
    test::CpuWatch watch;
    Step step;
    const std::optional<SurfaceUpdate> update = surface.Apply(delta);
    if (!update) continue;
    step.surface_s = watch.Restart();
    const QualityUpdate changed = quality.Apply(delta, update->mesh);
    step.quality_s = watch.Restart();
    step.wall_s = stopwatch.Seconds();
    FindGaps(GapOptions(), quality.blocks(), measure, 1.0);
    step.gaps_s = watch.Restart();
    step.num_rays = static_cast<double>(changed.num_rays);
    step.num_views = static_cast<double>(delta.views_set.size());
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
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 3 && arguments[0] == "replay") {
    plumb::MeasureSteps(plumb::test::DeltaFile::Read(arguments[1]),
                        plumb::ReadCameraYaml(arguments[2]));
  } else if (arguments.size() == 2) {
    plumb::MeasureSteps(plumb::MadeUpFlight(std::stoi(arguments[0]), std::stoi(arguments[1])),
                        plumb::PaperCamera());
  } else {
    std::cerr << "quality_benchmark PHOTOS LANDMARKS, or replay DELTAS CAMERA\n";
    return 2;
  }
  return 0;
}
