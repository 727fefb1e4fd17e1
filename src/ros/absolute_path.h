// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/common/options.h"

namespace plumb::ros_adapter {

// Reports a path that is given and not absolute, with what it was probably meant to be: roslaunch
// starts nodes in ~/.ros, so a relative path would not be where the user stands.
void RequireAbsolute(const char* field, const std::string& path, ProblemList* problems);

}  // namespace plumb::ros_adapter
