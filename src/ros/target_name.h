// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/TargetResidual.h>

#include <cctype>
#include <string>

namespace plumb::ros_adapter {

// As the pilot reads it: a bare number could be anything's, "T7" is a target.
inline std::string TargetName(const plumbline::TargetResidual& target) {
  const bool is_number =
      !target.name.empty() && std::isdigit(static_cast<unsigned char>(target.name[0])) != 0;
  return (is_number ? "T" : "") + target.name;
}

}  // namespace plumb::ros_adapter
