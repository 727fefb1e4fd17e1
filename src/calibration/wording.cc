// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/wording.h"

#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace plumb {
namespace {

constexpr std::size_t kMostNames = 6;

std::string List(const std::vector<std::string>& names) {
  std::string text;
  const std::size_t shown = names.size() > kMostNames ? kMostNames - 1 : names.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const bool is_last = i + 1 == names.size();
    text += (i == 0 ? "" : is_last ? " and " : ", ") + names[i];
  }
  if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

}  // namespace

std::string NameMarkers(const std::vector<int>& ids) {
  std::vector<std::string> names;
  for (const int id : ids) names.push_back(std::to_string(id));
  return (ids.size() == 1 ? "marker " : "markers ") + List(names);
}

std::string NamePhotos(const std::vector<std::string>& names) {
  return (names.size() == 1 ? "photo " : "photos ") + List(names);
}

std::string Count(std::size_t count, const std::string& noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string Number(double value, int digits) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  const double unit = std::pow(10.0, -digits);
  // No minus before nothing.
  text << std::fixed << std::setprecision(digits) << (std::abs(value) < 0.5 * unit ? 0.0 : value);
  return text.str();
}

std::string Length(double length, bool is_metric) {
  if (is_metric) return Number(1000.0 * length, 1) + " mm";
  return Number(length, 2) + " marker diameters";
}

}  // namespace plumb
