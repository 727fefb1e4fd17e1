// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "plumbline/map/photo_verdict.h"

namespace plumb {

// What this process has used so far, by getrusage.
struct ProcessUsage {
  double cpu_s = 0.0;  // User and system, all threads.
  std::int64_t peak_memory_bytes = 0;
};
ProcessUsage CurrentProcessUsage();

// What one photo cost: from the moment it was taken up until the next one was, the
// retries and background work of that time included.
struct PhotoTurn {
  double wall_s = 0.0;
  double cpu_s = 0.0;  // Of the whole process.
};

// One run over a session: report.json.
struct RunReport {
  std::vector<PhotoVerdict> verdicts;  // All of the session, in the order they were given.
  std::map<PhotoId, PhotoTurn> turns;  // Of the photos of this run.
  std::size_t num_landmarks = 0;
  std::size_t num_observations = 0;
  std::vector<std::string> unread;  // Files that this run could not read, each with the cause.
  double wall_s = 0.0;              // Of this run, from start to end.
  ProcessUsage usage;
  bool interrupted = false;  // Ended before all photos were taken.
  nlohmann::ordered_json options;
};

// Of the form
//   { "run": { "wall_s", "cpu_s", "peak_memory_bytes", "interrupted", "unread": [ … ] },
//     "session": { "photos", "accepted", "waiting", "refused", "landmarks", "observations" },
//     "photos": [ { "id", "name", "verdict", "reason", "hint", "matches", "inliers",
//                   "median_error_px", "seconds": { "decode_s", … }, "attempts": [ … ],
//                   "turn": { "wall_s", "cpu_s" } } ],
//     "options": { … } }
// where a photo shows its latest verdict, and under "attempts" every one, with the same keys.
nlohmann::ordered_json ToJson(const RunReport& report);

// Replaces the file as a whole. Throws std::runtime_error naming it and the cause.
void WriteRunReport(const RunReport& report, const std::string& path);

// The fields of an options struct by name; a nested struct becomes an object.
template <typename Options>
nlohmann::ordered_json OptionsToJson(Options options) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  VisitFields(options, [&json](const char* name, const auto& field) {
    if constexpr (std::is_class_v<std::decay_t<decltype(field)>> &&
                  !std::is_same_v<std::decay_t<decltype(field)>, std::string>) {
      json[name] = OptionsToJson(field);
    } else {
      json[name] = field;
    }
  });
  return json;
}

}  // namespace plumb
