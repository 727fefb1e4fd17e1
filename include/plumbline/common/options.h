// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

// Collects one message per violated bound of an options struct, each naming
// the field, its value and the bound.
class ProblemList {
 public:
  // Adds "`field` must be `bound`, but is `value`" unless `holds`.
  template <typename Value>
  void Require(bool holds, const char* field, const char* bound, const Value& value) {
    if (!holds) Add(field, bound, Describe(value));
  }

  // Adds the problems of a nested struct, each prefixed by its `name`.
  void Append(const std::string& name, const std::vector<std::string>& problems);

  std::vector<std::string> Take() { return std::move(problems_); }

 private:
  void Add(const char* field, const char* bound, const std::string& value);
  static std::string Describe(double value);
  static std::string Describe(int value) { return std::to_string(value); }
  static std::string Describe(const std::string& value) { return '"' + value + '"'; }

  std::vector<std::string> problems_;
};

// Throws std::invalid_argument naming `component` and every problem, if any.
void ThrowIfProblems(const std::string& component, const std::vector<std::string>& problems);

}  // namespace plumb
