// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>
#include <utility>

namespace plumb::test {

// Seconds that this thread has computed since construction or the last Restart: what else the
// machine does counts little.
class CpuWatch {
 public:
  double Restart() {
    const double now = Now();
    return now - std::exchange(start_, now);
  }

 private:
  static double Now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_ = Now();
};

}  // namespace plumb::test
