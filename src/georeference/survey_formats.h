// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The two kinds of survey files; see ParseSurvey. They throw std::invalid_argument beginning with
// the line, without the file's name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "georeference/survey_text.h"
#include "plumbline/georeference/survey.h"

namespace plumb {

// Whether the line is a CRS, as it begins OpenDroneMap's file.
bool IsCrsLine(const std::string& line);

Survey ParseGcpList(const std::vector<TextLine>& lines, double default_sigma_m);

// `has_degree_columns`: whether the header names degrees; nothing without a header.
Survey ParseSurveyCsv(const std::vector<TextLine>& lines,
                      double default_sigma_m,
                      std::optional<bool>* has_degree_columns);

// Throws what is wrong with a line, and where.
[[noreturn]] void FailAtLine(int line, const std::string& what);

}  // namespace plumb
