// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/export/folder.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace plumb {

void MakeExportFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return;
  throw std::runtime_error(folder + ": cannot make this folder: " + error.message() +
                           "; make its parent writable or choose another folder");
}

}  // namespace plumb
