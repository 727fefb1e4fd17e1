// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/geometry_report.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "plumbline/evaluation/distance_summary.h"
#include "plumbline/evaluation/nearest.h"
#include "plumbline/evaluation/ply_reader.h"
#include "plumbline/evaluation/visibility.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::vector<Eigen::Vector3d>;

constexpr std::uint64_t kSeed = 1;
constexpr int kMinPhotos = 2;  // A point that one photo shows cannot be reconstructed.

Json ToJson(const SharesWithin& shares) {
  Json json = Json::object();
  for (std::size_t i = 0; i < shares.size(); ++i) {
    std::ostringstream bound;
    bound << kDistanceBoundsMm[i] << " mm";
    json[bound.str()] = shares[i];
  }
  return json;
}

// Null of no points: 0 mm would say that they fit.
Json ToJson(const DistanceSummary& summary) {
  if (summary.num_points == 0) return nullptr;
  return {{"points", summary.num_points},
          {"mean_mm", summary.mean_mm},
          {"median_mm", summary.median_mm},
          {"rms_mm", summary.rms_mm},
          {"p90_mm", summary.p90_mm},
          {"max_mm", summary.max_mm},
          {"share_within", ToJson(summary.share_within)}};
}

Json ToJson(const WallBend& wall) {
  Json cells = Json::array();
  for (const WallCell& cell : wall.cells) {
    cells.push_back({{"u_m", cell.u_m},
                     {"v_m", cell.v_m},
                     {"points", cell.num_points},
                     {"bend_mm", cell.bend_mm},
                     {"sigma_mm", cell.sigma_mm}});
  }
  return {{"max_bend_mm", wall.max_mm},
          {"sigma_mm", wall.sigma_mm},
          {"rms_bend_mm", wall.rms_mm},
          {"range_mm", wall.range_mm},
          {"points", wall.num_points},
          {"cells_left_out", wall.num_left_out},
          {"cells", cells}};
}

Json Compare(const DistanceSummary& accuracy, const DistanceSummary& completeness) {
  const bool has_both = accuracy.num_points != 0 && completeness.num_points != 0;
  return {{"accuracy", ToJson(accuracy)},
          {"completeness", ToJson(completeness)},
          {"f_score", has_both ? ToJson(FScore(accuracy, completeness)) : Json(nullptr)}};
}

using DistanceTo = std::function<double(const Eigen::Vector3d&)>;

// Of the truth that can have been reconstructed, how far the reconstruction is.
class Completeness {
 public:
  Completeness(const GeometryTruth& truth, const Camera& camera, DistanceTo reconstructed)
      : truth_(truth), camera_(camera), reconstructed_(std::move(reconstructed)) {}

  DistanceSummary Of(Points true_points, const MeshIndex* surface) const {
    if (surface != nullptr) {
      true_points = PointsSeen(true_points, *surface, camera_, truth_.photos, kMinPhotos);
    }
    return SummariseDistances(EvaluateAtPoints(true_points, reconstructed_));
  }

 private:
  const GeometryTruth& truth_;
  const Camera& camera_;
  DistanceTo reconstructed_;
};

Points Thinned(const Points& points, std::size_t max_points) {
  Points thinned;
  std::mt19937_64 random(kSeed);
  std::sample(points.begin(), points.end(), std::back_inserter(thinned), max_points, random);
  return thinned;
}

Json CompareWithSurface(const GeometryTruth& truth,
                        const TriangleMesh& in_view,
                        const MeshIndex& index,
                        const Completeness& completeness,
                        const Points& points) {
  const auto distances = EvaluateAtPoints(
      points, [&](const Eigen::Vector3d& point) { return index.NearestTo(point).distance; });
  Points samples;
  if (!in_view.triangles.empty()) {
    for (const SurfaceSample& sample : SampleSurface(in_view, truth.num_samples, kSeed)) {
      samples.push_back(sample.point);
    }
  }
  return Compare(SummariseDistances(distances), completeness.Of(samples, &index));
}

Json CompareWithLaser(const GeometryTruth& truth,
                      const MeshIndex* surface,
                      const Completeness& completeness,
                      const Points& points) {
  const Points scan = ReadPlyPoints(truth.laser);
  const CloudIndex index(scan);
  const auto distances = EvaluateAtPoints(
      points, [&](const Eigen::Vector3d& point) { return index.DistanceToSurface(point); });
  return Compare(SummariseDistances(distances),
                 completeness.Of(Thinned(scan, truth.num_samples), surface));
}

Json MeasureWall(const GeometryTruth& truth,
                 const TriangleMesh& mesh,
                 const MeshIndex& index,
                 const Points& points) {
  const bool has_wall =
      std::find(mesh.is_main_wall.begin(), mesh.is_main_wall.end(), 1) != mesh.is_main_wall.end();
  if (!has_wall) return nullptr;
  const auto wall = MeasureBend(truth.wall, PointsOfMainWall(truth.wall, mesh, index, points));
  return wall ? ToJson(*wall) : Json(nullptr);
}

// The true surface, ready to be measured from; null if there is none.
struct SurfaceTruth {
  TriangleMesh mesh;
  std::unique_ptr<MeshIndex> index;
};

SurfaceTruth ReadSurface(const std::string& path) {
  SurfaceTruth surface;
  if (path.empty()) return surface;
  surface.mesh = ReadPlyMesh(path);
  try {
    surface.index = std::make_unique<MeshIndex>(surface.mesh);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  return surface;
}

// "surface" and "laser", as far as they are given.
Json CompareWithTruth(const GeometryTruth& truth,
                      const Camera& camera,
                      const SurfaceTruth& surface,
                      const Completeness& completeness,
                      const Points& points) {
  Json report = Json::object();
  if (surface.index != nullptr) {
    report["surface"] = CompareWithSurface(truth,
                                           PiecesInView(surface.mesh, camera, truth.photos),
                                           *surface.index,
                                           completeness,
                                           points);
  }
  if (!truth.laser.empty()) {
    report["laser"] = CompareWithLaser(truth, surface.index.get(), completeness, points);
  }
  return report;
}

}  // namespace

void ReportGeometry(const GeometryTruth& truth,
                    const Camera& camera,
                    const Points& points_in_world,
                    Json* report) {
  if (truth.surface.empty() && truth.laser.empty()) return;
  if (points_in_world.empty()) {
    throw std::runtime_error("the session's map has no points to hold against the truth");
  }
  const auto cloud = std::make_shared<CloudIndex>(points_in_world);
  const Completeness completeness(
      truth, camera, [cloud](const Eigen::Vector3d& point) { return cloud->DistanceTo(point); });
  const SurfaceTruth surface = ReadSurface(truth.surface);
  report->update(CompareWithTruth(truth, camera, surface, completeness, points_in_world));
  if (surface.index == nullptr) return;
  try {
    (*report)["wall"] = MeasureWall(truth, surface.mesh, *surface.index, points_in_world);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(truth.surface + ": " + error.what());
  }
}

void ReportMesh(const GeometryTruth& truth,
                const Camera& camera,
                const TriangleMesh& mesh_in_world,
                Json* report) {
  Points samples;
  std::shared_ptr<MeshIndex> index;
  try {
    index = std::make_shared<MeshIndex>(mesh_in_world);
    for (const SurfaceSample& sample : SampleSurface(mesh_in_world, truth.num_samples, kSeed)) {
      samples.push_back(sample.point);
    }
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string("the mesh to be compared: ") + error.what());
  }
  const Completeness completeness(truth, camera, [index](const Eigen::Vector3d& point) {
    return index->NearestTo(point).distance;
  });
  (*report)["mesh"] =
      CompareWithTruth(truth, camera, ReadSurface(truth.surface), completeness, samples);
}

}  // namespace plumb::tools
