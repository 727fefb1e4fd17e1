// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <stdexcept>

#include "georeference/survey_formats.h"
#include "plumbline/marker/codebook.h"

namespace plumb {
namespace {

constexpr char kColumns[] = "id, x_m, y_m, z_m, sigma_m and role";

enum Column { kId, kX, kY, kZ, kSigma, kRole, kNumColumns };

// Where each column stands in a line; -1: nowhere.
struct Layout {
  char separator = ',';
  std::array<int, kNumColumns> idx_of_column = {0, 1, 2, 3, 4, 5};
  std::size_t num_columns = kNumColumns;
  bool has_header = false;
  bool is_in_degrees = false;
};

char FindSeparator(const std::string& line) {
  for (const char separator : {';', '\t'}) {
    if (line.find(separator) != std::string::npos) return separator;
  }
  return ',';
}

Column ColumnOf(const std::string& name, const TextLine& line) {
  const std::string word = Lowercase(name);
  if (word == "id") return kId;
  if (word == "x_m" || word == "lon_deg") return kX;
  if (word == "y_m" || word == "lat_deg") return kY;
  if (word == "z_m") return kZ;
  if (word == "sigma_m") return kSigma;
  if (word == "role") return kRole;
  FailAtLine(line.number,
             "column \"" + name + "\" is unknown; the columns are " + kColumns +
                 " (lon_deg and lat_deg if the CRS counts in degrees), lengths in metres");
}

Layout ReadLayout(const TextLine& first) {
  Layout layout;
  layout.separator = FindSeparator(first.text);
  const std::vector<std::string> names = SplitFields(first.text, layout.separator);
  const bool is_data = names[0].find_first_of("0123456789") == 0;
  if (is_data) return layout;
  layout.has_header = true;
  layout.num_columns = names.size();
  layout.idx_of_column.fill(-1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    int& idx = layout.idx_of_column.at(ColumnOf(names[i], first));
    if (idx >= 0) FailAtLine(first.number, "column \"" + names[i] + "\" stands there twice");
    idx = static_cast<int>(i);
    if (Lowercase(names[i]) == "lon_deg") layout.is_in_degrees = true;
  }
  for (const Column column : {kId, kX, kY, kZ}) {
    if (layout.idx_of_column.at(column) >= 0) continue;
    FailAtLine(first.number,
               std::string("a column of ") + kColumns +
                   " is missing; all but sigma_m and role are needed");
  }
  return layout;
}

// "key: value" behind a '#'; empty if it is another comment.
std::string ValueOf(const std::string& comment, const std::string& key) {
  std::string text = comment.substr(comment.find_first_not_of("# \t"));
  if (Lowercase(text.substr(0, key.size())) != key) return {};
  text = text.substr(key.size());
  const std::size_t colon = text.find_first_not_of(" \t");
  if (colon == std::string::npos || (text[colon] != ':' && text[colon] != '=')) return {};
  const std::size_t begin = text.find_first_not_of(" \t", colon + 1);
  // What a spreadsheet appends to a line with fewer fields than the others.
  return begin == std::string::npos
             ? std::string()
             : text.substr(begin, text.find_last_not_of(" \t,;") - begin + 1);
}

void ReadComment(const TextLine& line, Survey* survey) {
  if (line.text.find_first_not_of("# \t") == std::string::npos) return;
  const std::string crs = ValueOf(line.text, "crs");
  if (!crs.empty()) survey->crs = crs;
  const std::string heights = ValueOf(line.text, "heights");
  if (heights.empty()) return;
  try {
    survey->heights = HeightReferenceFromString(Lowercase(heights));
  } catch (const std::invalid_argument& error) {
    FailAtLine(line.number, error.what());
  }
}

bool ReadRole(const std::string& text) {
  const std::string role = Lowercase(text);
  if (role != "control" && role != "check" && !role.empty()) {
    throw std::invalid_argument("role \"" + text + "\" is neither control nor check");
  }
  return role == "check";
}

int ReadMarkerId(const std::string& text) {
  const int id = ParseId(text);
  const int count = MarkerCodebook::Get().size();
  if (id >= 0 && id < count) return id;
  throw std::invalid_argument("no marker has the id \"" + text +
                              "\"; ids are whole numbers from 0 to " + std::to_string(count - 1) +
                              ", as printed on the marker");
}

// Taken as it stands, a sigma of millimetres would leave the target without a say and let it be
// metres off unnoticed; a target that truly is so uncertain is no better than the photos' GPS.
void CheckSigma(double sigma_m, const std::string& text) {
  constexpr double kMaxSigma_m = 0.5;
  if (sigma_m < 0.0) throw std::invalid_argument("sigma_m is negative");
  if (sigma_m <= kMaxSigma_m) return;
  throw std::invalid_argument("sigma_m " + text +
                              " is no standard deviation of a surveyed point: it counts in metres, "
                              "0.003 for 3 mm; convert the column, or leave out a point that is "
                              "known to no better than 0.5 m");
}

// Empty fields at the end are what a spreadsheet appends.
void CheckNumFields(const Layout& layout, const std::vector<std::string>& fields) {
  const auto last = std::find_if(
      fields.rbegin(), fields.rend(), [](const std::string& field) { return !field.empty(); });
  const auto num_fields = static_cast<std::size_t>(fields.rend() - last);
  if (num_fields <= layout.num_columns) return;
  throw std::invalid_argument("has " + std::to_string(num_fields) + " fields, but there are " +
                              std::to_string(layout.num_columns) +
                              " columns; where numbers have decimal commas, separate the fields by "
                              "semicolons");
}

SurveyTarget ReadTarget(const Layout& layout, const TextLine& line, double default_sigma_m) {
  const std::vector<std::string> fields = SplitFields(line.text, layout.separator);
  const auto field = [&](Column column) {
    const int idx = layout.idx_of_column.at(column);
    const bool is_there = idx >= 0 && idx < static_cast<int>(fields.size());
    return is_there ? fields[static_cast<std::size_t>(idx)] : std::string();
  };
  const bool decimal_comma = layout.separator != ',';
  const std::array<std::string, 3> names =
      layout.is_in_degrees ? std::array<std::string, 3>{"lon_deg", "lat_deg", "z_m"}
                           : std::array<std::string, 3>{"x_m", "y_m", "z_m"};
  if (fields.size() < 4) {
    throw std::invalid_argument("has " + std::to_string(fields.size()) +
                                " fields; an id and three coordinates are needed, separated by "
                                "commas, semicolons or tabulators");
  }
  CheckNumFields(layout, fields);
  SurveyTarget target;
  target.line = line.number;
  target.name = field(kId);
  target.id = ReadMarkerId(target.name);
  for (int axis = 0; axis < 3; ++axis) {
    target.point_in_crs[axis] =
        ParseCoordinate(field(static_cast<Column>(kX + axis)), names.at(axis), decimal_comma);
  }
  target.sigma_m = default_sigma_m;
  if (!field(kSigma).empty()) {
    target.sigma_m = ParseCoordinate(field(kSigma), "sigma_m", decimal_comma);
  }
  CheckSigma(target.sigma_m, field(kSigma));
  target.is_check = ReadRole(field(kRole));
  return target;
}

}  // namespace

Survey ParseSurveyCsv(const std::vector<TextLine>& lines,
                      double default_sigma_m,
                      std::optional<bool>* has_degree_columns) {
  Survey survey;
  survey.heights = HeightReference::kUnstated;
  std::optional<Layout> layout;
  for (const TextLine& line : lines) {
    if (line.text[0] == '#') {
      ReadComment(line, &survey);
      continue;
    }
    const bool is_first = !layout;
    if (is_first) layout = ReadLayout(line);
    if (is_first && layout->has_header) continue;
    try {
      survey.targets.push_back(ReadTarget(*layout, line, default_sigma_m));
    } catch (const std::invalid_argument& error) {
      FailAtLine(line.number, error.what());
    }
  }
  if (layout && layout->has_header) *has_degree_columns = layout->is_in_degrees;
  return survey;
}

}  // namespace plumb
