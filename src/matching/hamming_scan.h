// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace plumb::internal {

struct SignatureHit {
  std::uint32_t idx = 0;
  std::uint32_t distance = 0;  // Bits that differ.
};

// Replaces `hits` by all signatures that differ from `query` in at most `max_distance` bits, by
// index.
void FindSimilarSignatures(const std::vector<std::uint64_t>& signatures,
                           std::uint64_t query,
                           std::uint32_t max_distance,
                           std::vector<SignatureHit>* hits);

}  // namespace plumb::internal
