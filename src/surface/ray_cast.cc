// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/ray_cast.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace plumb {
namespace {

using Point = SurfaceKernel::Point_3;

// Rays of a landmark come from much the same side: a search seldom takes more than ten steps.
constexpr int kMaxSteps = 100;

// On which side of the face opposite to corner `i` the point lies; positive: that of the corner.
CGAL::Orientation SideOf(Cell cell, int i, const Point& point) {
  std::array<const Point*, 4> corners = {&cell->vertex(0)->point(),
                                         &cell->vertex(1)->point(),
                                         &cell->vertex(2)->point(),
                                         &cell->vertex(3)->point()};
  corners[static_cast<std::size_t>(i)] = &point;
  return CGAL::orientation(*corners[0], *corners[1], *corners[2], *corners[3]);
}

// The same for a ray from or into a vertex of the face: what lies behind is mirrored in the vertex.
CGAL::Orientation SideOfRay(Cell cell, int i, const Point& camera, RaySide side) {
  const CGAL::Orientation orientation = SideOf(cell, i, camera);
  return side == RaySide::kTowardsCamera ? orientation : CGAL::opposite(orientation);
}

// Cells by their addresses, with open addressing: a vertex has some 25, seldom more than fit.
class CellSet {
 public:
  // Whether it is new.
  bool Insert(Cell cell) {
    if (2 * (size_ + 1) > table_.size()) Grow();
    const bool is_new = Put(cell);
    size_ += is_new ? 1 : 0;
    return is_new;
  }

 private:
  bool Put(Cell cell) {
    const auto address = reinterpret_cast<std::uintptr_t>(&*cell);
    const std::size_t mask = table_.size() - 1;
    // Fibonacci hashing (Knuth, volume 3, 6.4).
    std::size_t place = (address * 0x9E3779B97F4A7C15ULL) >> 32U & mask;
    while (table_[place] != Cell()) {
      if (table_[place] == cell) return false;
      place = (place + 1) & mask;
    }
    table_[place] = cell;
    return true;
  }

  void Grow() {
    std::vector<Cell> before(2 * table_.size());
    before.swap(table_);
    for (const Cell cell : before) {
      if (cell != Cell()) Put(cell);
    }
  }

  std::vector<Cell> table_ = std::vector<Cell>(128);
  std::size_t size_ = 0;
};

// CGAL marks the cells that it has visited; this does not, and may run beside others.
void FindStar(Vertex vertex, std::vector<Cell>* star) {
  CellSet known;
  star->assign(1, vertex->cell());
  known.Insert(vertex->cell());
  for (std::size_t next = 0; next < star->size(); ++next) {
    const Cell cell = (*star)[next];
    for (int i = 0; i < 4; ++i) {
      if (cell->vertex(i) == vertex) continue;
      const Cell neighbor = cell->neighbor(i);
      if (known.Insert(neighbor)) star->push_back(neighbor);
    }
  }
}

std::array<LandmarkId, 4> SortedIds(Cell cell) {
  std::array<LandmarkId, 4> ids = {cell->vertex(0)->info().id,
                                   cell->vertex(1)->info().id,
                                   cell->vertex(2)->info().id,
                                   cell->vertex(3)->info().id};
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::uint16_t* CountFor(std::array<std::uint16_t, 4>* counts, int i) {
  return &(*counts)[static_cast<std::size_t>(i)];
}

RayCounts CountsOf(Cell cell, Vertex vertex) {
  const auto corner = static_cast<std::size_t>(cell->index(vertex));
  const CellInfo& info = cell->info();
  return {info.num_passing[corner], info.num_crossing[corner], info.num_behind[corner]};
}

void ClearCounts(Cell cell, Vertex vertex) {
  const int corner = cell->index(vertex);
  CellInfo& info = cell->info();
  *CountFor(&info.num_passing, corner) = 0;
  *CountFor(&info.num_crossing, corner) = 0;
  *CountFor(&info.num_behind, corner) = 0;
}

void Increase(std::uint16_t* count) {
  if (*count < std::numeric_limits<std::uint16_t>::max()) ++*count;
}

}  // namespace

Cell FindRayCellInStar(const Triangulation& triangulation,
                       Vertex vertex,
                       const Point& camera,
                       RaySide side,
                       const std::vector<Cell>& star) {
  Cell best;
  std::array<LandmarkId, 4> best_ids;
  for (const Cell cell : star) {
    if (triangulation.is_infinite(cell)) continue;
    const int index = cell->index(vertex);
    bool is_inside = true;
    for (int i = 0; i < 4 && is_inside; ++i) {
      is_inside = i == index || SideOfRay(cell, i, camera, side) != CGAL::NEGATIVE;
    }
    if (!is_inside) continue;
    const std::array<LandmarkId, 4> ids = SortedIds(cell);
    if (best != Cell() && !(ids < best_ids)) continue;
    best = cell;
    best_ids = ids;
  }
  return best;
}

Cell FindRayCell(const Triangulation& triangulation,
                 Vertex vertex,
                 const Point& camera,
                 RaySide side,
                 Cell hint) {
  Cell cell = hint;
  Cell previous;
  for (int step = 0; step < kMaxSteps; ++step) {
    const int index = cell->index(vertex);
    Cell next;
    bool is_on_face = false;
    for (int i = 0; i < 4 && next == Cell(); ++i) {
      if (i == index || cell->neighbor(i) == previous) continue;
      const CGAL::Orientation orientation = SideOfRay(cell, i, camera, side);
      if (orientation == CGAL::NEGATIVE) next = cell->neighbor(i);
      is_on_face = is_on_face || orientation == CGAL::ZERO;
    }
    if (next == Cell()) {
      if (!is_on_face) return cell;
      break;
    }
    // The hull is convex: beyond one of its faces, nothing is inside.
    if (triangulation.is_infinite(next)) return Cell();
    previous = cell;
    cell = next;
  }
  std::vector<Cell> star;
  FindStar(vertex, &star);
  return FindRayCellInStar(triangulation, vertex, camera, side, star);
}

bool RayStar::IsChanged(std::size_t cell, Vertex vertex) const {
  const RayCounts now = CountsOf(cells[cell], vertex);
  const RayCounts& before = counts_before[cell];
  return now.num_passing != before.num_passing || now.num_crossing != before.num_crossing ||
         now.num_behind != before.num_behind;
}

void CastRays(const Triangulation& triangulation,
              Vertex vertex,
              const std::vector<SceneRay>& rays,
              RayStar* star) {
  FindStar(vertex, &star->cells);
  star->cells.erase(std::remove_if(star->cells.begin(),
                                   star->cells.end(),
                                   [&](Cell cell) { return triangulation.is_infinite(cell); }),
                    star->cells.end());
  star->counts_before.clear();
  for (const Cell cell : star->cells) {
    star->counts_before.push_back(CountsOf(cell, vertex));
    ClearCounts(cell, vertex);
  }
  if (star->cells.empty()) return;
  Cell front = star->cells.front();
  Cell back = front;
  for (const SceneRay& ray : rays) {
    const Point camera = ToCgal(ray.camera);
    const Cell passed = FindRayCell(triangulation, vertex, camera, RaySide::kTowardsCamera, front);
    if (passed != Cell()) {
      front = passed;
      const int i = passed->index(vertex);
      Increase(CountFor(&passed->info().num_passing, i));
      // Unless the camera hovers within the cell.
      if (SideOf(passed, i, camera) == CGAL::NEGATIVE) {
        Increase(CountFor(&passed->info().num_crossing, i));
      }
    }
    const Cell behind = FindRayCell(triangulation, vertex, camera, RaySide::kAwayFromCamera, back);
    if (behind == Cell()) continue;
    back = behind;
    Increase(CountFor(&behind->info().num_behind, behind->index(vertex)));
  }
}

}  // namespace plumb
