// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment_cell.h"

#include <time.h>

#include <algorithm>
#include <utility>

#include "plumbline/georeference/georeferencer.h"
#include "plumbline/sfm/map_refinement.h"
#include "tools/experiment_measure.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

class SilentListener : public MapperListener {
 public:
  void OnVerdict(const PhotoVerdict&) override {}
  void OnMapDelta(const MapDelta&) override {}
  void OnSeconds(PhotoId, const StageSeconds&) override {}
};

// Of this thread alone: several cells are in work. A mapper's background bundle is not in it.
double ThreadCpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool IsOf(const CellKey& key, const PreparedPhoto& photo) {
  return key.rows == kAllRows || photo.photo.row == key.rows;
}

// Photo i of the data has id i.
struct Reconstruction {
  Map map;
  Camera camera;
  int num_photos = 0;
  double cpu_s = 0.0;
};

Reconstruction Reconstruct(const ExperimentData& data, const CellKey& key, const Camera& faulty) {
  const double start_s = ThreadCpu_s();
  SilentListener listener;
  Mapper mapper(data.options.reconstruction, faulty, &listener);
  int num_photos = 0;
  for (std::size_t i = 0; i < data.photos.size(); ++i) {
    const PreparedPhoto& photo = data.photos[i];
    if (!IsOf(key, photo)) continue;
    ++num_photos;
    mapper.Add({{static_cast<std::uint32_t>(i)},
                photo.photo.name,
                photo.analysis.metadata.exposure_time.value_or(Timestamp{}),
                photo.analysis,
                0.0});
  }
  mapper.Finish();
  return {mapper.map(), mapper.camera(), num_photos, ThreadCpu_s() - start_s};
}

MapDelta SnapshotOf(const Map& map, const Camera& camera) {
  MapDelta snapshot = map.Snapshot();
  snapshot.lens = camera.lens();
  return snapshot;
}

Georeferencer GeoreferencerOf(const ExperimentData& data, const Map& map, const Camera& camera) {
  Georeferencer georeferencer(data.options.georeferencer, camera);
  georeferencer.Apply(SnapshotOf(map, camera));
  for (const auto& [photo, view] : map.views()) {
    georeferencer.SetMarkers(photo, data.photos[photo.value].markers);
  }
  georeferencer.SetSurvey(data.flight.survey);
  georeferencer.Update();
  return georeferencer;
}

// The options of one of kBundles, and whether its markers are in the bundle.
RefinementOptions OptionsOf(const ExperimentOptions& options, const std::string& bundle) {
  RefinementOptions refinement = options.refinement;
  const bool holds_lens = bundle == "held";
  refinement.bundle.refine_focal_length = !holds_lens;
  refinement.bundle.refine_principal_point = !holds_lens;
  refinement.bundle.refine_distortion = !holds_lens;
  const bool is_multi_scale = bundle == "multi_scale" || bundle == "constrained";
  refinement.bundle.distance_exponent = is_multi_scale ? options.distance_exponent : 0.0;
  return refinement;
}

Json RunBundle(const ExperimentData& data,
               const Reconstruction& reconstruction,
               const Camera& faulty,
               const std::string& bundle) {
  const double start_s = ThreadCpu_s();
  Map map = reconstruction.map;
  const Camera& start = bundle == "held" ? faulty : reconstruction.camera;
  BundleConstraints constraints;
  if (bundle == "constrained") {
    constraints = GeoreferencerOf(data, map, reconstruction.camera).Constraints();
  }
  const MapRefinement refinement =
      RefineMap(OptionsOf(data.options, bundle), start, constraints, &map);
  if (!refinement.is_usable) return nullptr;
  const double seconds = ThreadCpu_s() - start_s;
  Georeferencer georeferencer = GeoreferencerOf(data, map, refinement.camera);
  Json json = MeasureMap(data, map, refinement.camera, georeferencer.Update());
  json["cpu_s"] = seconds;
  return json;
}

}  // namespace

Json RunCell(const ExperimentData& data, const CellKey& key) {
  const Camera faulty = MakeFaultyCamera(data.flight.camera, key.seed);
  const Reconstruction reconstruction = Reconstruct(data, key, faulty);
  Json json = {
      {"rows", key.rows},
      {"seed", key.seed},
      {"photos", reconstruction.num_photos},
      {"located", reconstruction.map.views().size()},
      {"faulty_lens", {{"focal_px", faulty.MeanFocalLength()}, {"k1", faulty.lens()[kK1]}}},
      {"reconstruct_cpu_s", reconstruction.cpu_s},
      {"bundles", Json::object()}};
  for (const char* bundle : kBundles) {
    json["bundles"][bundle] = reconstruction.map.views().empty()
                                  ? Json(nullptr)
                                  : RunBundle(data, reconstruction, faulty, bundle);
  }
  return json;
}

}  // namespace plumb::tools
