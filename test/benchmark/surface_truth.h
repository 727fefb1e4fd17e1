// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "plumbline/evaluation/distance_summary.h"
#include "plumbline/evaluation/nearest.h"
#include "plumbline/evaluation/ply_reader.h"
#include "plumbline/evaluation/pose_evaluation.h"
#include "plumbline/evaluation/visibility.h"
#include "plumbline/map/session_store.h"
#include "surface/cell_weights.h"
#include "surface/face_support.h"
#include "surface/islands.h"
#include "surface/labelled_cells.h"
#include "surface/outward_face.h"
#include "surface/ray_cast.h"
#include "surface/spikes.h"
#include "test/benchmark/cpu_watch.h"
#include "test/surface/full_ray_cast.h"

namespace plumb::test {

using LabelOf = std::function<bool(Cell)>;  // Whether a cell is free.

// The faces of a labelling after the same filters as the product's.
inline std::vector<FaceSlots> KeptFaces(const LabelledCells& cells, const LabelOf& is_free) {
  const RayScene& scene = cells.scene();
  FaceSupport support(scene, cells.options().max_edge_ratio);
  FacePool pool;
  std::vector<Slot> slots;
  std::uint32_t arc = 0;
  for (const Cell cell : cells.tetrahedra().triangulation().finite_cell_handles()) {
    if (is_free(cell)) continue;
    for (int i = 0; i < 4; ++i) {
      if (!is_free(cell->neighbor(i))) continue;
      const FaceSlots face = OutwardFace(cell, i);
      if (!support.IsSupported(face)) continue;
      const FaceKey key = {scene.IdOf(face[0]), scene.IdOf(face[1]), scene.IdOf(face[2])};
      pool.Add(arc++, face, key, {});
      slots.insert(slots.end(), face.begin(), face.end());
    }
  }
  IslandFinder(cells.options().min_island_faces).Update(slots, &pool);
  SpikeFinder spikes(cells.options().max_spike_ratio);
  spikes.Update(slots, scene, pool);
  std::vector<FaceSlots> kept;
  for (FaceIdx face = 0; face < pool.capacity(); ++face) {
    if (!pool[face].is_island && !spikes.HasSpike(pool[face].slots))
      kept.push_back(pool[face].slots);
  }
  return kept;
}

// A surface that was measured from images has errors of so many ground sampling distances.
struct GsdScale {
  std::vector<double> gsd_m;  // By slot: of the nearest photo that shows the landmark.
  double mean_error_gsd = 0.0;
};

class TruthComparison {
 public:
  TruthComparison(const LabelledCells& cells,
                  const Camera& camera,
                  const Similarity3& world_from_map,
                  const std::vector<TruePose>& photos,
                  const TriangleMesh& truth)
      : cells_(cells), world_from_map_(world_from_map), index_(truth) {
    const TriangleMesh in_view = PiecesInView(truth, camera, photos);
    std::vector<Eigen::Vector3d> samples;
    for (const SurfaceSample& sample : SampleSurface(in_view, kNumSamples, 1)) {
      samples.push_back(sample.point);
    }
    seen_ = PointsSeen(samples, index_, camera, photos, 2);
    MeasureScale(camera);
  }

  nlohmann::ordered_json Compare(const std::vector<FaceSlots>& faces) const {
    TriangleMesh mesh;
    for (const FaceSlots& slots : faces) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Slot slot : slots) mesh.vertices.push_back(InWorld(slot));
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    std::vector<Eigen::Vector3d> points;
    std::vector<double> gsd_m;
    for (const SurfaceSample& sample : SampleSurface(mesh, kNumSamples, 2)) {
      points.push_back(sample.point);
      double sum = 0.0;
      for (const Slot slot : faces[sample.triangle_idx]) sum += scale_.gsd_m[slot];
      gsd_m.push_back(sum / 3.0);
    }
    const std::vector<double> distances = EvaluateAtPoints(
        points, [&](const Eigen::Vector3d& point) { return index_.NearestTo(point).distance; });
    std::size_t num_within = 0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      num_within += distances[i] <= 2.0 * scale_.mean_error_gsd * gsd_m[i] ? 1U : 0U;
    }
    const MeshIndex mesh_index(mesh);
    const DistanceSummary accuracy = SummariseDistances(distances);
    const DistanceSummary completeness = SummariseDistances(EvaluateAtPoints(
        seen_, [&](const Eigen::Vector3d& point) { return mesh_index.NearestTo(point).distance; }));
    return {{"faces", faces.size()},
            {"within_2_mean_errors",
             static_cast<double>(num_within) / static_cast<double>(distances.size())},
            {"accuracy_median_mm", accuracy.median_mm},
            {"accuracy_p90_mm", accuracy.p90_mm},
            {"accuracy_20_mm", accuracy.share_within[4]},
            {"completeness_20_mm", completeness.share_within[4]},
            {"f_score_20_mm", FScore(accuracy, completeness)[4]},
            {"f_score_10_mm", FScore(accuracy, completeness)[3]}};
  }

  double mean_error_gsd() const { return scale_.mean_error_gsd; }

 private:
  static constexpr std::size_t kNumSamples = 60000;

  Eigen::Vector3d InWorld(Slot slot) const {
    return world_from_map_ * cells_.scene().MeshPositionOf(slot);
  }

  void MeasureScale(const Camera& camera) {
    scale_.gsd_m.resize(cells_.scene().num_slots());
    std::vector<Eigen::Vector3d> points;
    const std::vector<Slot> slots = cells_.scene().PlacedSlots();
    std::vector<SceneRay> rays;
    for (const Slot slot : slots) {
      points.push_back(InWorld(slot));
      cells_.scene().RaysOf(slot, &rays);
      double nearest_m = std::numeric_limits<double>::infinity();
      for (const SceneRay& ray : rays) {
        nearest_m = std::min(nearest_m, (world_from_map_ * ray.camera - points.back()).norm());
      }
      scale_.gsd_m[slot] = nearest_m / camera.MeanFocalLength();
    }
    const std::vector<double> errors = EvaluateAtPoints(
        points, [&](const Eigen::Vector3d& point) { return index_.NearestTo(point).distance; });
    for (std::size_t i = 0; i < slots.size(); ++i) {
      scale_.mean_error_gsd +=
          errors[i] / scale_.gsd_m[slots[i]] / static_cast<double>(slots.size());
    }
  }

  const LabelledCells& cells_;
  Similarity3 world_from_map_;
  MeshIndex index_;
  std::vector<Eigen::Vector3d> seen_;
  GsdScale scale_;
};

// CPU seconds of the product's energy from nothing: its rays, its cut by DynamicCut, and the same
// cut by the library that the full ray cast is solved by.
struct EnergySeconds {
  double weights_s = 0.0;
  double cut_s = 0.0;
  double cut_by_library_s = 0.0;
};

inline EnergySeconds TimeEnergy(const LabelledCells& cells) {
  const Triangulation& triangulation = cells.tetrahedra().triangulation();
  EnergySeconds seconds;
  CpuWatch watch;
  std::vector<SceneRay> rays;
  RayStar star;
  for (const Vertex vertex : triangulation.finite_vertex_handles()) {
    cells.scene().RaysOf(vertex->info().slot, &rays);
    CastRays(triangulation, vertex, rays, &star);  // Counts again what is counted already.
  }
  seconds.weights_s = watch.Restart();

  std::unordered_map<CutNode, CutNode> node_of;
  DynamicCut cut;
  FreshCut library(cells.cut().num_nodes());
  for (const Cell cell : triangulation.finite_cell_handles()) {
    const CutNode node = cut.AddNode();
    node_of[cell->info().node] = node;
    cut.SetTerminal(node, TerminalOf(cells.options(), triangulation, cell));
    library.SetTerminal(static_cast<int>(node), TerminalOf(cells.options(), triangulation, cell));
  }
  for (const Cell cell : triangulation.finite_cell_handles()) {
    const CutNode node = node_of.at(cell->info().node);
    for (int i = 0; i < 4; ++i) {
      const Cell neighbor = cell->neighbor(i);
      if (triangulation.is_infinite(neighbor)) continue;
      const CutNode other = node_of.at(neighbor->info().node);
      if (other < node) continue;
      const std::int32_t weight = FaceWeightOf(cells.options(), cell, i);
      cut.Connect(node,
                  static_cast<std::uint32_t>(i),
                  other,
                  static_cast<std::uint32_t>(neighbor->index(cell)));
      cut.SetCapacity(node, static_cast<std::uint32_t>(i), weight);
      library.AddEdge(static_cast<int>(node), static_cast<int>(other), weight);
    }
  }
  watch.Restart();
  cut.Solve();
  seconds.cut_s = watch.Restart();
  library.Solve();
  seconds.cut_by_library_s = watch.Restart();
  return seconds;
}

inline nlohmann::ordered_json CompareWithTruth(const std::string& session,
                                               const std::string& poses,
                                               const std::string& surface) {
  const SessionStore store = SessionStore::OpenExisting(session);
  MapDelta snapshot = store.Snapshot();
  snapshot.is_snapshot = true;
  const std::vector<TruePose> photos = ReadTruePoses(poses);
  LabelledCells cells{SurfaceOptions()};
  SurfaceReport report;
  cells.Apply(snapshot, &report);

  FullRayCast full({}, cells.tetrahedra().triangulation());
  CpuWatch watch;
  full.Cast(cells.scene());
  const double cast_s = watch.Restart();
  full.Prepare();
  watch.Restart();
  full.Solve();
  const double solve_s = watch.Restart();
  const EnergySeconds own = TimeEnergy(cells);

  const TruthComparison truth(cells,
                              store.camera(),
                              EvaluatePoses(snapshot.views_set, photos).world_from_map,
                              photos,
                              ReadPlyMesh(surface));
  return {{"vertices", report.num_vertices},
          {"rays", report.num_rays},
          {"cells", report.num_cells},
          {"mean_error_gsd", truth.mean_error_gsd()},
          {"ours",
           truth.Compare(KeptFaces(cells, [&](Cell cell) { return IsFree(cells.cut(), cell); }))},
          {"full_ray_cast",
           truth.Compare(KeptFaces(cells, [&](Cell cell) { return full.IsFree(cell); }))},
          {"weights_cpu_s", own.weights_s},
          {"cut_cpu_s", own.cut_s},
          {"cut_by_library_cpu_s", own.cut_by_library_s},
          {"full_cast_cpu_s", cast_s},
          {"full_cut_cpu_s", solve_s}};
}

}  // namespace plumb::test
