// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulation/facade_plan.h"
#include "simulation/mesh_builder.h"

namespace plumb {

// What all elements are built with.
struct Site {
  MeshBuilder& builder;
  const Palette& palette;
  const FacadePlan& plan;
};

// Elements of a wall; the builder's frame is the wall's.
void BuildWallSurface(const Site& site, const WallPlan& wall);
void BuildPlinth(const Site& site, const WallPlan& wall);
void BuildRustication(const Site& site, const BayPlan& bay);
void BuildQuoins(const Site& site, const WallPlan& wall);
void BuildDownpipes(const Site& site, const WallPlan& wall);
void BuildBay(const Site& site, const BayPlan& bay);

// Elements of a bay; the builder's frame stands in the middle of the opening's foot, with the
// wall's axes.
void BuildReveal(const Site& site, const BayPlan& bay);
void BuildWindow(const Site& site, const BayPlan& bay);
void BuildWindowDress(const Site& site, const BayPlan& bay);  // Surround, sill, hood, apron.
void BuildShutters(const Site& site, const BayPlan& bay);
void BuildBalcony(const Site& site, const BayPlan& bay);
void BuildDoor(const Site& site, const BayPlan& bay);
void BuildFittings(const Site& site, const BayPlan& bay);  // Grilles, lamps, vents, boxes.

// Elements that go round the building; the builder's frame is the world's.
void BuildStringCourses(const Site& site);
void BuildEntablature(const Site& site);
void BuildRoof(const Site& site);
void BuildDormers(const Site& site, const WallPlan& wall);  // In the wall's frame.
void BuildGround(const Site& site);

// The roof's slope, as rise over run, with its tiles' edges.
double RoofSlope();

// Whether a bay is wide enough for open shutters beside its window.
bool HasShutters(const BayPlan& bay);

// What stands before the wall's surface and would hide a plate or be hidden by it.
std::vector<WallRect> Obstacles(const FacadePlan& plan, const WallPlan& wall);

// The places of the control points, spread over the walls with bays as a surveyor would.
std::vector<Plate> PlaceTargets(const FacadePlan& plan);

}  // namespace plumb
