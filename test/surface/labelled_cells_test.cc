// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/labelled_cells.h"

#include <gtest/gtest.h>

#include "test/surface/cell_checks.h"
#include "test/surface/random_map.h"
#include "test/surface/simple_maps.h"

namespace plumb {
namespace {

using test::RandomMap;

void ExpectSameAfterARestart(const LabelledCells& cells, const MapReplica& map) {
  LabelledCells restarted(cells.options());
  SurfaceReport report;
  restarted.Apply(map.Snapshot(), &report);
  ASSERT_EQ(test::LabelsById(restarted), test::LabelsById(cells));
  ASSERT_EQ(restarted.Energy(), cells.Energy());
}

TEST(LabelledCells, AreOptimalAfterEachOfTenThousandRandomDeltas) {
  RandomMap::Options options;
  options.num_landmarks = 20;
  RandomMap map(options);
  LabelledCells cells{SurfaceOptions()};
  SurfaceReport total;
  for (int step = 0; step < 10'000; ++step) {
    SurfaceReport report;
    cells.Apply(map.delta(), &report);
    total.num_landmarks_reinserted += report.num_landmarks_reinserted;
    total.num_labels_changed += report.num_labels_changed;
    test::ExpectCountsAreThoseFromScratch(cells);
    test::ExpectLabelsAreThoseOfAFreshSolve(cells);
    if (HasFatalFailure()) FAIL() << "step " << step;
    map.Change();
  }
  EXPECT_GT(total.num_landmarks_reinserted, 1000U);  // The deltas did something.
  EXPECT_GT(total.num_labels_changed, 1000U);
}

TEST(LabelledCells, AreTheSameAfterARestart) {
  RandomMap::Options options;
  options.num_landmarks = 100;
  options.num_views = 12;
  options.num_changes = 10;
  options.seed = 2;
  RandomMap map(options);
  LabelledCells cells{SurfaceOptions()};
  for (int step = 0; step < 400; ++step) {
    SurfaceReport report;
    cells.Apply(map.delta(), &report);
    ExpectSameAfterARestart(cells, map.replica());
    if (HasFatalFailure()) FAIL() << "step " << step;
    map.Change();
  }
}

// A ray counts in one cell before its landmark and in one behind it.
TEST(LabelledCells, WeighOnlyCellsWhoseRaysChange) {
  LabelledCells cells{SurfaceOptions()};
  SurfaceReport report;
  cells.Apply(test::SimpleMap::Wall().Snapshot(), &report);
  EXPECT_GT(report.num_cells_changed, 1000U);

  MapDelta delta;
  delta.sequence = 2;
  ViewState view;
  view.photo = PhotoId{10};
  view.cam_from_map = Rigid3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-2, 5, -1));
  delta.views_set = {view};
  delta.observations_added = {{LandmarkId{7}, view.photo, 0, {0, 0}}};
  SurfaceReport second;
  cells.Apply(delta, &second);
  EXPECT_EQ(second.num_rays_added, 1U);
  EXPECT_GE(second.num_cells_changed, 1U);
  EXPECT_LE(second.num_cells_changed, 2U);
  test::ExpectCountsAreThoseFromScratch(cells);
  test::ExpectLabelsAreThoseOfAFreshSolve(cells);
}

}  // namespace
}  // namespace plumb
