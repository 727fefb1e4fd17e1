// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/tetrahedra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "surface/outward_face.h"
#include "surface/ray_cast.h"
#include "test/support/random.h"

namespace plumb {
namespace {

using CellIds = std::set<std::array<LandmarkId, 4>>;

CellIds IdsOf(const Tetrahedra& tetrahedra) {
  CellIds ids;
  for (const Cell cell : tetrahedra.triangulation().finite_cell_handles()) {
    std::array<LandmarkId, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = cell->vertex(static_cast<int>(i))->info().id;
    std::sort(corners.begin(), corners.end());
    ids.insert(corners);
  }
  return ids;
}

// A lattice: every cube's eight corners are on one sphere, and its faces are flat.
std::vector<Tetrahedra::Place> LatticePoints(int side) {
  std::vector<Tetrahedra::Place> places;
  for (int i = 0; i < side * side * side; ++i) {
    const Slot slot = static_cast<Slot>(i);
    places.push_back(
        {slot, LandmarkId{slot}, Eigen::Vector3d(i % side, i / side % side, i / side / side)});
  }
  return places;
}

void Shuffle(test::Random* random, std::vector<Tetrahedra::Place>* places) {
  for (std::size_t i = places->size(); i > 1; --i) {
    std::swap((*places)[i - 1],
              (*places)[static_cast<std::size_t>(random->Index(static_cast<int>(i)))]);
  }
}

void InsertOneByOne(const std::vector<Tetrahedra::Place>& places, Tetrahedra* tetrahedra) {
  for (const Tetrahedra::Place& place : places) tetrahedra->Insert({place});
}

// To the new cells, which are all around touched vertices.
void AddNodes(Tetrahedra* tetrahedra) {
  std::vector<Cell> cells;
  for (const Slot slot : tetrahedra->touched()) {
    const Vertex vertex = tetrahedra->VertexOf(slot);
    if (vertex == Vertex()) continue;
    tetrahedra->triangulation().finite_incident_cells(vertex, std::back_inserter(cells));
  }
  tetrahedra->AddNodes(cells);
  tetrahedra->ClearChanges();
}

TEST(Tetrahedra, AreTheSameInWhateverOrderCosphericalPointsCome) {
  test::Random random(1);
  std::vector<Tetrahedra::Place> places = LatticePoints(4);
  DynamicCut cut;
  Tetrahedra expected(&cut);
  InsertOneByOne(places, &expected);
  ASSERT_GT(IdsOf(expected).size(), 100U);
  for (int round = 0; round < 20; ++round) {
    DynamicCut other_cut;
    Tetrahedra other(&other_cut);
    Shuffle(&random, &places);
    InsertOneByOne(places, &other);
    ASSERT_EQ(IdsOf(other), IdsOf(expected));
  }
}

TEST(Tetrahedra, AreTheSameAfterPointsCameAndWent) {
  test::Random random(2);
  std::vector<Tetrahedra::Place> places = LatticePoints(4);
  DynamicCut cut;
  Tetrahedra expected(&cut);
  InsertOneByOne(places, &expected);
  DynamicCut other_cut;
  Tetrahedra other(&other_cut);
  other.Insert(places);
  AddNodes(&other);
  for (int round = 0; round < 40; ++round) {
    Shuffle(&random, &places);
    const std::vector<Tetrahedra::Place> some(places.begin(), places.begin() + 12);
    std::vector<Slot> slots;
    for (const Tetrahedra::Place& place : some) slots.push_back(place.slot);
    other.Remove(slots);
    other.Insert({{900, LandmarkId{900}, random.InBox(3.0)}});
    InsertOneByOne(some, &other);
    other.Remove({900});
    ASSERT_EQ(IdsOf(other), IdsOf(expected)) << "round " << round;
    AddNodes(&other);
    ASSERT_EQ(other_cut.num_nodes(), IdsOf(other).size());
  }
}

TEST(Tetrahedra, LeaveOutASecondPointAtOnePlace) {
  DynamicCut cut;
  Tetrahedra tetrahedra(&cut);
  InsertOneByOne(LatticePoints(2), &tetrahedra);
  const CellIds before = IdsOf(tetrahedra);
  tetrahedra.Insert({{50, LandmarkId{50}, Eigen::Vector3d(1, 1, 1)}});
  EXPECT_EQ(tetrahedra.VertexOf(50), Vertex());
  EXPECT_EQ(IdsOf(tetrahedra), before);
  tetrahedra.Remove({50});
  EXPECT_EQ(IdsOf(tetrahedra), before);
}

TEST(Tetrahedra, TellTheOutsideOfTheirFaces) {
  DynamicCut cut;
  Tetrahedra tetrahedra(&cut);
  std::vector<Tetrahedra::Place> places = LatticePoints(3);
  InsertOneByOne(places, &tetrahedra);
  for (const Cell cell : tetrahedra.triangulation().finite_cell_handles()) {
    for (int i = 0; i < 4; ++i) {
      const FaceSlots face = OutwardFace(cell, i);
      const Eigen::Vector3d a = places[face[0]].point;
      const Eigen::Vector3d normal = (places[face[1]].point - a).cross(places[face[2]].point - a);
      EXPECT_LT(normal.dot(places[cell->vertex(i)->info().slot].point - a), 0.0);
      EXPECT_LT(face[0], std::min(face[1], face[2]));
    }
  }
}

// Wherever the search starts, and if the ray runs along faces and edges, as on a lattice.
TEST(FindRayCell, AgreesWithTheWholeStar) {
  test::Random random(3);
  DynamicCut cut;
  Tetrahedra tetrahedra(&cut);
  tetrahedra.Insert(LatticePoints(3));
  const Triangulation& triangulation = tetrahedra.triangulation();
  std::size_t num_found = 0;
  for (int round = 0; round < 2000; ++round) {
    const Vertex vertex = tetrahedra.VertexOf(static_cast<Slot>(random.Index(27)));
    const bool is_on_lattice = random.Index(2) == 0;
    const Eigen::Vector3d far = 6.0 * random.InBox(1.0);
    const Eigen::Vector3d camera = is_on_lattice ? Eigen::Vector3d(far.array().round()) : far;
    const RaySide side = random.Index(2) == 0 ? RaySide::kTowardsCamera : RaySide::kAwayFromCamera;
    std::vector<Cell> star;
    triangulation.incident_cells(vertex, std::back_inserter(star));
    const Cell expected = FindRayCellInStar(triangulation, vertex, ToCgal(camera), side, star);
    num_found += expected != Cell() ? 1U : 0U;
    for (const Cell hint : star) {
      if (triangulation.is_infinite(hint)) continue;
      ASSERT_EQ(FindRayCell(triangulation, vertex, ToCgal(camera), side, hint), expected);
    }
  }
  EXPECT_GT(num_found, 400U);
}

}  // namespace
}  // namespace plumb
