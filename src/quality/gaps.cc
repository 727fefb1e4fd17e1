// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/gaps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb {
namespace {

// Faces of one gap look the same way to within this.
constexpr double kMinSameWay = 0.5;  // Cosine of 60 degrees.

struct BadFace {
  const FaceShape* shape;
  const FaceQuality* quality;
  bool is_unsure;
};

struct BadBlock {
  BlockId id;
  std::vector<BadFace> faces;
  double area = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Sum, weighted by area.
  bool is_taken = false;
};

double WantedGsd(const GapOptions& options, const Measure& measure) {
  return measure.metres_per_map_unit ? options.wanted_gsd_mm : options.wanted_relative_gsd;
}

BadBlock FindBadFaces(const GapOptions& options,
                      const QualityBlock& block,
                      const Measure& measure) {
  const double wanted_gsd = WantedGsd(options, measure);
  BadBlock bad;
  for (std::size_t i = 0; i < block.qualities.size(); ++i) {
    const FaceQuality& quality = block.qualities[i];
    if (quality.num_views + quality.num_hidden == 0) continue;
    const bool is_unsure = quality.num_views < options.min_views;
    if (!is_unsure && measure.Gsd(quality) <= wanted_gsd) continue;
    bad.faces.push_back({&block.shapes[i], &quality, is_unsure});
    bad.area += block.shapes[i].area;
    bad.normal += block.shapes[i].area * block.shapes[i].normal_in_map;
  }
  return bad;
}

bool LookSameWay(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.dot(b) >= kMinSameWay * a.norm() * b.norm();
}

// The block and those around it that are in no gap yet and look the same way.
std::vector<const BadBlock*> TakeAround(const BadBlock& seed,
                                        std::map<BlockId, BadBlock>* bad_blocks) {
  std::vector<const BadBlock*> taken;
  for (int i = 0; i < 27; ++i) {
    const auto found =
        bad_blocks->find({seed.id.x + i % 3 - 1, seed.id.y + i / 3 % 3 - 1, seed.id.z + i / 9 - 1});
    if (found == bad_blocks->end() || found->second.is_taken) continue;
    if (!LookSameWay(seed.normal, found->second.normal)) continue;
    found->second.is_taken = true;
    taken.push_back(&found->second);
  }
  return taken;
}

template <typename Value>
Value MedianByArea(std::vector<std::pair<Value, double>> values, double area) {
  std::sort(values.begin(), values.end());
  double passed = 0.0;
  for (const auto& [value, weight] : values) {
    passed += weight;
    if (passed >= 0.5 * area) return value;
  }
  return values.back().first;
}

// A little nearer than the distance that has the wanted GSD in the middle of the photo: the lens
// has larger pixels at its border, and no face is met quite straight on.
constexpr double kNearer = 0.85;

// From the distance that gives the wanted GSD, or from nearer if the others were nearer.
double WantedDistance(const Gap& gap, double wanted_gsd, const Measure& measure) {
  const double for_gsd = kNearer * measure.DistanceFor(wanted_gsd);
  return std::isfinite(gap.gsd) ? std::min(measure.DistanceFor(gap.gsd), for_gsd) : for_gsd;
}

Gap Gather(const std::vector<const BadBlock*>& blocks, double wanted_gsd, const Measure& measure) {
  Gap gap;
  std::vector<std::pair<int, double>> num_views;
  std::vector<std::pair<double, double>> gsds;
  double unsure_area = 0.0;
  for (const BadBlock* block : blocks) {
    gap.area += block->area;
    gap.normal_in_map += block->normal;
    for (const BadFace& face : block->faces) {
      gap.center_in_map += face.shape->area * face.shape->center_in_map;
      num_views.emplace_back(face.quality->num_views, face.shape->area);
      gsds.emplace_back(measure.Gsd(*face.quality), face.shape->area);
      if (face.is_unsure) unsure_area += face.shape->area;
    }
  }
  gap.center_in_map /= gap.area;
  gap.normal_in_map.normalize();
  gap.share_unsure = unsure_area / gap.area;
  gap.num_views = MedianByArea(std::move(num_views), gap.area);
  gap.gsd = MedianByArea(std::move(gsds), gap.area);
  gap.camera_in_map =
      gap.center_in_map + WantedDistance(gap, wanted_gsd, measure) * gap.normal_in_map;
  return gap;
}

}  // namespace

std::vector<Gap> FindGaps(const GapOptions& options,
                          const std::map<BlockId, QualityBlock>& blocks,
                          const Measure& measure,
                          double block_side) {
  std::map<BlockId, BadBlock> bad_blocks;
  std::vector<BadBlock*> by_area;
  for (const auto& [id, block] : blocks) {
    BadBlock bad = FindBadFaces(options, block, measure);
    if (!(bad.area > 0.0 && bad.normal.norm() > 0.0)) continue;
    by_area.push_back(&bad_blocks.emplace(id, std::move(bad)).first->second);
    by_area.back()->id = id;
  }
  std::stable_sort(by_area.begin(), by_area.end(), [](const BadBlock* a, const BadBlock* b) {
    return a->area > b->area;
  });
  std::vector<Gap> gaps;
  const double min_area = options.min_area_share * block_side * block_side;
  for (BadBlock* seed : by_area) {
    if (seed->is_taken) continue;
    const std::vector<const BadBlock*> gathered = TakeAround(*seed, &bad_blocks);
    Gap gap = Gather(gathered, WantedGsd(options, measure), measure);
    if (gap.area >= min_area) gaps.push_back(std::move(gap));
  }
  std::stable_sort(
      gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.area > b.area; });
  const auto max_gaps = static_cast<std::size_t>(options.max_gaps);
  if (gaps.size() > max_gaps) gaps.erase(gaps.begin() + options.max_gaps, gaps.end());
  return gaps;
}

}  // namespace plumb
