// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iomanip>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/georeference/georeference.h"

namespace plumb {

// Text pieces put together; numbers with three decimals unless told otherwise.
template <typename... Pieces>
std::string Text(const Pieces&... pieces) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3);
  (text << ... << pieces);
  return text.str();
}

inline void AddFinding(Finding::Severity severity,
                       std::string code,
                       std::string text,
                       std::vector<Finding>* findings) {
  findings->push_back({severity, std::move(code), std::move(text)});
}

}  // namespace plumb
