// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/verdict_wording.h"

namespace plumb {

std::string DescribeAgreement(const PhotoVerdict& verdict) {
  if (verdict.num_matches == 0) return {};
  const std::string num_inliers = std::to_string(verdict.num_inliers);
  if (verdict.status == VerdictStatus::kAccepted) return num_inliers + " landmarks agree";
  return num_inliers + " of " + std::to_string(verdict.num_matches) + " matches agree";
}

}  // namespace plumb
