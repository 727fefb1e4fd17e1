// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <plumbline/PhotoVerdict.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace plumb::rviz_panel {

enum class Lamp { kDark, kGreen, kYellow, kRed };

// What the panel tells of the photos, from the verdicts and what the nodes say of themselves. Times
// are seconds of any steady clock. Not thread-safe.
class FlightStatus {
 public:
  void OnVerdict(const plumbline::PhotoVerdict& verdict);
  void OnDiagnostics(const diagnostic_msgs::DiagnosticArray& diagnostics, double now_s);

  // Of the newest photo that has a verdict, whatever became of older ones since.
  Lamp lamp() const { return lamp_; }
  const std::string& sentence() const { return sentence_; }

  // What its verdict says is to be done; empty once it is accepted.
  const std::string& hint() const { return hint_; }

  // As the nodes last told them; nothing before that, and once they are silent.
  std::optional<int> num_taken(double now_s) const;
  std::optional<int> num_accepted(double now_s) const;
  std::optional<int> num_refused(double now_s) const;

  // Taken, without a verdict that stands: not yet looked at, or waiting for a partner.
  std::optional<int> num_waiting(double now_s) const;

  std::optional<double> seconds_behind(double now_s) const;

  // No news of the mesh: what it told last may be old.
  bool IsMeshSilent(double now_s) const;

  // What a node says is wrong, or which node is silent; empty if all is well.
  std::string trouble(double now_s) const;

 private:
  static constexpr char kNoPhoto[] = "No photo yet";

  struct NodeStatus {
    std::map<std::string, std::string> values;
    std::string error;
    double heard_s = 0.0;

    bool IsSilent(double now_s) const;
  };

  void NoteFlight(double now_s);
  std::optional<double> Value(const char* node, const char* key, double now_s) const;
  std::optional<int> Count(const char* node, const char* key, double now_s) const;

  Lamp lamp_ = Lamp::kDark;
  std::string sentence_ = kNoPhoto;
  std::string hint_;
  std::uint32_t newest_photo_ = 0;
  int last_num_taken_ = 0;  // Also of a node that is silent since.
  std::map<std::string, NodeStatus> nodes_;
};

}  // namespace plumb::rviz_panel
