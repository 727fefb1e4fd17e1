// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/survey_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace plumb {
namespace {

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool StartsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace

std::vector<TextLine> SplitLines(const std::string& text) {
  if (StartsWith(text, "\xFF\xFE") || StartsWith(text, "\xFE\xFF")) {
    throw std::invalid_argument("is UTF-16; save it as \"CSV UTF-8\"");
  }
  if (text.find('\0') != std::string::npos) {
    throw std::invalid_argument(
        "is no text file; export the points as CSV from the program that made it");
  }
  std::istringstream stream(StartsWith(text, "\xEF\xBB\xBF") ? text.substr(3) : text);
  std::vector<TextLine> lines;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string trimmed = Trimmed(line);
    if (!trimmed.empty()) lines.push_back({number, trimmed});
  }
  return lines;
}

std::vector<std::string> SplitFields(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = line.find(separator, begin);
    std::string field = Trimmed(line.substr(begin, end - begin));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = Trimmed(field.substr(1, field.size() - 2));
    }
    fields.push_back(std::move(field));
  }
  return fields;
}

std::vector<std::string> SplitWords(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

double ParseCoordinate(const std::string& text, const std::string& field, bool decimal_comma) {
  if (text.empty()) throw std::invalid_argument(field + " is empty");
  std::string digits = text;
  if (decimal_comma) std::replace(digits.begin(), digits.end(), ',', '.');
  const char* begin = digits.data() + (digits[0] == '+' ? 1 : 0);
  const char* end = digits.data() + digits.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) {
    throw std::invalid_argument(field + " \"" + text +
                                "\" is not a number; write it like 1234.567, without units or "
                                "separators of thousands");
  }
  return value;
}

int ParseId(const std::string& text) {
  int id = -1;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, id);
  return error == std::errc() && stop == end && id >= 0 ? id : -1;
}

std::string Lowercase(std::string text) {
  for (char& letter : text) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return text;
}

}  // namespace plumb
