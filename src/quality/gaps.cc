// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/gaps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>

namespace plumb {
namespace {

// Faces of one gap look the same way to within this.
constexpr double kMinSameWay = 0.5;  // Cosine of 60 degrees.

// A photo is taken a little nearer than the distance that has the wanted GSD in its middle: the
// lens has larger pixels at its border, and no face is met quite straight on.
constexpr double kNearer = 0.85;

// A gap stays the first until another is larger by so much.
constexpr double kClearlyLarger = 2.0;

// From the middle of a block's square to its edge, in sides: a photo takes in whole blocks.
constexpr double kHalfBlock = 0.5;

struct BadFace {
  const FaceShape* shape;
  const FaceQuality* quality;
  bool is_unsure;
};

struct BadBlock {
  BlockId id;
  std::vector<BadFace> faces;
  double area = 0.0;
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Sum, weighted by area.
  bool is_taken = false;
};

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
    bad.center_in_map += block.shapes[i].area * block.shapes[i].center_in_map;
  }
  if (bad.area > 0.0) bad.center_in_map /= bad.area;
  return bad;
}

bool LookSameWay(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.dot(b) >= kMinSameWay * a.norm() * b.norm();
}

using BadBlocks = std::map<BlockId, BadBlock>;

// The block and those around it that are in no gap yet and look the same way as `seed`.
template <typename Blocks>  // BadBlocks or const BadBlocks.
auto FreeAround(BlockId id, const BadBlock& seed, Blocks* bad_blocks) {
  std::vector<decltype(&bad_blocks->begin()->second)> around;
  for (int i = 0; i < 27; ++i) {
    const auto found = bad_blocks->find({id.x + i % 3 - 1, id.y + i / 3 % 3 - 1, id.z + i / 9 - 1});
    if (found == bad_blocks->end() || found->second.is_taken) continue;
    if (LookSameWay(seed.normal, found->second.normal)) around.push_back(&found->second);
  }
  return around;
}

// Of a gap that would begin with this block, near enough to choose by.
double AreaAround(const BadBlock& seed, const BadBlocks& bad_blocks) {
  double area = 0.0;
  for (const BadBlock* block : FreeAround(seed.id, seed, &bad_blocks)) {
    area += block->area;
  }
  return area;
}

// The blocks that hang together with the seed, are in no gap yet, look the same way and have their
// middle within `radius` of the seed's. Marks them as taken.
std::vector<const BadBlock*> TakeAround(BadBlock* seed, double radius, BadBlocks* bad_blocks) {
  seed->is_taken = true;
  std::vector<const BadBlock*> taken = {seed};
  for (std::size_t next = 0; next < taken.size(); ++next) {
    for (BadBlock* block : FreeAround(taken[next]->id, *seed, bad_blocks)) {
      if ((block->center_in_map - seed->center_in_map).norm() > radius) continue;
      block->is_taken = true;
      taken.push_back(block);
    }
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

// From the distance that gives the wanted GSD, or from nearer if the others were nearer.
double WantedDistance(const Gap& gap, const GapOptions& options, const Measure& measure) {
  const double for_gsd = kNearer * measure.DistanceFor(WantedGsd(options, measure));
  if (!std::isfinite(gap.gsd)) return for_gsd;
  return std::max(LeastDistance(options, measure), std::min(measure.DistanceFor(gap.gsd), for_gsd));
}

Gap Gather(const std::vector<const BadBlock*>& blocks,
           const GapOptions& options,
           const Measure& measure) {
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
  gap.camera_in_map = gap.center_in_map + WantedDistance(gap, options, measure) * gap.normal_in_map;
  return gap;
}

// Gives the block with the largest area around it that is in no gap yet, then the next one. What is
// taken meanwhile only makes areas smaller: it is enough to look again at what comes first.
class SeedQueue {
 public:
  explicit SeedQueue(BadBlocks* bad_blocks) : bad_blocks_(*bad_blocks) {
    for (auto& [id, block] : *bad_blocks) {
      order_.emplace(AreaAround(block, bad_blocks_), -static_cast<std::ptrdiff_t>(blocks_.size()));
      blocks_.push_back(&block);
    }
  }

  // Null once all are taken.
  BadBlock* Next() {
    while (!order_.empty()) {
      const auto [area_before, minus_idx] = order_.top();
      order_.pop();
      BadBlock* block = blocks_[static_cast<std::size_t>(-minus_idx)];
      if (block->is_taken) continue;
      const double area = AreaAround(*block, bad_blocks_);
      if (order_.empty() || area >= order_.top().first) return block;
      order_.emplace(area, minus_idx);
    }
    return nullptr;
  }

 private:
  const BadBlocks& bad_blocks_;
  std::vector<BadBlock*> blocks_;  // By id: equal areas come in their order.
  std::priority_queue<std::pair<double, std::ptrdiff_t>> order_;
};

}  // namespace

double LeastDistance(const GapOptions& options, const Measure& measure) {
  return measure.metres_per_map_unit ? options.min_distance_m / *measure.metres_per_map_unit
                                     : options.min_relative_distance * measure.DistanceFor(1.0);
}

double FinestGsd(const GapOptions& options, const Measure& measure) {
  return measure.GsdAt(LeastDistance(options, measure)) / kNearer;
}

double WantedGsd(const GapOptions& options, const Measure& measure) {
  const double asked =
      measure.metres_per_map_unit ? options.wanted_gsd_mm : options.wanted_relative_gsd;
  return std::max(asked, FinestGsd(options, measure));
}

std::vector<Gap> FindGaps(const GapOptions& options,
                          const std::map<BlockId, QualityBlock>& blocks,
                          const Measure& measure,
                          double block_side) {
  BadBlocks bad_blocks;
  for (const auto& [id, block] : blocks) {
    BadBlock bad = FindBadFaces(options, block, measure);
    if (!(bad.area > 0.0 && bad.normal.norm() > 0.0)) continue;
    bad.id = id;
    bad_blocks.emplace(id, std::move(bad));
  }
  std::vector<Gap> gaps;
  const double min_area = options.min_area_share * block_side * block_side;
  SeedQueue seeds(&bad_blocks);
  while (BadBlock* seed = seeds.Next()) {
    const Gap alone = Gather({seed}, options, measure);
    const double distance = (alone.camera_in_map - alone.center_in_map).norm();
    const double radius = measure.PhotoRadiusAt(distance) - kHalfBlock * block_side;
    Gap gap = Gather(TakeAround(seed, radius, &bad_blocks), options, measure);
    if (gap.area >= min_area) gaps.push_back(std::move(gap));
  }
  std::stable_sort(
      gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.area > b.area; });
  std::size_t num_told = 0;
  while (num_told < gaps.size() && num_told < static_cast<std::size_t>(options.max_gaps) &&
         gaps[num_told].area >= options.min_share_of_largest * gaps[0].area) {
    ++num_told;
  }
  gaps.resize(num_told);
  return gaps;
}

void KeepFirst(const Gap& before, std::vector<Gap>* gaps) {
  if (gaps->empty()) return;
  const auto distance = [&](const Gap& gap) {
    return (gap.center_in_map - before.center_in_map).norm();
  };
  const auto kept = std::min_element(gaps->begin(), gaps->end(), [&](const Gap& a, const Gap& b) {
    return distance(a) < distance(b);
  });
  const bool is_there = distance(*kept) <= std::sqrt(before.area) &&
                        LookSameWay(kept->normal_in_map, before.normal_in_map);
  if (!is_there || gaps->front().area > kClearlyLarger * kept->area) return;
  std::rotate(gaps->begin(), kept, kept + 1);
}

}  // namespace plumb
