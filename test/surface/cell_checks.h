// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <vector>

#include "surface/cell_weights.h"
#include "surface/labelled_cells.h"
#include "surface/ray_cast.h"
#include "test/surface/fresh_cut.h"

namespace plumb::test {

// The counts in a cell by what all rays of the scene say, each looked up in the whole star.
inline std::map<CutNode, CellInfo> CountAnew(const LabelledCells& cells) {
  const Triangulation& triangulation = cells.tetrahedra().triangulation();
  std::map<CutNode, CellInfo> infos;
  for (const Cell cell : triangulation.finite_cell_handles()) infos[cell->info().node];
  std::vector<SceneRay> rays;
  for (const Vertex vertex : triangulation.finite_vertex_handles()) {
    std::vector<Cell> star;
    triangulation.incident_cells(vertex, std::back_inserter(star));
    cells.scene().RaysOf(vertex->info().slot, &rays);
    for (const SceneRay& ray : rays) {
      const SurfaceKernel::Point_3 camera = ToCgal(ray.camera);
      const auto find = [&](RaySide side) {
        return FindRayCellInStar(triangulation, vertex, camera, side, star);
      };
      if (const Cell front = find(RaySide::kTowardsCamera); front != Cell()) {
        const auto i = static_cast<std::size_t>(front->index(vertex));
        CellInfo& info = infos.at(front->info().node);
        ++info.num_passing[i];
        std::array<SurfaceKernel::Point_3, 4> corners = {front->vertex(0)->point(),
                                                         front->vertex(1)->point(),
                                                         front->vertex(2)->point(),
                                                         front->vertex(3)->point()};
        corners[i] = camera;
        if (CGAL::orientation(corners[0], corners[1], corners[2], corners[3]) == CGAL::NEGATIVE) {
          ++info.num_crossing[i];
        }
      }
      if (const Cell back = find(RaySide::kAwayFromCamera); back != Cell()) {
        ++infos.at(back->info().node).num_behind[static_cast<std::size_t>(back->index(vertex))];
      }
    }
  }
  return infos;
}

inline void ExpectCountsAreThoseFromScratch(const LabelledCells& cells) {
  if (!cells.tetrahedra().HasCells()) return;
  const std::map<CutNode, CellInfo> expected = CountAnew(cells);
  for (const Cell cell : cells.tetrahedra().triangulation().finite_cell_handles()) {
    const CellInfo& info = cell->info();
    ASSERT_NE(info.node, kNoCutNode);
    ASSERT_EQ(cells.tetrahedra().CellOf(info.node), cell);
    ASSERT_EQ(info.num_passing, expected.at(info.node).num_passing);
    ASSERT_EQ(info.num_crossing, expected.at(info.node).num_crossing);
    ASSERT_EQ(info.num_behind, expected.at(info.node).num_behind);
  }
}

// The energy of the labels is the least one, and the labels are those of a solve from nothing.
inline void ExpectLabelsAreThoseOfAFreshSolve(const LabelledCells& cells) {
  if (!cells.tetrahedra().HasCells()) return;
  const Triangulation& triangulation = cells.tetrahedra().triangulation();
  const SurfaceOptions& options = cells.options();
  std::map<CutNode, int> index_of;
  for (const Cell cell : triangulation.finite_cell_handles()) {
    const int index = static_cast<int>(index_of.size());
    index_of[cell->info().node] = index;
  }
  FreshCut fresh(index_of.size());
  std::int64_t constant = 0;  // Energy of all cells being occupied, less what the terminals hold.
  for (const Cell cell : triangulation.finite_cell_handles()) {
    const int index = index_of.at(cell->info().node);
    const std::int32_t terminal = TerminalOf(options, triangulation, cell);
    fresh.SetTerminal(index, terminal);
    std::int64_t free_cost = 0;
    for (const std::uint16_t count : cell->info().num_behind)
      free_cost += options.alpha_occ * count;
    constant += terminal < 0 ? free_cost + terminal : free_cost;
    for (int i = 0; i < 4; ++i) {
      const auto other = index_of.find(cell->neighbor(i)->info().node);
      if (other == index_of.end() || other->second < index) continue;
      fresh.AddEdge(index, other->second, FaceWeightOf(options, cell, i));
    }
  }
  fresh.Solve();
  ASSERT_EQ(cells.Energy(), fresh.flow() + constant);
  for (const auto& [node, index] : index_of) {
    ASSERT_EQ(cells.cut().IsAtSource(node), fresh.IsAtSource(index));
  }
}

// Free cells by the ids of their landmarks, which name a cell whatever its history.
using LabelOfCell = std::map<std::array<LandmarkId, 4>, bool>;

inline LabelOfCell LabelsById(const LabelledCells& cells) {
  LabelOfCell labels;
  if (!cells.tetrahedra().HasCells()) return labels;
  for (const Cell cell : cells.tetrahedra().triangulation().finite_cell_handles()) {
    std::array<LandmarkId, 4> ids;
    for (int i = 0; i < 4; ++i) ids[static_cast<std::size_t>(i)] = cell->vertex(i)->info().id;
    std::sort(ids.begin(), ids.end());
    labels[ids] = IsFree(cells.cut(), cell);
  }
  return labels;
}

}  // namespace plumb::test
