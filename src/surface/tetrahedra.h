// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "plumbline/common/ids.h"
#include "surface/dynamic_cut.h"
#include "surface/ray_scene.h"

namespace plumb {

struct VertexInfo {
  Slot slot = kNoSlot;
  LandmarkId id;
};

// What the rays of each of a cell's own vertices say of it.
struct CellInfo {
  CutNode node = kNoCutNode;
  std::array<std::int8_t, 4> sphere_cosines = {0, 0, 0, 0};  // Of each face; SphereCosines.
  std::array<std::uint16_t, 4> num_passing = {0, 0, 0, 0};   // Rays that leave the vertex in here.
  std::array<std::uint16_t, 4> num_crossing = {0, 0, 0, 0};  // Those on through the opposite face.
  std::array<std::uint16_t, 4> num_behind = {0, 0, 0, 0};    // Rays whose extension lies in here.
};

using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Delaunay_triangulation_3<
    SurfaceKernel,
    CGAL::Triangulation_data_structure_3<
        CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, SurfaceKernel>,
        CGAL::Triangulation_cell_base_with_info_3<
            CellInfo,
            SurfaceKernel,
            CGAL::Delaunay_triangulation_cell_base_3<SurfaceKernel>>>>;
using Cell = Triangulation::Cell_handle;
using Vertex = Triangulation::Vertex_handle;

inline SurfaceKernel::Point_3 ToCgal(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

// Delaunay tetrahedra between the places of landmarks. Predicates are exact and cospherical
// points perturbed by their coordinates (Devillers and Teillaud, SODA 2003): the same points give
// the same tetrahedra in whatever order they came. Every finite cell gets a node of the cut, whose
// slots are the cell's four faces. With fewer than four points, or all in one plane, there is no
// cell.
class Tetrahedra {
 public:
  explicit Tetrahedra(DynamicCut* cut) : cut_(cut) {}

  struct Place {
    Slot slot = kNoSlot;
    LandmarkId id;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
  };

  // From slots to places; a place where another vertex stands is left out.
  void Insert(std::vector<Place> places);
  void Remove(const std::vector<Slot>& slots);

  // The vertex of a slot; null if it has none.
  Vertex VertexOf(Slot slot) const { return slot < vertices_.size() ? vertices_[slot] : Vertex(); }
  // The cell of a node; null if it has none.
  Cell CellOf(CutNode node) const { return node < cells_.size() ? cells_[node] : Cell(); }

  bool HasCells() const { return triangulation_.dimension() == 3; }
  const Triangulation& triangulation() const { return triangulation_; }

  // After changes: gives nodes to those of the finite cells that have none. Each new cell is around
  // a touched vertex, and is to be named. Most cells that come while vertices come and go are gone
  // again by then.
  void AddNodes(const std::vector<Cell>& cells);
  // Then: the angles of the cells that got nodes.
  void MeasureSpheres(int num_threads);

  // What changed since the last ClearChanges; a touched slot or a bereft node may be gone again.
  const std::vector<Slot>& touched() const { return touched_; }  // Other incident cells.
  const std::vector<CutNode>& created() const { return created_; }
  const std::vector<CutNode>& destroyed() const { return destroyed_; }
  const std::vector<CutNode>& bereft() const { return bereft_; }  // Lost a neighbour.
  void ClearChanges();

 private:
  void InsertOne(const Place& place);
  void RemoveOne(Slot slot);
  void InsertFlat(const Place& place);
  void Destroy(Cell cell);
  void Touch(Vertex vertex);

  DynamicCut* cut_;
  Triangulation triangulation_;
  Cell hint_;
  std::vector<Vertex> vertices_;  // By slot.
  std::vector<Cell> cells_;       // By node.
  std::vector<char> is_touched_;  // By slot.
  std::vector<Slot> touched_;
  std::vector<CutNode> created_;
  std::vector<CutNode> destroyed_;
  std::vector<CutNode> bereft_;
};

}  // namespace plumb
