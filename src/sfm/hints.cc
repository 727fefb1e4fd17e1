// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/hints.h"

namespace plumb {

std::string HintFor(RefusalReason reason, const std::string& other) {
  const std::string likest = other.empty() ? "the last accepted photo" : other;
  switch (reason) {
    case RefusalReason::kNoOverlap:
      return "shows nothing of the model; go back until the picture overlaps " + likest +
             " by two thirds";
    case RefusalReason::kTooFewInliers:
      return "too little in common with " + likest + "; take a photo half-way between";
    case RefusalReason::kAmbiguous:
      return "fits two places that look alike; fly on from the last accepted photo by half a "
             "window's width, or step back and show something unique, such as a corner or a door";
    case RefusalReason::kNoParallax:
      return "taken from the same spot as " + likest +
             "; move sideways by a tenth of the distance to the wall";
    case RefusalReason::kDuplicate:
      return "the same file as " + likest + "; nothing is lost";
    default:
      return "";
  }
}

std::string HintWithoutMap(RefusalReason reason, const std::string& other) {
  switch (reason) {
    case RefusalReason::kNone:
      return "the first photo; take the next one a tenth of the wall's distance to the side";
    case RefusalReason::kNoOverlap:
      return other.empty()
                 ? "a model begins with two photos; take a second one that overlaps this one by "
                   "two "
                   "thirds, a tenth of the wall's distance to the side"
                 : "no model yet: too little in common with " + other +
                       "; take one that overlaps it by two thirds, a tenth of the wall's distance "
                       "to the side, of a wall with texture";
    case RefusalReason::kTooFewInliers:
      return "no model yet: what looks alike in " + other +
             " does not fit one rigid object; overlap more, and show what stands still";
    case RefusalReason::kAmbiguous:
      return "no model yet: too little depth, or windows too alike, to tell how the camera moved "
             "from " +
             other +
             "; step further aside, or show something that stands out of the wall and is "
             "there only once";
    default:
      return HintFor(reason, other);
  }
}

}  // namespace plumb
