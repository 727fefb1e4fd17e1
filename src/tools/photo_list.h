// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb::tools {

// Runs of digits compare as numbers, so that photo2 comes before photo10.
bool NaturallyLess(const std::string& a, const std::string& b);

// Names of the files of a folder in natural order; folders and hidden files are left out. Throws
// std::runtime_error naming the folder if it cannot be read or holds no file.
std::vector<std::string> ListPhotos(const std::string& folder);

// Puts names that are in natural order into `order`: "name", "reverse", or "shuffle:SEED" with a
// number, the same order for a seed on every machine. Throws std::runtime_error for
// another word.
void ApplyOrder(const std::string& order, std::vector<std::string>* names);

}  // namespace plumb::tools
