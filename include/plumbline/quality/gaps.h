// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "plumbline/geometry/rigid3.h"
#include "plumbline/quality/layer.h"
#include "plumbline/quality/quality_block.h"

namespace plumb {

struct GapOptions {
  // A face that fewer cameras see is not sure: two cannot contradict each other.
  int min_views = 3;

  // The GSD to reach [mm]; coarser faces are gaps once the map is metric.
  double wanted_gsd_mm = 5.0;

  // The same while the map is not metric: multiples of the first photos' GSD.
  double wanted_relative_gsd = 1.5;

  // No gap asks for a photo from nearer [m]: the pilot keeps clear of the wall. A GSD that would
  // need it is not wanted.
  double min_distance_m = 2.0;

  // The same while the map is not metric: share of the first photos' distance.
  double min_relative_distance = 0.33;

  // Smaller gaps are not told [share of a square with the sides of a block].
  double min_area_share = 0.15;

  // Nor are those smaller than this share of the largest: a young surface has little else than
  // gaps, and the photos of the large ones often take in the small ones beside them.
  double min_share_of_largest = 0.3;

  // At most so many are told, the largest first: each photo changes them, and more hide the wall.
  int max_gaps = 6;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(GapOptions& options, Visitor&& visit) {
  visit("min_views", options.min_views);
  visit("wanted_gsd_mm", options.wanted_gsd_mm);
  visit("wanted_relative_gsd", options.wanted_relative_gsd);
  visit("min_distance_m", options.min_distance_m);
  visit("min_relative_distance", options.min_relative_distance);
  visit("min_area_share", options.min_area_share);
  visit("min_share_of_largest", options.min_share_of_largest);
  visit("max_gaps", options.max_gaps);
}

// Which no gap asks a photo from nearer than [map units].
double LeastDistance(const GapOptions& options, const Measure& measure);

// The finest GSD that a photo from there has all over, and the one that is wanted, which is no
// finer; as Measure::Gsd gives it.
double FinestGsd(const GapOptions& options, const Measure& measure);
double WantedGsd(const GapOptions& options, const Measure& measure);

// An area that needs another photo, and where to take it from.
struct Gap {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  // Outward, unit length.
  double area = 0.0;                                        // [map units^2]
  double share_unsure = 0.0;  // Of the area, seen by fewer than min_views; the rest is too coarse.
  int num_views = 0;          // Median of its faces.
  double gsd = 0.0;           // Median of its faces, as Measure::Gsd gives it.

  Eigen::Vector3d camera_in_map = Eigen::Vector3d::Zero();  // To photograph from, along -normal.
};

// Gaps among the faces that some camera sees or would see if nothing were in the way: what is
// turned away from all cameras is not what was flown for. A gap gathers the blocks that hang
// together, but no more than one photo takes in from where it is wanted. Largest first.
// `block_side` is that of the mesh [map units].
std::vector<Gap> FindGaps(const GapOptions& options,
                          const std::map<BlockId, QualityBlock>& blocks,
                          const Measure& measure,
                          double block_side);

// Puts the gap first that was first before, if it is still there and no other is twice as large:
// the pilot is on the way to it.
void KeepFirst(const Gap& before, std::vector<Gap>* gaps);

// How to get from a camera to where a gap wants it, along the axes of that camera [map units].
struct Move {
  double right = 0.0;
  double up = 0.0;
  double forward = 0.0;
};

Move MoveTo(const Gap& gap, const Rigid3& cam_from_map);

// What is wrong, as "Only 1 photo sees it".
std::string Problem(const Gap& gap, const GapOptions& options, const Measure& measure);

// Where to fly from the camera given, as "3.0 m right, 1.0 m down"; empty if it is in the right
// place. While the map is not metric, in parts of the distance that the camera has to the gap: "0.5
// x up".
std::string Way(const Gap& gap, const Measure& measure, const Rigid3& cam_from_map);

// Both as sentences for the pilot.
std::string Advice(const Gap& gap,
                   const GapOptions& options,
                   const Measure& measure,
                   const Rigid3& cam_from_map);

}  // namespace plumb
