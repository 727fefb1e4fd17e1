// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rviz/flight_status.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace plumb::rviz_panel {
namespace {

// Nodes speak every second; where other programs kept both cores busy, the mesher was at work for
// more than 4 s.
constexpr double kSilentAfter_s = 8.0;

const char* const kIngest = "camera_ingest";
const char* const kMapper = "mapper";
const char* const kMesher = "mesher";

std::string Words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

void FlightStatus::OnVerdict(const plumbline::PhotoVerdict& verdict) {
  if (verdict.sequence < newest_photo_) return;
  newest_photo_ = verdict.sequence;
  const bool is_accepted = verdict.status == plumbline::PhotoVerdict::ACCEPTED;
  hint_ = is_accepted ? "" : verdict.hint;
  if (is_accepted) {
    lamp_ = Lamp::kGreen;
    sentence_ = verdict.name + " accepted";
  } else if (verdict.status == plumbline::PhotoVerdict::WAITING) {
    lamp_ = Lamp::kYellow;
    sentence_ = verdict.name + " waits for a partner";
  } else {
    lamp_ = Lamp::kRed;
    sentence_ = verdict.name + " REFUSED: " + Words(verdict.reason);
  }
}

void FlightStatus::OnDiagnostics(const diagnostic_msgs::DiagnosticArray& diagnostics,
                                 double now_s) {
  for (const diagnostic_msgs::DiagnosticStatus& status : diagnostics.status) {
    for (const char* const node : {kIngest, kMapper, "marker_detector", kMesher, "georeferencer"}) {
      if (status.hardware_id != node) continue;
      NodeStatus& known = nodes_[node];
      known.heard_s = now_s;
      known.values.clear();
      for (const diagnostic_msgs::KeyValue& value : status.values) {
        known.values[value.key] = value.value;
      }
      const bool is_error = status.level == diagnostic_msgs::DiagnosticStatus::ERROR;
      known.error = is_error ? status.message : "";
    }
  }
  NoteFlight(now_s);
}

// Another flight has begun if fewer photos were taken than before. Not if fewer than have verdicts:
// the verdict on a broken file comes before the node that took it is heard.
void FlightStatus::NoteFlight(double now_s) {
  const int taken = num_taken(now_s).value_or(last_num_taken_);
  if (taken < last_num_taken_) {
    newest_photo_ = 0;
    lamp_ = Lamp::kDark;
    sentence_ = kNoPhoto;
    hint_.clear();
  }
  last_num_taken_ = taken;
  const int accepted = num_accepted(now_s).value_or(0);
  if (newest_photo_ > 0 || accepted == 0) return;
  sentence_ = "Going on: " + std::to_string(accepted) + " photos in the map";
}

bool FlightStatus::NodeStatus::IsSilent(double now_s) const {
  return now_s - heard_s > kSilentAfter_s;
}

bool FlightStatus::IsMeshSilent(double now_s) const {
  const auto known = nodes_.find(kMesher);
  return known != nodes_.end() && known->second.IsSilent(now_s);
}

std::optional<double> FlightStatus::Value(const char* node, const char* key, double now_s) const {
  const auto known = nodes_.find(node);
  if (known == nodes_.end() || known->second.IsSilent(now_s)) return std::nullopt;
  const auto value = known->second.values.find(key);
  if (value == known->second.values.end()) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(value->second.c_str(), &end);
  if (end == value->second.c_str() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<int> FlightStatus::Count(const char* node, const char* key, double now_s) const {
  const std::optional<double> value = Value(node, key, now_s);
  if (!value || std::abs(*value) > 1e9) return std::nullopt;
  return static_cast<int>(*value);
}

std::optional<int> FlightStatus::num_taken(double now_s) const {
  return Count(kIngest, "photos taken", now_s);
}

std::optional<int> FlightStatus::num_accepted(double now_s) const {
  return Count(kMapper, "photos accepted", now_s);
}

std::optional<int> FlightStatus::num_refused(double now_s) const {
  return Count(kMapper, "photos refused", now_s);
}

std::optional<int> FlightStatus::num_waiting(double now_s) const {
  const std::optional<int> taken = num_taken(now_s);
  const std::optional<int> accepted = num_accepted(now_s);
  const std::optional<int> refused = num_refused(now_s);
  if (!taken || !accepted || !refused) return Count(kMapper, "photos waiting", now_s);
  return std::max(0, *taken - *accepted - *refused);  // The nodes do not speak at the same time.
}

std::optional<double> FlightStatus::seconds_behind(double now_s) const {
  return Value(kIngest, "seconds behind the camera", now_s);
}

std::string FlightStatus::trouble(double now_s) const {
  for (const auto& [name, node] : nodes_) {
    if (node.IsSilent(now_s)) return name + " is silent.";
    if (!node.error.empty()) return name + ": " + node.error;
  }
  return {};
}

}  // namespace plumb::rviz_panel
