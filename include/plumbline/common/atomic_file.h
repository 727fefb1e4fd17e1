// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

// Writes a file so that at any moment, even after a crash or a power cut, `path` holds either what
// it held before or all of `size` bytes: a temporary file beside it, fsync, rename, fsync of
// the folder. Throws std::runtime_error naming the file and the cause; nothing is left behind then.
void WriteFileAtomically(const std::string& path, const void* data, std::size_t size);
void WriteFileAtomically(const std::string& path, const std::string& text);

// Before long work whose outcome is to be written: throws as WriteFileAtomically would if it could
// not put a file at `path`. Creates nothing.
void RequireWritable(const std::string& path);

// The whole file. Throws std::runtime_error naming the file and the cause.
std::vector<std::uint8_t> ReadFileBytes(const std::string& path);

// True for the names that WriteFileAtomically gives its temporary files.
bool IsTemporaryFileName(const std::string& name);

// True for those of them whose process no longer runs: nobody will rename them.
bool IsAbandonedFileName(const std::string& name);

}  // namespace plumb
