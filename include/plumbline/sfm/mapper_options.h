// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/image/feature_options.h"
#include "plumbline/matching/matcher_options.h"
#include "plumbline/matching/retrieval_options.h"
#include "plumbline/sfm/bootstrap_options.h"
#include "plumbline/sfm/bundle_options.h"
#include "plumbline/sfm/expander_options.h"
#include "plumbline/sfm/localizer_options.h"
#include "plumbline/sfm/lookalike_options.h"

namespace plumb {

struct MapperOptions {
  FeatureOptions features;  // For the caller's AnalyzePhoto.
  MatcherOptions matcher;
  RetrievalOptions retrieval;
  BootstrapOptions bootstrap;
  LocalizerOptions localizer;
  LookalikeOptions lookalike;
  ExpanderOptions expander;
  BundleOptions bundle;

  // After a photo at most this many refused ones are tried again, so that the next photo
  // does not wait for them.
  int max_retries_per_photo = 2;

  // Results depend on the photos and their order alone, never on timing. Offline; a
  // flight must not wait for its background.
  bool deterministic = true;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(MapperOptions& options, Visitor&& visit) {
  visit("features", options.features);
  visit("matcher", options.matcher);
  visit("retrieval", options.retrieval);
  visit("bootstrap", options.bootstrap);
  visit("localizer", options.localizer);
  visit("lookalike", options.lookalike);
  visit("expander", options.expander);
  visit("bundle", options.bundle);
  visit("max_retries_per_photo", options.max_retries_per_photo);
  visit("deterministic", options.deterministic);
}

}  // namespace plumb
