// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/absolute_path.h"

#include <cstdlib>
#include <filesystem>

namespace plumb::ros_adapter {
namespace {

namespace fs = std::filesystem;

// Of the shell that called roslaunch; the launch files hand it on.
fs::path FolderOfTheUser() {
  const char* folder = std::getenv("PLUMBLINE_CALLED_FROM");
  if (folder != nullptr && fs::path(folder).is_absolute()) return folder;
  std::error_code ignored;
  return fs::current_path(ignored);
}

}  // namespace

void RequireAbsolute(const char* field, const std::string& path, ProblemList* problems) {
  if (path.empty() || fs::path(path).is_absolute()) return;
  const std::string meant = (FolderOfTheUser() / path).lexically_normal().string();
  problems->Require(false, field, ("an absolute path, such as " + meant).c_str(), path);
}

}  // namespace plumb::ros_adapter
