// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace plumb {

// `name` as a plain file name: the part behind the last slash or backslash, control
// characters as '_', no leading dot, at most 200 bytes with the extension kept, never empty.
std::string SafeFileName(const std::string& name);

// A folder of original photos, each file whole or absent, none ever overwritten by other
// bytes. Thread-safe; one process writes at a time.
class PhotoFolder {
 public:
  explicit PhotoFolder(std::string path) : path_(std::move(path)) {}

  // For the one that writes: creates the folder if need be and clears what a killed process left
  // half-written, but not what another process writes just now. Throws std::runtime_error naming
  // the folder.
  void Prepare();

  // The name under which these bytes are or will be kept: SafeFileName(name), or, where that is
  // another photo's, the first free of folder_stem, if `name` has a folder, and stem_2, stem_3, …
  // The name stays theirs. The same name and bytes get the same answer again.
  std::string ClaimName(const std::string& name, const std::vector<std::uint8_t>& bytes);

  // Writes the bytes under their claimed name, unless they are there, and returns it. Throws
  // std::runtime_error naming the file and the cause.
  std::string Save(const std::string& name, const std::vector<std::uint8_t>& bytes);

  std::string PathOf(const std::string& stored_name) const { return path_ + '/' + stored_name; }

 private:
  using Content = std::pair<std::size_t, std::uint64_t>;  // Size and hash.

  bool IsFree(const std::string& name,
              const std::vector<std::uint8_t>& bytes,
              const Content& content) const;

  std::string path_;
  std::mutex mutex_;
  std::map<std::string, Content> claims_;  // By stored name, since this object was made.
};

}  // namespace plumb
