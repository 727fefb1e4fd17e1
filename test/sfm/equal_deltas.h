// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "plumbline/map/map_delta.h"

namespace plumb::test {

using Observations = std::vector<std::pair<LandmarkId, std::pair<PhotoId, std::uint32_t>>>;

inline Observations ObservationsOf(const MapDelta& delta) {
  Observations observations;
  for (const ObservationState& state : delta.observations_added) {
    observations.push_back({state.landmark, {state.photo, state.feature_idx}});
  }
  std::sort(observations.begin(), observations.end());
  return observations;
}

// Bit-equal, but for the order of observations.
inline void ExpectEqual(const MapDelta& a, const MapDelta& b) {
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.landmarks_removed, b.landmarks_removed);
  EXPECT_EQ(a.views_removed, b.views_removed);
  ASSERT_EQ(a.views_set.size(), b.views_set.size());
  for (std::size_t i = 0; i < a.views_set.size(); ++i) {
    EXPECT_EQ(a.views_set[i].photo, b.views_set[i].photo);
    EXPECT_EQ(a.views_set[i].name, b.views_set[i].name);
    EXPECT_EQ(a.views_set[i].cam_from_map.Matrix(), b.views_set[i].cam_from_map.Matrix());
  }
  ASSERT_EQ(a.landmarks_set.size(), b.landmarks_set.size());
  for (std::size_t i = 0; i < a.landmarks_set.size(); ++i) {
    ASSERT_EQ(a.landmarks_set[i].id, b.landmarks_set[i].id);
    ASSERT_EQ(a.landmarks_set[i].position_in_map, b.landmarks_set[i].position_in_map);
  }
  EXPECT_EQ(ObservationsOf(a), ObservationsOf(b));
}

}  // namespace plumb::test
