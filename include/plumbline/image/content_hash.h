// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb {

// A 64-bit fingerprint of `size` bytes, the same on every processor. Tells
// identical files apart from different ones; it is no protection against forgery.
// FNV-1a (Fowler, Noll & Vo, RFC 9923) over little-endian words of 8 bytes rather than over
// bytes, which is about 8 times as fast. As a multiplication never carries high bits into low
// ones, the state is rotated after each word and finished with MurmurHash3's mixer; the length
// comes first.
std::uint64_t ContentHash(const std::uint8_t* bytes, std::size_t size);

}  // namespace plumb
