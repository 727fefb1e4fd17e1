// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb {

// MurmurHash64A (A. Appleby, public domain) with seed 0: a 64-bit fingerprint of `size` bytes, 8
// of them a step, the same on every processor. Tells photos apart; no protection against forgery.
std::uint64_t ContentHash(const std::uint8_t* bytes, std::size_t size);

}  // namespace plumb
