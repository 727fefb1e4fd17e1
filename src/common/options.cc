// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/common/options.h"

#include <sstream>
#include <stdexcept>

namespace plumb {

void ProblemList::Add(const char* field, const char* bound, const std::string& value) {
  problems_.push_back(std::string(field) + " must be " + bound + ", but is " + value);
}

std::string ProblemList::Describe(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void ProblemList::Append(const std::string& name, const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) problems_.push_back(name + '.' + problem);
}

void ThrowIfProblems(const std::string& component, const std::vector<std::string>& problems) {
  if (problems.empty()) return;
  std::string message = component + ": ";
  for (std::size_t i = 0; i < problems.size(); ++i) {
    message += (i == 0 ? "" : "; ") + problems[i];
  }
  throw std::invalid_argument(message);
}

}  // namespace plumb
