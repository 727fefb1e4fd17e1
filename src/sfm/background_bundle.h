// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <thread>

#include "plumbline/sfm/bundle_problem.h"

namespace plumb {

// Solves one bundle at a time in a thread of its own. Called from one thread.
class BackgroundBundle {
 public:
  struct Outcome {
    BundleProblem before;
    BundleProblem after;
    BundleReport report;
  };

  explicit BackgroundBundle(const BundleOptions& options) : options_(options) {}
  ~BackgroundBundle() { Cancel(); }
  BackgroundBundle(const BackgroundBundle&) = delete;
  BackgroundBundle& operator=(const BackgroundBundle&) = delete;

  bool IsRunning() const { return thread_.joinable(); }  // Started and not yet taken.
  bool IsDone() const { return IsRunning() && is_done_; }

  // Must not be running.
  void Start(BundleProblem problem);

  // Waits for the solution. Must be running.
  Outcome Take();

  // Gives up what is running, if anything; waits for the current iteration at most.
  void Cancel();

 private:
  BundleOptions options_;
  std::thread thread_;
  std::atomic<bool> is_done_{false};
  std::atomic<bool> is_cancelled_{false};
  Outcome outcome_;
};

}  // namespace plumb
