// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/console.h"

#include <iomanip>
#include <sstream>

#include "plumbline/map/verdict_wording.h"

namespace plumb::tools {
namespace {

constexpr std::size_t kBarWidth = 30;
constexpr char kEraseLine[] = "\r\033[K";

}  // namespace

std::string Describe(const PhotoVerdict& verdict) {
  std::ostringstream line;
  line << std::fixed << verdict.name << ": " << ToString(verdict.status);
  if (verdict.reason != RefusalReason::kNone) line << ", " << ToString(verdict.reason);
  if (!verdict.hint.empty()) line << ": " << verdict.hint;
  if (verdict.num_inliers > 0) {
    line << ", " << DescribeAgreement(verdict) << " to " << std::setprecision(2)
         << verdict.median_error_px << " px";
  }
  if (verdict.attempt > 1) {
    line << " (attempt " << verdict.attempt << ')';
  } else {
    line << " (" << std::setprecision(2) << verdict.seconds.verdict_s << " s)";
  }
  return line.str();
}

void Console::PrintLine(const std::string& line) {
  if (!bar_.empty()) *out_ << kEraseLine;
  *out_ << line << '\n' << bar_ << std::flush;
}

void Console::ShowProgress(std::size_t num_done, std::size_t num_all, const std::string& note) {
  if (!is_terminal_ || num_all == 0) return;
  const std::size_t filled = kBarWidth * num_done / num_all;
  bar_ = '[' + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "] " +
         std::to_string(num_done) + '/' + std::to_string(num_all) + ' ' + note;
  *out_ << kEraseLine << bar_ << std::flush;
}

void Console::ClearBar() {
  if (!bar_.empty()) *out_ << kEraseLine << std::flush;
  bar_.clear();
}

}  // namespace plumb::tools
