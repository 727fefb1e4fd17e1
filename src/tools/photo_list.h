// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace plumb::tools {

// Runs of digits compare as numbers, so that photo2 comes before photo10.
bool NaturallyLess(const std::string& a, const std::string& b);

// What lies in a folder of photos and its sub-folders.
struct PhotoListing {
  // Paths below the folder of what is a photo by its name, in natural order.
  std::vector<std::string> photos;
  std::map<std::string, int> photos_of_subfolder;  // Of those that have any.
  std::map<std::string, int> skipped;       // Files by what they are, e.g. ".mp4" or "hidden".
  std::map<std::string, int> not_searched;  // Folders: "hidden", "linked" or "with a session".
};

// Lists the folder as the folder watcher does: IsPhotoName decides; hidden sub-folders, links to
// folders and sessions are not searched. A link that leads nowhere is listed. Throws
// std::runtime_error naming the folder if it cannot be read or no photo is in it.
PhotoListing ListPhotos(const std::string& folder);

// What a person must know of a listing, line by line: the sub-folders, and what was skipped.
std::vector<std::string> Describe(const PhotoListing& listing);

// Puts names that are in natural order into `order`: "name", "reverse", or "shuffle:SEED" with a
// number, the same order for a seed on every machine. Throws std::runtime_error for
// another word.
void ApplyOrder(const std::string& order, std::vector<std::string>* names);

}  // namespace plumb::tools
