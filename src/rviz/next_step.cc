// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rviz/next_step.h"

#include <cctype>
#include <utility>

namespace plumb::rviz_panel {
namespace {

std::string Capitalised(std::string text) {
  if (!text.empty()) {
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  }
  return text;
}

// Hints are "what is wrong; what to do", or what to do alone.
NextStep FromHint(const std::string& hint) {
  const std::size_t end = hint.find("; ");
  if (end == std::string::npos) return {NextStep::Kind::kPhoto, Capitalised(hint), ""};
  return {
      NextStep::Kind::kPhoto, Capitalised(hint.substr(end + 2)), Capitalised(hint.substr(0, end))};
}

}  // namespace

std::string GapName(std::size_t index) { return "G" + std::to_string(index + 1); }

std::string WayText(const plumbline::Gap& gap) {
  return gap.way.empty() ? "photo from right here" : gap.way;
}

NextStep NextStepOf(const FlightStatus& status,
                    const std::optional<plumbline::Gaps>& gaps,
                    double now_s) {
  if (!status.hint().empty()) return FromHint(status.hint());
  if (status.IsMeshSilent(now_s)) {
    return {NextStep::Kind::kNothing, "Fly on as planned", "No news of where gaps are."};
  }
  if (!gaps) {
    return {NextStep::Kind::kNothing,
            "Take photos that overlap by two thirds",
            "The map begins with the first two that fit."};
  }
  if (gaps->gaps.empty()) return {NextStep::Kind::kNothing, "No gaps: fly on, or save", ""};
  const plumbline::Gap& worst = gaps->gaps.front();
  const char* unit = gaps->is_metric != 0 ? "" : " (x: your distance to it)";
  return {NextStep::Kind::kGap,
          worst.way.empty() ? "Take a photo right here" : "Fly " + worst.way,
          GapName(0) + ": " + worst.problem + unit};
}

}  // namespace plumb::rviz_panel
