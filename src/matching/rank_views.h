// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "plumbline/common/check.h"
#include "plumbline/matching/ranked_view.h"

namespace plumb::internal {

// The `max_views` best with a positive score, highest first, ties by id.
inline std::vector<RankedView> RankViews(std::vector<RankedView> views, int max_views) {
  PLUMB_CHECK_GE(max_views, 0);
  views.erase(
      std::remove_if(
          views.begin(), views.end(), [](const RankedView& view) { return !(view.score > 0.0); }),
      views.end());
  std::sort(views.begin(), views.end(), [](const RankedView& a, const RankedView& b) {
    return a.score > b.score || (a.score == b.score && a.photo < b.photo);
  });
  views.resize(std::min(views.size(), static_cast<std::size_t>(max_views)));
  return views;
}

}  // namespace plumb::internal
