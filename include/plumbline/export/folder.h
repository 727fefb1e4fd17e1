// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plumb {

// Makes a folder to export into, with those above it, unless it is there. Throws
// std::runtime_error naming the folder, the cause and the cure.
void MakeExportFolder(const std::string& folder);

}  // namespace plumb
