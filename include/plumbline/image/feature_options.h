// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct FeatureOptions {
  // Features kept of a photo, the largest scales first.
  int max_features = 5000;

  // A photo with fewer features is refused: the localiser needs some 15 inliers, and of the
  // features of a photo about a sixth finds its partner in a neighbour.
  int min_features = 100;

  // Bound on the difference of Gaussians, of the full range of grey values, at three scales an
  // octave. COLMAP's value (0.02 / 3).
  double min_contrast = 0.02 / 3.0;

  // Bound on the ratio of the principal curvatures (Lowe, IJCV 2004, section 4.1).
  double max_edge_ratio = 10.0;

  // The search begins at the coarsest resolution that has this many pixels a feature wanted.
  double pixels_per_feature = 300.0;

  // A finer resolution is added as long as less than this part of the features wanted is found.
  double min_fill = 0.9;

  // No finer octave is searched than of this size, for its cost grows with its pixels.
  double max_octave_megapixels = 4.0;

  // A photo that is more blurred is refused: sigma in pixels of the resolution that the search
  // begins at (2 pixels of a photo of 6 megapixels). All 158 sharp photos of four real scenes
  // were found below 1.2; blurred by a sigma of 4 (8 pixels of 6 megapixels) they were found at
  // 2.7 to 4.1, by a motion of 12.5 (25 pixels) at 2.5 to 5.3.
  double max_blur = 2.5;

  // Threads of one photo's analysis; 0: one for each core. Does not change the result.
  int num_threads = 0;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(FeatureOptions& options, Visitor&& visit) {
  visit("max_features", options.max_features);
  visit("min_features", options.min_features);
  visit("min_contrast", options.min_contrast);
  visit("max_edge_ratio", options.max_edge_ratio);
  visit("pixels_per_feature", options.pixels_per_feature);
  visit("min_fill", options.min_fill);
  visit("max_octave_megapixels", options.max_octave_megapixels);
  visit("max_blur", options.max_blur);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
