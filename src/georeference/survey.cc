// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/survey.h"

#include <algorithm>
#include <stdexcept>

#include "georeference/crs_check.h"
#include "georeference/survey_formats.h"
#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

void SortById(std::vector<SurveyTarget>* targets) {
  std::stable_sort(
      targets->begin(), targets->end(), [](const auto& a, const auto& b) { return a.id < b.id; });
}

// Precondition: sorted.
void RefuseRepeatedIds(const std::vector<SurveyTarget>& targets) {
  for (std::size_t i = 1; i < targets.size(); ++i) {
    if (targets[i].id != targets[i - 1].id) continue;
    FailAtLine(targets[i].line,
               "id " + targets[i].name + " stands in line " + std::to_string(targets[i - 1].line) +
                   " already; remove one, or correct its id");
  }
}

void RefuseRepeatedPlaces(const std::vector<SurveyTarget>& targets) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (targets[i].point_in_crs != targets[k].point_in_crs) continue;
      FailAtLine(std::max(targets[i].line, targets[k].line),
                 "ids " + targets[k].name + " and " + targets[i].name +
                     " have one place; no two markers have: correct one of lines " +
                     std::to_string(targets[k].line) + " and " + std::to_string(targets[i].line));
    }
  }
}

Survey Parse(const std::string& text, const SurveyReading& reading) {
  const std::vector<TextLine> lines = SplitLines(text);
  if (lines.empty()) throw std::invalid_argument("is empty; write a line for each point");
  std::optional<bool> has_degree_columns;
  Survey survey = IsCrsLine(lines[0].text)
                      ? ParseGcpList(lines, reading.default_sigma_m)
                      : ParseSurveyCsv(lines, reading.default_sigma_m, &has_degree_columns);
  if (survey.targets.empty()) {
    throw std::invalid_argument("holds no point; write a line for each, e.g. 12,4.250,0.013,7.881");
  }
  if (!reading.crs.empty()) survey.crs = reading.crs;
  if (Lowercase(survey.crs) == kLocalCrs) survey.crs = kLocalCrs;
  if (!reading.heights.empty()) survey.heights = HeightReferenceFromString(reading.heights);
  SortById(&survey.targets);
  RefuseRepeatedIds(survey.targets);
  RefuseRepeatedPlaces(survey.targets);
  CheckCrs(has_degree_columns, &survey);
  return survey;
}

}  // namespace

void FailAtLine(int line, const std::string& what) {
  throw std::invalid_argument("line " + std::to_string(line) + ": " + what);
}

Survey ParseSurvey(const std::string& text,
                   const std::string& source,
                   const SurveyReading& reading) {
  try {
    Survey survey = Parse(text, reading);
    survey.source = source;
    return survey;
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(source + ": " + error.what());
  }
}

Survey ReadSurvey(const std::string& path, const SurveyReading& reading) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  return ParseSurvey({bytes.begin(), bytes.end()}, path, reading);
}

}  // namespace plumb
