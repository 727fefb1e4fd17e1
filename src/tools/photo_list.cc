// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/photo_list.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <system_error>

#include "plumbline/image/photo_name.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;

bool IsDigit(char character) { return character >= '0' && character <= '9'; }

// The end of the run of digits that begins at `begin`, leading zeros left out of `*begin`.
std::size_t DigitsEnd(const std::string& text, std::size_t* begin) {
  while (*begin + 1 < text.size() && text[*begin] == '0' && IsDigit(text[*begin + 1])) ++*begin;
  std::size_t end = *begin;
  while (end < text.size() && IsDigit(text[end])) ++end;
  return end;
}

// Negative, zero or positive like strcmp; moves both past what was compared.
int CompareNumbers(const std::string& a, std::size_t* i, const std::string& b, std::size_t* k) {
  const std::size_t end_a = DigitsEnd(a, i);
  const std::size_t end_b = DigitsEnd(b, k);
  const std::size_t length_a = end_a - *i;
  const std::size_t length_b = end_b - *k;
  const int result = length_a != length_b ? (length_a < length_b ? -1 : 1)
                                          : a.compare(*i, length_a, b, *k, length_b);
  *i = end_a;
  *k = end_b;
  return result;
}

// Fisher-Yates, written out because std::shuffle differs between libraries. The modulo's
// bias does not matter for lists of photos.
void Shuffle(std::uint64_t seed, std::vector<std::string>* names) {
  std::mt19937_64 random(seed);
  for (std::size_t i = names->size(); i > 1; --i)
    std::swap((*names)[i - 1], (*names)[random() % i]);
}

constexpr char kHidden[] = "hidden";

// What a file that is no photo by its name is called in the listing.
std::string KindOf(const fs::path& path) {
  const std::string name = path.filename().string();
  if (name[0] == '.') return kHidden;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension.empty() ? "without an extension" : extension;
}

// Lists `prefix` of `folder`: "" or "DCIM/" and the like. Throws std::runtime_error.
void Collect(const fs::path& folder, const std::string& prefix, PhotoListing* listing) {
  std::error_code error;
  for (fs::directory_iterator entry(folder / prefix, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    const std::string name = path.filename().string();
    std::error_code unknown;  // A dangling link is no folder; reading it says what is wrong.
    if (entry->is_directory(unknown)) {
      const bool is_hidden = name[0] == '.';
      const bool is_link = entry->is_symlink(unknown);
      const bool is_session = fs::exists(path / "session.db", unknown);
      if (!is_hidden && !is_link && !is_session) {
        Collect(folder, prefix + name + '/', listing);
      } else {
        ++listing->not_searched[is_hidden ? kHidden : is_link ? "linked" : "with a session"];
      }
    } else if (entry->is_other(unknown)) {
      ++listing->skipped["no file (pipe or device)"];
    } else if (IsPhotoName(name)) {
      listing->photos.push_back(prefix + name);
      if (!prefix.empty()) ++listing->photos_of_subfolder[prefix];
    } else {
      ++listing->skipped[KindOf(path)];
    }
  }
  if (!error) return;
  throw std::runtime_error((folder / prefix).string() + ": cannot read this folder: " +
                           error.message() + "; name the folder that holds the photos");
}

// E.g. "2 .mp4, 1 hidden".
std::string Counted(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [what, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
  }
  return text;
}

}  // namespace

bool NaturallyLess(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[k])) {
      const int result = CompareNumbers(a, &i, b, &k);
      if (result != 0) return result < 0;
    } else if (a[i] != b[k]) {
      return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[k]);
    } else {
      ++i;
      ++k;
    }
  }
  const std::size_t rest_a = a.size() - i;
  const std::size_t rest_b = b.size() - k;
  return rest_a != rest_b ? rest_a < rest_b : a < b;  // 01 and 1 are equal numbers.
}

PhotoListing ListPhotos(const std::string& folder) {
  PhotoListing listing;
  Collect(folder, "", &listing);
  if (listing.photos.empty()) {
    std::string found = listing.skipped.empty() ? "" : ", only " + Counted(listing.skipped);
    if (!listing.not_searched.empty()) {
      found += "; folders not searched: " + Counted(listing.not_searched);
    }
    throw std::runtime_error(folder + ": holds no photo (" + kPhotoKinds + " by their names)" +
                             found + "; name the folder that holds the photos");
  }
  std::sort(listing.photos.begin(), listing.photos.end(), NaturallyLess);
  return listing;
}

std::vector<std::string> Describe(const PhotoListing& listing) {
  std::vector<std::string> lines;
  std::string subfolders;
  for (const auto& [prefix, count] : listing.photos_of_subfolder) {
    subfolders += (subfolders.empty() ? "" : ", ") + prefix + " (" + std::to_string(count) + ')';
  }
  if (!subfolders.empty()) lines.push_back("photos in sub-folders: " + subfolders);
  if (!listing.skipped.empty()) {
    lines.push_back("skipped, no photos by their names (" + std::string(kPhotoKinds) +
                    " are read): " + Counted(listing.skipped));
  }
  if (!listing.not_searched.empty()) {
    lines.push_back("folders not searched: " + Counted(listing.not_searched));
  }
  return lines;
}

void ApplyOrder(const std::string& order, std::vector<std::string>* names) {
  if (order == "name") return;
  if (order == "reverse") {
    std::reverse(names->begin(), names->end());
    return;
  }
  const std::string prefix = "shuffle:";
  std::uint64_t seed = 0;
  const char* end = order.data() + order.size();
  if (order.rfind(prefix, 0) == 0) {
    const auto [stop, error] = std::from_chars(order.data() + prefix.size(), end, seed);
    if (error == std::errc() && stop == end) {
      Shuffle(seed, names);
      return;
    }
  }
  throw std::runtime_error("--order: \"" + order +
                           "\" is no order; use name, reverse or shuffle:SEED with a number");
}

}  // namespace plumb::tools
