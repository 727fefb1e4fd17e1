// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/marker/marker_detector_options.h"

namespace plumb::ros_adapter {

struct MarkerDetectorRosOptions {
  // Where the flight is kept: the answers go into markers.db, and photos that were taken up there
  // but not searched, after a crash or a full queue, are searched when there is time. Empty: what
  // is missed stays missed.
  std::string session_folder;

  // Photos that wait to be searched; one of 16 megapixels takes some 6 MB here. What comes when it
  // is full is answered with a reason.
  int max_queue = 32;

  // By how much the search stands back behind the mapper where both want a core: as nice(1), 0 to
  // 19. Verdicts come first, markers may be late.
  int niceness = 10;

  // Width of the annotated photo [px].
  int annotated_width_px = 1280;

  // The search itself. In a flight it takes no more than one core from the mapper.
  MarkerDetectorOptions detector = [] {
    MarkerDetectorOptions options;
    options.num_threads = 1;
    return options;
  }();

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(MarkerDetectorRosOptions& options, Visitor&& visit) {
  visit("session_folder", options.session_folder);
  visit("max_queue", options.max_queue);
  visit("niceness", options.niceness);
  visit("annotated_width_px", options.annotated_width_px);
  visit("detector", options.detector);
}

}  // namespace plumb::ros_adapter
