// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/photo_folder.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "plumbline/common/atomic_file.h"
#include "plumbline/image/content_hash.h"

namespace plumb {
namespace {

namespace fs = std::filesystem;

// File systems allow 255 bytes; the rest is for numbers and temporary names.
constexpr std::size_t kMaxNameBytes = 200;

// Shortens `name` to kMaxNameBytes without cutting a UTF-8 character or the extension.
std::string Shortened(const std::string& name) {
  if (name.size() <= kMaxNameBytes) return name;
  std::string extension = fs::path(name).extension().string();
  if (extension.size() > kMaxNameBytes / 2) extension.clear();
  std::size_t length = kMaxNameBytes - extension.size();
  while (length > 1 && (static_cast<unsigned char>(name[length]) & 0xc0U) == 0x80U) --length;
  return name.substr(0, length) + extension;
}

std::string Numbered(const std::string& name, int number) {
  const fs::path path(name);
  return path.stem().string() + '_' + std::to_string(number) + path.extension().string();
}

// "101MEDIA_a.jpg" for "DCIM/101MEDIA/a.jpg"; nothing if `name` has no folder.
std::optional<std::string> WithFolder(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path(name);
  const std::string folder = path.parent_path().filename().string();
  if (folder.empty() || folder[0] == '.') return std::nullopt;
  return SafeFileName(folder + '_' + path.filename().string());
}

bool HoldsBytes(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  std::error_code error;
  return fs::is_regular_file(path, error) && fs::file_size(path, error) == bytes.size() && !error &&
         ReadFileBytes(path.string()) == bytes;
}

}  // namespace

std::string SafeFileName(const std::string& name) {
  const std::size_t slash = name.find_last_of("/\\");
  std::string safe = slash == std::string::npos ? name : name.substr(slash + 1);
  for (char& character : safe) {
    const unsigned char code = static_cast<unsigned char>(character);
    if (code < 0x20 || code == 0x7f) character = '_';
  }
  if (safe.empty() || safe[0] == '.') safe = "photo" + safe;
  return Shortened(safe);
}

void PhotoFolder::Prepare() {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error || !fs::is_directory(path_)) {
    throw std::runtime_error(path_ + ": cannot make this folder" +
                             (error ? ": " + error.message() : std::string()) +
                             "; make its parent writable or choose another session folder");
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) {
    std::error_code ignored;  // A leftover that cannot be removed does no harm.
    if (IsAbandonedFileName(entry.path().filename().string())) fs::remove(entry.path(), ignored);
  }
}

bool PhotoFolder::IsFree(const std::string& name,
                         const std::vector<std::uint8_t>& bytes,
                         const Content& content) const {
  const auto claim = claims_.find(name);
  if (claim != claims_.end()) return claim->second == content;
  const fs::path path = PathOf(name);
  return !fs::exists(fs::symlink_status(path)) || HoldsBytes(path, bytes);
}

std::string PhotoFolder::ClaimName(const std::string& name,
                                   const std::vector<std::uint8_t>& bytes) {
  const Content content(bytes.size(), ContentHash(bytes.data(), bytes.size()));
  const std::string safe = SafeFileName(name);
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string candidate = safe;
  if (!IsFree(candidate, bytes, content)) candidate = WithFolder(name).value_or(safe);
  for (int number = 2; !IsFree(candidate, bytes, content); ++number) {
    candidate = Numbered(safe, number);
  }
  claims_[candidate] = content;
  return candidate;
}

std::string PhotoFolder::Save(const std::string& name, const std::vector<std::uint8_t>& bytes) {
  const std::string stored_name = ClaimName(name, bytes);
  const std::string path = PathOf(stored_name);
  if (!HoldsBytes(path, bytes)) WriteFileAtomically(path, bytes.data(), bytes.size());
  return stored_name;
}

}  // namespace plumb
