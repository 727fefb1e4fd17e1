// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/original_names.h"

#include <filesystem>
#include <map>

namespace plumb::tools {

std::vector<ViewState> WithOriginalNames(std::vector<ViewState> views,
                                         const std::vector<StoredPhoto>& photos) {
  std::map<PhotoId, std::string> original_of_photo;
  for (const StoredPhoto& photo : photos) {
    original_of_photo[photo.id] = std::filesystem::path(photo.source_name).filename().string();
  }
  std::map<std::string, int> num_views_of_original;
  for (const ViewState& view : views) ++num_views_of_original[original_of_photo[view.photo]];
  for (ViewState& view : views) {
    const std::string& original = original_of_photo[view.photo];
    if (!original.empty() && num_views_of_original[original] == 1) view.name = original;
  }
  return views;
}

}  // namespace plumb::tools
