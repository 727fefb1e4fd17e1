// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/session_map.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tools/count_text.h"

namespace plumb::tools {

SessionMap ReadSessionMap(const SessionStore& store) {
  std::optional<MapDelta> refined = store.RefinedSnapshot();
  if (refined) return {std::move(*refined), true};
  return {store.Snapshot(), false};
}

std::string WhyNothingIsLocated(const SessionStore& store) {
  const std::size_t num_photos = store.Photos().size();
  const std::string run = "run plumbline reconstruct --session " + store.folder();
  if (num_photos == 0) {
    return store.folder() + ": holds no photo yet; " + run + " with the photos and the camera";
  }
  std::map<RefusalReason, std::size_t> refused;
  std::size_t num_refused = 0;
  for (const PhotoVerdict& verdict : store.LatestVerdicts()) {
    if (verdict.status != VerdictStatus::kRefused) continue;
    ++refused[verdict.reason];
    ++num_refused;
  }
  const std::string none =
      store.folder() + ": none of its " + CountOf(num_photos, "photo") + " is located";
  if (num_refused == 0) {
    return none + "; photos that overlap are needed: " + run + " with more of them";
  }
  const auto most =
      std::max_element(refused.begin(), refused.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      });
  return none + ", " + std::to_string(num_refused) + " refused, most as " + ToString(most->first) +
         "; plumbline check or report.json say why for each: " + run + " with better ones";
}

}  // namespace plumb::tools
