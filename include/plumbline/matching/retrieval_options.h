// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct RetrievalOptions {
  // A trained vocabulary tree, as ViewRetrieval::SaveVocabulary writes it; empty: the tree is
  // trained on the session's own descriptors.
  std::string vocabulary_path;

  // Children of a node of the tree, which has at most branching^depth words.
  int branching = 10;

  // Levels of the tree below its root.
  int depth = 4;

  // Rounds of k-means at each node.
  int num_iterations = 8;

  // Training starts when so many photos have been added.
  int num_training_photos = 10;

  // At most so many descriptors of these photos are trained on.
  int max_training_descriptors = 50000;

  // While there is no tree: so many of the largest features are compared with those of each photo.
  int num_compared_features = 800;

  // True: the tree is taken in after a fixed number of photos, waiting for it if need be, so that
  // results never depend on timing. False: as soon as it is ready.
  bool deterministic = false;

  // If deterministic, the tree is taken in when this many more photos have been added after the
  // training began.
  int num_photos_until_trained = 2;

  // Seed of the training: the same descriptors and seed give the same tree.
  int random_seed = 0;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(RetrievalOptions& options, Visitor&& visit) {
  visit("vocabulary_path", options.vocabulary_path);
  visit("branching", options.branching);
  visit("depth", options.depth);
  visit("num_iterations", options.num_iterations);
  visit("num_training_photos", options.num_training_photos);
  visit("max_training_descriptors", options.max_training_descriptors);
  visit("num_compared_features", options.num_compared_features);
  visit("deterministic", options.deterministic);
  visit("num_photos_until_trained", options.num_photos_until_trained);
  visit("random_seed", options.random_seed);
}

}  // namespace plumb
