// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plumbline/simulation/facade.h"

namespace plumb::test {

// Three storeys of three bays: quick to build and to look at.
inline FacadeOptions SmallFacade() {
  FacadeOptions options;
  options.width_m = 14.0;
  options.height_m = 13.0;
  options.num_storeys = 3;
  options.num_doors = 1;
  options.num_targets = 5;
  return options;
}

}  // namespace plumb::test
