// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace plumb::internal {

[[noreturn]] inline void FailCheck(const char* file, int line, const std::string& what) {
  std::ostringstream message;
  message << file << ':' << line << ": broken precondition: " << what;
  throw std::logic_error(message.str());
}

template <typename A, typename B>
std::string DescribeComparison(const char* expression, const A& a, const B& b) {
  std::ostringstream message;
  message << expression << " (" << a << " against " << b << ')';
  return message.str();
}

}  // namespace plumb::internal

// Preconditions of the caller. A broken one throws std::logic_error with the
// expression and its values; nothing that comes from outside may trip them.
#define PLUMB_CHECK(condition)                                                    \
  do {                                                                            \
    if (!(condition)) plumb::internal::FailCheck(__FILE__, __LINE__, #condition); \
  } while (false)

#define PLUMB_CHECK_OP(a, op, b)                                                                 \
  do {                                                                                           \
    if (!((a)op(b))) {                                                                           \
      plumb::internal::FailCheck(                                                                \
          __FILE__, __LINE__, plumb::internal::DescribeComparison(#a " " #op " " #b, (a), (b))); \
    }                                                                                            \
  } while (false)

#define PLUMB_CHECK_EQ(a, b) PLUMB_CHECK_OP(a, ==, b)
#define PLUMB_CHECK_GE(a, b) PLUMB_CHECK_OP(a, >=, b)
#define PLUMB_CHECK_GT(a, b) PLUMB_CHECK_OP(a, >, b)
#define PLUMB_CHECK_LE(a, b) PLUMB_CHECK_OP(a, <=, b)
#define PLUMB_CHECK_LT(a, b) PLUMB_CHECK_OP(a, <, b)
