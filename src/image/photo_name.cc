// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/photo_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "plumbline/common/atomic_file.h"

namespace plumb {

bool IsPhotoName(const std::string& name) {
  static constexpr std::array<const char*, 6> kExtensions = {
      ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".bmp"};
  if (name.empty() || name.front() == '.' || IsTemporaryFileName(name)) return false;
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace plumb
