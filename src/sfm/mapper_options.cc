// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/mapper_options.h"

namespace plumb {

std::vector<std::string> MapperOptions::Problems() const {
  ProblemList list;
  list.Append("features", features.Problems());
  list.Append("matcher", matcher.Problems());
  list.Append("retrieval", retrieval.Problems());
  list.Append("bootstrap", bootstrap.Problems());
  list.Append("localizer", localizer.Problems());
  list.Append("lookalike", lookalike.Problems());
  list.Append("expander", expander.Problems());
  list.Append("bundle", bundle.Problems());
  list.Require(
      max_retries_per_photo >= 0, "max_retries_per_photo", "at least 0", max_retries_per_photo);
  return list.Take();
}

}  // namespace plumb
