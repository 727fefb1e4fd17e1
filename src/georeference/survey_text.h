// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct TextLine {
  int number = 0;    // From 1.
  std::string text;  // Without white space at its ends.
};

// The lines of a text file that are not blank. A byte order mark and the CR of CR LF are dropped.
// Throws std::invalid_argument, saying the cure, if it is UTF-16 or not text at all.
std::vector<TextLine> SplitLines(const std::string& text);

// The trimmed parts between separators; quotes around a part are taken off.
std::vector<std::string> SplitFields(const std::string& line, char separator);

// The parts between runs of white space.
std::vector<std::string> SplitWords(const std::string& line);

// A finite number; a comma stands for its point where `decimal_comma`. Throws std::invalid_argument
// naming the field and what is wrong.
double ParseCoordinate(const std::string& text, const std::string& field, bool decimal_comma);

// Nothing but digits, and small enough for an int; otherwise -1.
int ParseId(const std::string& text);

std::string Lowercase(std::string text);

}  // namespace plumb
