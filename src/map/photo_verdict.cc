// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/photo_verdict.h"

#include <array>
#include <stdexcept>
#include <utility>

namespace plumb {
namespace {

template <typename Enum, std::size_t N>
using Names = std::array<std::pair<Enum, const char*>, N>;

constexpr Names<VerdictStatus, 3> kStatusNames = {{{VerdictStatus::kAccepted, "accepted"},
                                                   {VerdictStatus::kWaiting, "waiting"},
                                                   {VerdictStatus::kRefused, "refused"}}};

constexpr Names<RefusalReason, 10> kReasonNames = {
    {{RefusalReason::kNone, "none"},
     {RefusalReason::kUndecodable, "undecodable"},
     {RefusalReason::kWrongSize, "wrong_size"},
     {RefusalReason::kDuplicate, "duplicate"},
     {RefusalReason::kTooBlurred, "too_blurred"},
     {RefusalReason::kTooFewFeatures, "too_few_features"},
     {RefusalReason::kNoOverlap, "no_overlap"},
     {RefusalReason::kTooFewInliers, "too_few_inliers"},
     {RefusalReason::kAmbiguous, "ambiguous"},
     {RefusalReason::kNoParallax, "no_parallax"}}};

template <typename Enum, std::size_t N>
const char* NameOf(const Names<Enum, N>& names, Enum value) {
  for (const auto& [candidate, name] : names) {
    if (candidate == value) return name;
  }
  throw std::logic_error("an enumerator has no name");
}

template <typename Enum, std::size_t N>
Enum ValueOf(const Names<Enum, N>& names, const char* kind, const std::string& word) {
  for (const auto& [value, name] : names) {
    if (word == name) return value;
  }
  throw std::invalid_argument("unknown " + std::string(kind) + " \"" + word + '"');
}

}  // namespace

const char* ToString(VerdictStatus status) { return NameOf(kStatusNames, status); }

const char* ToString(RefusalReason reason) { return NameOf(kReasonNames, reason); }

VerdictStatus VerdictStatusFromString(const std::string& word) {
  return ValueOf(kStatusNames, "verdict status", word);
}

RefusalReason RefusalReasonFromString(const std::string& word) {
  return ValueOf(kReasonNames, "refusal reason", word);
}

}  // namespace plumb
