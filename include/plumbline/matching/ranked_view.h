// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plumbline/common/ids.h"

namespace plumb {

struct RankedView {
  PhotoId photo;
  double score = 0.0;  // Higher is more alike; comparable within one query only.
};

}  // namespace plumb
