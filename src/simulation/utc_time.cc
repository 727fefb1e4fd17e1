// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/utc_time.h"

#include <ctime>

namespace plumb {

std::optional<Timestamp> ParseUtcTime(const std::string& text) {
  constexpr char kFormat[] = "%Y-%m-%dT%H:%M:%S";
  std::tm time{};
  const char* end = ::strptime(text.c_str(), kFormat, &time);
  if (end == nullptr || *end != '\0') return std::nullopt;
  if (time.tm_year < 70 || time.tm_year > 200) return std::nullopt;
  const int day = time.tm_mday;
  const std::time_t seconds = ::timegm(&time);  // Carries the 31st of April into May.
  if (time.tm_mday != day) return std::nullopt;
  return Timestamp{std::int64_t{seconds} * 1'000'000'000};
}

}  // namespace plumb
