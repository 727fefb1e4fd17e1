// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/labelled_cells.h"

#include <gtest/gtest.h>

#include "test/surface/cell_checks.h"
#include "test/surface/random_map.h"

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

}  // namespace
}  // namespace plumb
