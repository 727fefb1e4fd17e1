// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface of whole flights: its energy, its truth and its speed. Prints JSON.
//   surface_benchmark record SESSION DELTAS   maps the session's photos again and keeps the deltas
//   surface_benchmark synthetic PHOTOS LANDMARKS DELTAS
//                                            a made-up flight of that size
//   surface_benchmark replay DELTAS [CHECK]   the mesher's time for each delta; with CHECK > 0
//                                            weights and labels are held against those
//                                            from scratch after every CHECKth
//   surface_benchmark truth SESSION POSES SURFACE
//                                            the mesh beside that of a full ray cast, both against
//                                            the true surface, and the time of both energies
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "plumbline/map/map_replica.h"
#include "plumbline/map/run_report.h"
#include "plumbline/sfm/mapper.h"
#include "plumbline/sfm/stored_session.h"
#include "plumbline/surface/mesh_replica.h"
#include "plumbline/surface/surface_mesher.h"
#include "surface/cell_weights.h"
#include "surface/labelled_cells.h"
#include "test/benchmark/cpu_watch.h"
#include "test/benchmark/delta_file.h"
#include "test/benchmark/surface_truth.h"
#include "test/benchmark/synthetic_flight.h"
#include "test/surface/cell_checks.h"
#include "test/surface/equal_meshes.h"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

// Keeps what the mapper says.
class DeltaRecorder : public MapperListener {
 public:
  void OnVerdict(const PhotoVerdict&) override {}
  void OnMapDelta(const MapDelta& delta) override { deltas.push_back(delta); }
  void OnSeconds(PhotoId, const StageSeconds&) override {}

  std::vector<MapDelta> deltas;
};

// One delta a photo: what the mapper says while it takes the photo, joined.
Json Record(const std::string& session, const std::string& path) {
  const SessionStore store = SessionStore::OpenExisting(session);
  DeltaRecorder recorder;
  MapperOptions options;
  options.deterministic = true;
  Mapper mapper(options, store.camera(), &recorder);
  std::size_t num_photos = 0;
  for (MapperPhoto& photo : ReadStoredSession(store).photos) {
    mapper.Add(std::move(photo));
    ++num_photos;
  }
  mapper.Finish();
  test::DeltaFile::Write(recorder.deltas, path);
  return {{"photos", num_photos}, {"deltas", recorder.deltas.size()}};
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What one delta took: CPU seconds of the whole, wall seconds of its stages.
struct Turn {
  SurfaceReport report;
  double cpu_s = 0.0;
  std::size_t num_faces_sent = 0;
};

Turn Apply(const MapDelta& delta, SurfaceMesher* mesher) {
  test::CpuWatch watch;
  const SurfaceUpdate update = mesher->Apply(delta).value();
  Turn turn{update.report, watch.Restart(), 0};
  for (const MeshBlock& block : update.mesh.blocks) turn.num_faces_sent += block.faces.size();
  return turn;
}

// Of the deltas from `begin` to `end`.
Json Medians(const std::vector<Turn>& turns, std::size_t begin, std::size_t end) {
  begin = std::min(begin, turns.size());
  end = std::min(end, turns.size());
  const auto median = [&](auto&& value_of) {
    std::vector<double> values;
    for (std::size_t i = begin; i < end; ++i) {
      values.push_back(static_cast<double>(value_of(turns[i].report)));
    }
    return Median(std::move(values));
  };
  std::vector<double> cpu_ms;
  std::vector<double> num_sent;
  for (std::size_t i = begin; i < end; ++i) {
    cpu_ms.push_back(1e3 * turns[i].cpu_s);
    num_sent.push_back(static_cast<double>(turns[i].num_faces_sent));
  }
  using Report = SurfaceReport;
  return {{"total_ms", Median(cpu_ms)},
          {"scene_wall_ms", 1e3 * median([](const Report& r) { return r.scene_s; })},
          {"tetrahedra_wall_ms", 1e3 * median([](const Report& r) { return r.tetrahedra_s; })},
          {"weights_wall_ms", 1e3 * median([](const Report& r) { return r.weights_s; })},
          {"cut_wall_ms", 1e3 * median([](const Report& r) { return r.cut_s; })},
          {"mesh_wall_ms", 1e3 * median([](const Report& r) { return r.mesh_s; })},
          {"landmarks_added", median([](const Report& r) { return r.num_landmarks_added; })},
          {"landmarks_moved", median([](const Report& r) { return r.num_landmarks_moved; })},
          {"reinserted", median([](const Report& r) { return r.num_landmarks_reinserted; })},
          {"views_moved", median([](const Report& r) { return r.num_views_moved; })},
          {"views_recast", median([](const Report& r) { return r.num_views_recast; })},
          {"rays_cast", median([](const Report& r) { return r.num_rays_cast; })},
          {"cells_changed", median([](const Report& r) { return r.num_cells_changed; })},
          {"labels_changed", median([](const Report& r) { return r.num_labels_changed; })},
          {"faces_checked", median([](const Report& r) { return r.num_faces_checked; })},
          {"faces_sent", Median(num_sent)}};
}

// Weights, labels and mesh against those from scratch; throws if they differ.
class Checker {
 public:
  void Check(const MapDelta& delta, const SurfaceMesher& mesher, bool is_due) {
    SurfaceReport report;
    cells_.Apply(delta, &report);
    map_.Apply(delta);
    if (!is_due) return;
    testing::internal::CaptureStdout();
    test::ExpectCountsAreThoseFromScratch(cells_);
    test::ExpectLabelsAreThoseOfAFreshSolve(cells_);
    SurfaceMesher fresh{SurfaceOptions()};
    MapDelta snapshot = map_.Snapshot();
    test::ExpectSameMesh(fresh.Apply(snapshot)->mesh, mesher.Snapshot());
    const std::string complaint = testing::internal::GetCapturedStdout();
    if (testing::Test::HasFailure()) {
      throw std::runtime_error("delta " + std::to_string(delta.sequence) + ": " + complaint);
    }
    ++num_checked_;
  }
  std::size_t num_checked() const { return num_checked_; }

 private:
  LabelledCells cells_{SurfaceOptions()};
  MapReplica map_;
  std::size_t num_checked_ = 0;
};

Json Replay(const std::string& path, std::size_t check_every) {
  const std::vector<MapDelta> deltas = test::DeltaFile::Read(path);
  const std::uint64_t bytes_before = CurrentProcessUsage().peak_memory_bytes;
  SurfaceMesher mesher{SurfaceOptions()};
  Checker checker;
  std::vector<Turn> turns;
  for (const MapDelta& delta : deltas) {
    turns.push_back(Apply(delta, &mesher));
    if (check_every > 0) checker.Check(delta, mesher, turns.size() % check_every == 0);
  }
  const std::uint64_t bytes_after = CurrentProcessUsage().peak_memory_bytes;
  std::vector<double> sorted_ms;
  for (const Turn& turn : turns) sorted_ms.push_back(1e3 * turn.cpu_s);
  std::sort(sorted_ms.begin(), sorted_ms.end());

  MapReplica map;
  for (const MapDelta& delta : deltas) map.Apply(delta);
  SurfaceMesher fresh{SurfaceOptions()};
  const double rebuild_s = Apply(map.Snapshot(), &fresh).cpu_s;
  const std::size_t num = turns.size();
  const SurfaceReport& last = turns.back().report;
  return {{"deltas", num},
          {"vertices", last.num_vertices},
          {"rays", last.num_rays},
          {"cells", last.num_cells},
          {"faces", last.num_faces},
          {"checked", checker.num_checked()},
          {"median_ms", Median(sorted_ms)},
          {"p95_ms", sorted_ms[num * 95 / 100]},
          {"max_ms", sorted_ms.back()},
          {"sum_s", 1e-3 * std::accumulate(sorted_ms.begin(), sorted_ms.end(), 0.0)},
          {"rebuild_ms", 1e3 * rebuild_s},
          {"memory_mib", static_cast<double>(bytes_after - bytes_before) / 1048576.0},
          {"all", Medians(turns, 0, num)},
          {"100_to_200", Medians(turns, 100, 200)},
          {"last_100", Medians(turns, num > 100 ? num - 100 : 0, num)},
          {"rebuilds", std::count_if(turns.begin(), turns.end(), [](const Turn& turn) {
             return turn.report.is_rebuilt;
           })}};
}

Json Synthetic(int num_photos, int num_landmarks, const std::string& path) {
  test::SyntheticFlight::Options options;
  options.num_photos = num_photos;
  options.num_landmarks = num_landmarks;
  const std::vector<MapDelta> deltas = test::SyntheticFlight(options).Fly();
  test::DeltaFile::Write(deltas, path);
  return {{"deltas", deltas.size()}};
}

int Main(const std::vector<std::string>& arguments) {
  const std::string mode = arguments.empty() ? "" : arguments[0];
  if (mode == "record" && arguments.size() == 3) {
    std::cout << Record(arguments[1], arguments[2]).dump(1) << '\n';
  } else if (mode == "synthetic" && arguments.size() == 4) {
    std::cout << Synthetic(std::stoi(arguments[1]), std::stoi(arguments[2]), arguments[3]).dump(1)
              << '\n';
  } else if (mode == "replay" && (arguments.size() == 2 || arguments.size() == 3)) {
    const std::size_t check_every = arguments.size() == 3 ? std::stoul(arguments[2]) : 0;
    std::cout << Replay(arguments[1], check_every).dump(1) << '\n';
  } else if (mode == "truth" && arguments.size() == 4) {
    std::cout << test::CompareWithTruth(arguments[1], arguments[2], arguments[3]).dump(1) << '\n';
  } else {
    std::cerr << "surface_benchmark record|synthetic|replay|truth; see the head of its source\n";
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  try {
    return plumb::Main({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "surface_benchmark: " << error.what() << '\n';
    return 1;
  }
}
