// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/background_bundle.h"

#include <utility>

#include "plumbline/common/check.h"

namespace plumb {

void BackgroundBundle::Start(BundleProblem problem) {
  PLUMB_CHECK(!IsRunning());
  is_done_ = false;
  is_cancelled_ = false;
  outcome_ = {problem, std::move(problem), {}};
  thread_ = std::thread([this] {
    outcome_.report = SolveBundle(options_,
                                  options_.max_global_iterations,
                                  options_.function_tolerance,
                                  &is_cancelled_,
                                  &outcome_.after);
    is_done_ = true;
  });
}

BackgroundBundle::Outcome BackgroundBundle::Take() {
  PLUMB_CHECK(IsRunning());
  thread_.join();
  return std::move(outcome_);
}

void BackgroundBundle::Cancel() {
  if (!IsRunning()) return;
  is_cancelled_ = true;
  thread_.join();
}

}  // namespace plumb
