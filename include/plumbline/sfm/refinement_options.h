// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/common/options.h"
#include "plumbline/sfm/bundle_options.h"
#include "plumbline/sfm/expander_options.h"

namespace plumb {

// A map that is complete is refined more thoroughly than one that a photo is waiting for.
struct RefinementOptions {
  // Its local and background settings do not matter here.
  BundleOptions bundle = RefiningBundle();

  // Bounds on what observations and landmarks are kept.
  ExpanderOptions expander;

  // Bundle and removal of what does not fit take turns so many times.
  int num_rounds = 2;

  std::vector<std::string> Problems() const;

 private:
  static BundleOptions RefiningBundle();
};

template <typename Visitor>
void VisitFields(RefinementOptions& options, Visitor&& visit) {
  visit("bundle", options.bundle);
  visit("expander", options.expander);
  visit("num_rounds", options.num_rounds);
}

}  // namespace plumb
