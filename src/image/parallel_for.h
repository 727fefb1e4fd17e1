// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace plumb {

// Calls `body(begin, end)` for consecutive parts of [0, count) on at most `num_threads`
// threads (0: one for each core) and waits. The parts depend on `count` and `part_size` only.
void ParallelFor(int num_threads,
                 int count,
                 int part_size,
                 const std::function<void(int begin, int end)>& body);

}  // namespace plumb
