// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/tetrahedra.h"

#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "image/parallel_for.h"
#include "surface/sphere_angles.h"

namespace plumb {
namespace {

constexpr int kSpheresOfPart = 512;

Eigen::Vector3d ToEigen(const SurfaceKernel::Point_3& point) {
  return {point.x(), point.y(), point.z()};
}

// Corners are taken by their ids: a cell has the same numbers whatever its history.
std::array<std::int8_t, 4> SphereCosinesOf(Cell cell) {
  std::array<int, 4> order = {0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return cell->vertex(a)->info().id < cell->vertex(b)->info().id;
  });
  std::array<Eigen::Vector3d, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = ToEigen(cell->vertex(order[k])->point());
  const std::array<std::int8_t, 4> by_id = SphereCosines(corners);
  std::array<std::int8_t, 4> by_corner;
  for (std::size_t k = 0; k < 4; ++k) by_corner[static_cast<std::size_t>(order[k])] = by_id[k];
  return by_corner;
}

}  // namespace

void Tetrahedra::Insert(std::vector<Place> places) {
  // Neighbours follow each other, so that each is found from the one before in a few steps.
  std::vector<SurfaceKernel::Point_3> points;
  points.reserve(places.size());
  for (const Place& place : places) points.push_back(ToCgal(place.point));
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  using Points = CGAL::Pointer_property_map<SurfaceKernel::Point_3>::type;
  CGAL::spatial_sort(
      order.begin(),
      order.end(),
      CGAL::Spatial_sort_traits_adapter_3<SurfaceKernel, Points>(CGAL::make_property_map(points)));
  for (const std::size_t i : order) InsertOne(places[i]);
}

void Tetrahedra::Remove(const std::vector<Slot>& slots) {
  for (const Slot slot : slots) {
    if (VertexOf(slot) != Vertex()) RemoveOne(slot);
  }
}

void Tetrahedra::ClearChanges() {
  for (const Slot slot : touched_) is_touched_[slot] = 0;
  touched_.clear();
  created_.clear();
  destroyed_.clear();
  bereft_.clear();
}

void Tetrahedra::InsertOne(const Place& place) {
  if (vertices_.size() <= place.slot) {
    vertices_.resize(place.slot + 1);
    is_touched_.resize(place.slot + 1, 0);
  }
  if (!HasCells()) {
    InsertFlat(place);
    return;
  }
  const SurfaceKernel::Point_3 point = ToCgal(place.point);
  Triangulation::Locate_type type = Triangulation::CELL;
  int i = 0;
  int j = 0;
  const Cell start = triangulation_.locate(point, type, i, j, hint_);
  if (type == Triangulation::VERTEX) return;

  std::vector<Cell> conflicts;
  Triangulation::Facet face;
  triangulation_.find_conflicts(point,
                                start,
                                CGAL::Oneset_iterator<Triangulation::Facet>(face),
                                std::back_inserter(conflicts));
  for (const Cell cell : conflicts) {
    for (int k = 0; k < 4; ++k) Touch(cell->vertex(k));
    Destroy(cell);
  }
  const Vertex vertex = triangulation_.insert_in_hole(
      point, conflicts.begin(), conflicts.end(), face.first, face.second);
  vertex->info() = {place.slot, place.id};
  vertices_[place.slot] = vertex;
  Touch(vertex);
  hint_ = vertex->cell();
}

// The first points, or points in one plane; cells are there only once a point lies off it.
void Tetrahedra::InsertFlat(const Place& place) {
  const std::size_t num_before = triangulation_.number_of_vertices();
  const Vertex vertex = triangulation_.insert(ToCgal(place.point));
  if (triangulation_.number_of_vertices() == num_before) return;
  vertex->info() = {place.slot, place.id};
  vertices_[place.slot] = vertex;
  hint_ = vertex->cell();
  if (!HasCells()) return;
  for (const Vertex touched : triangulation_.finite_vertex_handles()) Touch(touched);
}

void Tetrahedra::RemoveOne(Slot slot) {
  const Vertex vertex = vertices_[slot];
  vertices_[slot] = Vertex();
  hint_ = Cell();
  if (!HasCells()) {
    triangulation_.remove(vertex);
    return;
  }
  std::vector<Cell> incident;
  triangulation_.incident_cells(vertex, std::back_inserter(incident));
  for (const Cell cell : incident) {
    for (int k = 0; k < 4; ++k) Touch(cell->vertex(k));
    Destroy(cell);
  }
  triangulation_.remove(vertex);
}

void Tetrahedra::Destroy(Cell cell) {
  const CutNode node = cell->info().node;
  if (node == kNoCutNode) return;
  for (std::uint32_t k = 0; k < DynamicCut::kDegree; ++k) {
    const CutNode neighbor = cut_->NeighborOf(node, k);
    if (neighbor != kNoCutNode) bereft_.push_back(neighbor);
  }
  cut_->RemoveNode(node);
  cells_[node] = Cell();
  destroyed_.push_back(node);
  cell->info().node = kNoCutNode;
}

void Tetrahedra::AddNodes(const std::vector<Cell>& cells) {
  for (const Cell cell : cells) {
    if (cell->info().node != kNoCutNode) continue;
    const CutNode node = cut_->AddNode();
    if (cells_.size() <= node) cells_.resize(node + 1);
    cells_[node] = cell;
    cell->info().node = node;
    created_.push_back(node);
  }
}

void Tetrahedra::MeasureSpheres(int num_threads) {
  ParallelFor(
      num_threads, static_cast<int>(created_.size()), kSpheresOfPart, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
          const Cell cell = CellOf(created_[static_cast<std::size_t>(i)]);
          cell->info().sphere_cosines = SphereCosinesOf(cell);
        }
      });
}

void Tetrahedra::Touch(Vertex vertex) {
  if (triangulation_.is_infinite(vertex)) return;
  const Slot slot = vertex->info().slot;
  if (is_touched_[slot] != 0) return;
  is_touched_[slot] = 1;
  touched_.push_back(slot);
}

}  // namespace plumb
