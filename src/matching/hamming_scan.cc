// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/hamming_scan.h"

namespace plumb::internal {
namespace {

using ScanFunction = std::size_t (*)(const std::vector<std::uint64_t>&,
                                     std::uint64_t,
                                     std::uint32_t,
                                     SignatureHit*);

// Writes the hits without a branch; `hits` has room for one of every signature.
inline __attribute__((always_inline)) std::size_t Scan(const std::vector<std::uint64_t>& signatures,
                                                       std::uint64_t query,
                                                       std::uint32_t max_distance,
                                                       SignatureHit* hits) {
  std::size_t num_hits = 0;
  for (std::size_t i = 0; i < signatures.size(); ++i) {
    const auto distance = static_cast<std::uint32_t>(__builtin_popcountll(signatures[i] ^ query));
    hits[num_hits] = {static_cast<std::uint32_t>(i), distance};
    num_hits += distance <= max_distance ? 1 : 0;
  }
  return num_hits;
}

std::size_t PortableScan(const std::vector<std::uint64_t>& signatures,
                         std::uint64_t query,
                         std::uint32_t max_distance,
                         SignatureHit* hits) {
  return Scan(signatures, query, max_distance, hits);
}

#if defined(__x86_64__)
__attribute__((target("popcnt"))) std::size_t PopcntScan(
    const std::vector<std::uint64_t>& signatures,
    std::uint64_t query,
    std::uint32_t max_distance,
    SignatureHit* hits) {
  return Scan(signatures, query, max_distance, hits);
}
#endif

ScanFunction SelectScan() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("popcnt") != 0) return &PopcntScan;
#endif
  return &PortableScan;
}

}  // namespace

void FindSimilarSignatures(const std::vector<std::uint64_t>& signatures,
                           std::uint64_t query,
                           std::uint32_t max_distance,
                           std::vector<SignatureHit>* hits) {
  static const ScanFunction scan = SelectScan();
  hits->resize(signatures.size());
  hits->resize(scan(signatures, query, max_distance, hits->data()));
}

}  // namespace plumb::internal
