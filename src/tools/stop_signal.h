// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

namespace plumb::tools {

// From now on the first Ctrl-C or SIGTERM sets the flag that is returned, the second ends the
// program at once. The flag is one for the whole program.
const std::atomic<bool>& StopOnSignal();

}  // namespace plumb::tools
