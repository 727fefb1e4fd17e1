// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <set>
#include <unordered_map>
#include <vector>

#include "surface/ray_cast.h"
#include "surface/ray_scene.h"
#include "surface/tetrahedra.h"
#include "test/surface/fresh_cut.h"

namespace plumb::test {

struct FullRayCastOptions {
  // A ray's weight, for each face it crosses, at its camera, and behind its point; and that of the
  // surface quality. The values of Labatut et al. 2009.
  int alpha_vis = 32;
  double lambda_quality = 5.0;
};

// The energy that the paper compares itself with: every ray is followed through all cells to its
// camera (Labatut, Pons and Keriven, ICCV 2007; the quality of faces as in Computer Graphics
// Forum 28(8), 2009, eq. 5). A baseline for measurements, on the same cells and rays.
class FullRayCast {
 public:
  FullRayCast(const FullRayCastOptions& options, const Triangulation& triangulation)
      : options_(options), triangulation_(triangulation) {
    for (const Cell cell : triangulation.finite_cell_handles()) {
      index_of_[&*cell] = static_cast<int>(cells_.size());
      cells_.push_back(cell);
    }
    terminal_.resize(cells_.size(), 0);
    crossings_.resize(4 * cells_.size(), 0);
  }

  void Cast(const RayScene& scene) {
    std::vector<SceneRay> rays;
    for (const Vertex vertex : triangulation_.finite_vertex_handles()) {
      Cell hint = vertex->cell();
      std::vector<Cell> star;
      if (triangulation_.is_infinite(hint)) {
        triangulation_.incident_cells(vertex, std::back_inserter(star));
        for (const Cell cell : star) {
          if (!triangulation_.is_infinite(cell)) hint = cell;
        }
      }
      scene.RaysOf(vertex->info().slot, &rays);
      for (const SceneRay& ray : rays) CastOne(vertex, ToCgal(ray.camera), hint);
    }
  }

  // Builds the graph, so that Solve can be timed alone.
  void Prepare() {
    graph_ = std::make_unique<maxflow::Graph<int, int, int>>(static_cast<int>(cells_.size()),
                                                             static_cast<int>(2 * cells_.size()));
    graph_->add_node(static_cast<int>(cells_.size()));
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const Cell cell = cells_[c];
      int source = std::max(terminal_[c], 0);
      const int sink = std::max(-terminal_[c], 0);
      for (int i = 0; i < 4; ++i) {
        const Cell neighbor = cell->neighbor(i);
        const int quality = QualityOf(cell, i);
        if (triangulation_.is_infinite(neighbor)) {
          // From the infinite cell, which is at the source, into this one.
          source += crossings_[4 * c + static_cast<std::size_t>(i)] + quality;
          continue;
        }
        const int other = IndexOf(neighbor);
        if (other < static_cast<int>(c)) continue;
        const int mirror = neighbor->index(cell);
        graph_->add_edge(
            static_cast<int>(c),
            other,
            crossings_[4 * static_cast<std::size_t>(other) + static_cast<std::size_t>(mirror)] +
                quality,
            crossings_[4 * c + static_cast<std::size_t>(i)] + quality);
      }
      graph_->add_tweights(static_cast<int>(c), source, sink);
    }
  }
  void Solve() { graph_->maxflow(); }

  bool IsFree(Cell cell) const {
    if (triangulation_.is_infinite(cell)) return true;
    return graph_->what_segment(IndexOf(cell), maxflow::Graph<int, int, int>::SINK) ==
           maxflow::Graph<int, int, int>::SOURCE;
  }

 private:
  int IndexOf(Cell cell) const { return index_of_.at(&*cell); }

  void CastOne(Vertex vertex, const SurfaceKernel::Point_3& camera, Cell hint) {
    const Cell behind = FindRayCell(triangulation_, vertex, camera, RaySide::kAwayFromCamera, hint);
    if (behind != Cell()) terminal_[IndexOfUnsigned(behind)] -= options_.alpha_vis;
    Cell cell = FindRayCell(triangulation_, vertex, camera, RaySide::kTowardsCamera, hint);
    if (cell == Cell()) return;
    int exit = cell->index(vertex);
    // From cell to cell: the ray leaves by the face opposite to the vertex, then by whichever
    // face of the next cell it meets. One that meets an edge is not followed further.
    while (CGAL::orientation(PointOf(cell, (exit + 1) & 3),
                             PointOf(cell, (exit + 2) & 3),
                             PointOf(cell, (exit + 3) & 3),
                             camera) == OutsideOf(exit)) {
      crossings_[4 * IndexOfUnsigned(cell) + static_cast<std::size_t>(exit)] += options_.alpha_vis;
      const Cell next = cell->neighbor(exit);
      if (triangulation_.is_infinite(next)) return;
      const int entry = next->index(cell);
      cell = next;
      exit = ExitOf(cell, entry, vertex->point(), camera);
      if (exit < 0) return;
    }
    terminal_[IndexOfUnsigned(cell)] += options_.alpha_vis;
  }

  static const SurfaceKernel::Point_3& PointOf(Cell cell, int i) {
    return cell->vertex(i)->point();
  }
  std::size_t IndexOfUnsigned(Cell cell) const { return static_cast<std::size_t>(IndexOf(cell)); }

  // Orientation of the corners after `i`, in their order, with a point beyond face i.
  static CGAL::Orientation OutsideOf(int i) {
    return (i & 1) != 0 ? CGAL::NEGATIVE : CGAL::POSITIVE;
  }

  // The face by which the line from `from` to `to` leaves, having come in by `entry`: seen along
  // the line, the corner opposite to the entry splits the entry's triangle into three.
  static int ExitOf(Cell cell,
                    int entry,
                    const SurfaceKernel::Point_3& from,
                    const SurfaceKernel::Point_3& to) {
    for (int exit = 0; exit < 4; ++exit) {
      if (exit == entry) continue;
      // The line passes through the face if it keeps to the same side of its three edges.
      int positive = 0;
      int negative = 0;
      for (int a = 0; a < 4; ++a) {
        if (a == exit) continue;
        const int b = NextOf(a, exit);
        const CGAL::Orientation side =
            CGAL::orientation(from, to, PointOf(cell, a), PointOf(cell, b));
        positive += side == CGAL::POSITIVE ? 1 : 0;
        negative += side == CGAL::NEGATIVE ? 1 : 0;
      }
      if (positive == 3 || negative == 3) return exit;
    }
    return -1;
  }

  // The corner after `a` of those that are not `left_out`, cyclically.
  static int NextOf(int a, int left_out) {
    const int next = (a + 1) & 3;
    return next == left_out ? (next + 1) & 3 : next;
  }

  // lambda (1 - min(cos phi, cos psi)), phi and psi being the angles between the face and the
  // circumspheres of the cells on both sides.
  int QualityOf(Cell cell, int i) const {
    const double worst = std::min(CosineOf(cell, i), CosineOf(cell->neighbor(i), -1, cell));
    return static_cast<int>(
        std::lround(options_.alpha_vis * options_.lambda_quality / 32.0 * (1.0 - worst)));
  }
  double CosineOf(Cell cell, int i, Cell from = Cell()) const {
    if (triangulation_.is_infinite(cell)) return 1.0;
    if (i < 0) i = cell->index(from);
    const SurfaceKernel::Point_3& a = PointOf(cell, (i + 1) & 3);
    const SurfaceKernel::Point_3& b = PointOf(cell, (i + 2) & 3);
    const SurfaceKernel::Point_3& c = PointOf(cell, (i + 3) & 3);
    const SurfaceKernel::Point_3& d = PointOf(cell, i);
    const SurfaceKernel::Vector_3 normal = CGAL::cross_product(b - a, c - a);
    const SurfaceKernel::Point_3 center = CGAL::circumcenter(a, b, c, d);
    const double radius = std::sqrt(CGAL::squared_distance(center, a));
    const double height = (center - a) * normal / std::sqrt(normal.squared_length());
    const double towards = (d - a) * normal > 0 ? height : -height;
    const double cosine = radius > 0 ? towards / radius : 0.0;
    return std::isfinite(cosine) ? std::clamp(cosine, -1.0, 1.0) : 0.0;
  }

  FullRayCastOptions options_;
  const Triangulation& triangulation_;
  std::unordered_map<const void*, int> index_of_;
  std::vector<Cell> cells_;
  std::vector<int> terminal_;
  std::vector<int>
      crossings_;  // By cell and face: weight of rays out of the cell to their cameras.
  std::unique_ptr<maxflow::Graph<int, int, int>> graph_;
};

}  // namespace plumb::test
