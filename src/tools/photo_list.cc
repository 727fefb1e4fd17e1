// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/photo_list.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <system_error>

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

std::vector<std::string> ListPhotos(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code unknown;  // A dangling link is no folder; reading it says what is wrong.
    if (name[0] != '.' && !entry->is_directory(unknown)) names.push_back(name);
  }
  if (error) {
    throw std::runtime_error(folder + ": cannot read this folder: " + error.message() +
                             "; name the folder that holds the photos");
  }
  if (names.empty()) {
    throw std::runtime_error(folder + ": holds no file; name the folder that holds the photos");
  }
  std::sort(names.begin(), names.end(), NaturallyLess);
  return names;
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
