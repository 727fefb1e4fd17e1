// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "plumbline/common/timestamp.h"

namespace plumb {

// "2026-05-12T09:30:00"; nothing if it is no such time from 1970 to 2100.
std::optional<Timestamp> ParseUtcTime(const std::string& text);

}  // namespace plumb
