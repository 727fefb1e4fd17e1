// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is looked at anew after a change, and what comes of it.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "image/parallel_for.h"
#include "quality/quality_map_impl.h"

namespace plumb {
namespace {

using internal::ImageRect;
using internal::Sight;
using internal::SightSums;

// Steps of the noise: a change of a tenth is not worth painting the whole mesh anew.
constexpr double kNoiseStep = 1.1;

// sqrt of the largest eigenvalue of the inverse of the information, from the least eigenvalue of
// the information itself.
float LargestSigma(const SightSums& sums, std::size_t face) {
  Eigen::Matrix3d information;
  for (Eigen::Index row = 0, entry = 0; row < 3; ++row) {
    for (Eigen::Index column = row; column < 3; ++column, ++entry) {
      const double value = sums.information[static_cast<std::size_t>(entry)][face];
      information(row, column) = value;
      information(column, row) = value;
    }
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(information, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues()[0];
  // Rays within a twentieth of a degree leave the depth open.
  if (!(least > 1e-6 * solver.eigenvalues()[2])) return std::numeric_limits<float>::infinity();
  return static_cast<float>(1.0 / std::sqrt(least));
}

}  // namespace

void QualityMap::Impl::LookAnew() {
  const std::map<BlockId, BlockTask> tasks = Prepare();
  std::vector<const std::pair<const BlockId, BlockTask>*> items;
  for (const auto& item : tasks) items.push_back(&item);
  std::vector<BlockOutcome> outcomes(items.size());
  ParallelFor(options_.num_threads, static_cast<int>(items.size()), 1, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      outcomes[i] = Perform(items[i]->first, items[i]->second);
    }
  });
  for (std::size_t i = 0; i < items.size(); ++i) {
    const BlockId& id = items[i]->first;
    update_.num_rays += outcomes[i].num_rays;
    if (outcomes[i].is_touched) touched_blocks_.insert(id);
    for (const PhotoId photo : outcomes[i].new_rows) blocks_of_view_[photo].insert(id);
  }
}

// Plans while the trees of the occluders are built.
std::map<BlockId, QualityMap::Impl::BlockTask> QualityMap::Impl::Prepare() {
  std::map<BlockId, BlockTask> tasks;
  ParallelFor(options_.num_threads, 2, 1, [&](int part, int /*end*/) {
    if (part == 0) {
      occluders_.Commit();
    } else {
      tasks = PlanLooks();
    }
  });
  return tasks;
}

std::map<BlockId, QualityMap::Impl::BlockTask> QualityMap::Impl::PlanLooks() const {
  std::map<BlockId, BlockTask> tasks;
  for (const auto& [photo, sight] : sights_) {
    const auto plan = [&, &photo = photo, &sight = sight](const BlockId& id) {
      const BlockState& state = states_.at(id);
      if (state.box.isEmpty()) return;
      if (!sight.MayShow(state.box.center(), 0.5 * state.box.diagonal().norm())) return;
      tasks[id].looks.push_back({photo, &sight});
    };
    if (changed_views_.count(photo) != 0) {
      for (const auto& [id, state] : states_) plan(id);
    } else {
      PlanLooksPast(photo, sight, &tasks);
      for (const auto& [id, box] : changed_boxes_) {
        if (states_.count(id) != 0) plan(id);
      }
    }
  }
  return tasks;
}

// Unchanged blocks that the view has to see past a changed one: what covers the same part of the
// image and is nearer may have come or gone.
void QualityMap::Impl::PlanLooksPast(PhotoId photo,
                                     const Sight& sight,
                                     std::map<BlockId, BlockTask>* tasks) const {
  const auto shown = blocks_of_view_.find(photo);
  if (shown == blocks_of_view_.end()) return;
  std::vector<ImageRect> rects;
  for (const auto& [id, box] : changed_boxes_) {
    if (box.isEmpty() || !sight.MayShow(box.center(), 0.5 * box.diagonal().norm())) continue;
    rects.push_back(sight.RectOf(box.min(), box.max()));
  }
  if (rects.empty()) return;
  for (const BlockId& id : shown->second) {
    if (changed_boxes_.count(id) != 0) continue;
    const BlockState& state = states_.at(id);
    const ImageRect own = sight.RectOf(state.box.min(), state.box.max());
    LookPast look{{photo, &sight}, {}};
    for (const ImageRect& rect : rects) {
      if (rect.Meets(own) && rect.min_depth < own.max_depth) look.before.push_back(rect);
    }
    if (!look.before.empty()) (*tasks)[id].looks_past.push_back(std::move(look));
  }
}

// Changes the block's own state only.
QualityMap::Impl::BlockOutcome QualityMap::Impl::Perform(const BlockId& id, const BlockTask& task) {
  BlockOutcome outcome;
  std::vector<Test> tests;
  for (const LookPast& look : task.looks_past) CollectBehind(id, look, &tests);
  for (const Look& look : task.looks) MakeRow(id, look, &tests, &outcome);
  outcome.num_rays = tests.size();
  outcome.is_touched = !outcome.new_rows.empty();
  if (Decide(id, tests)) outcome.is_touched = true;
  return outcome;
}

// Faces of the block in the view that lie behind what has changed, as it covers the image.
void QualityMap::Impl::CollectBehind(const BlockId& id,
                                     const LookPast& look,
                                     std::vector<Test>* tests) {
  SightRow& row = states_.at(id).rows.at(look.look.photo);
  const std::vector<FaceShape>& shapes = blocks_.at(id).shapes;
  for (std::uint32_t i = 0; i < row.size(); ++i) {
    if (row[i] == 0.0F) continue;
    const Eigen::Vector3d seen = look.look.sight->Seen(shapes[i].center_in_map);
    const auto is_before = [&](const ImageRect& rect) {
      return seen.z() > rect.min_depth && seen.x() >= rect.min.x() && seen.x() <= rect.max.x() &&
             seen.y() >= rect.min.y() && seen.y() <= rect.max.y();
    };
    if (std::any_of(look.before.begin(), look.before.end(), is_before)) {
      tests->push_back({{i, &shapes[i].center_in_map, &look.look.sight->eye_in_map()}, &row[i]});
    }
  }
}

void QualityMap::Impl::MakeRow(const BlockId& id,
                               const Look& look,
                               std::vector<Test>* tests,
                               BlockOutcome* outcome) {
  const std::vector<FaceShape>& shapes = blocks_.at(id).shapes;
  SightRow row(shapes.size());
  internal::FindStretches(look.sight->numbers(), states_.at(id).faces, row.data());
  if (std::all_of(row.begin(), row.end(), [](float value) { return value == 0.0F; })) return;
  SightRow& stored = states_.at(id).rows[look.photo];
  stored = std::move(row);
  outcome->new_rows.push_back(look.photo);
  for (std::uint32_t i = 0; i < stored.size(); ++i) {
    if (stored[i] == 0.0F) continue;
    tests->push_back({{i, &shapes[i].center_in_map, &look.sight->eye_in_map()}, &stored[i]});
  }
}

// Casts the rays, neighbouring ones together, and puts what they tell into the rows; whether that
// is another thing than before.
bool QualityMap::Impl::Decide(const BlockId& id, const std::vector<Test>& tests) const {
  const std::vector<std::uint32_t>& ranks = states_.at(id).ranks;
  std::vector<std::size_t> place_of_rank(ranks.size() + 1, 0);
  for (const Test& test : tests) ++place_of_rank[ranks[test.line.face] + 1];
  std::partial_sum(place_of_rank.begin(), place_of_rank.end(), place_of_rank.begin());
  std::vector<internal::SightLine> lines(tests.size());
  std::vector<float*> values(tests.size());
  for (const Test& test : tests) {
    const std::size_t place = place_of_rank[ranks[test.line.face]]++;
    lines[place] = test.line;
    values[place] = test.value;
  }
  const std::vector<char> is_hidden = occluders_.FindHidden(blocks_.at(id).mesh, lines);
  bool is_changed = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = std::abs(*values[i]);
    const float now = is_hidden[i] != 0 ? -value : value;
    is_changed = is_changed || now != *values[i];
    *values[i] = now;
  }
  return is_changed;
}

// Sums up the block's rows; whether something came out that was not known.
bool QualityMap::Impl::Summarize(const BlockId& id) {
  QualityBlock& block = blocks_.at(id);
  const BlockState& state = states_.at(id);
  SightSums sums(block.shapes.size());
  for (const auto& [photo, row] : state.rows) {
    internal::AddSight(sights_.at(photo).numbers(), state.faces, row.data(), &sums);
  }
  std::vector<FaceQuality> qualities(block.shapes.size());
  for (std::size_t i = 0; i < qualities.size(); ++i) {
    FaceQuality& quality = qualities[i];
    quality.gsd = sums.least_stretch[i];
    quality.num_views = sums.num_seen[i];
    quality.num_hidden = sums.num_hidden[i];
    if (quality.num_views >= 2) quality.sigma_per_px = LargestSigma(sums, i);
  }
  const bool is_new = changed_boxes_.count(id) != 0 || qualities != block.qualities;
  block.qualities = std::move(qualities);
  return is_new;
}

void QualityMap::Impl::UpdateNoise() {
  double noise_px = options_.default_noise_px;
  const auto estimate = camera_ ? noise_.Estimate(*camera_, views_) : std::nullopt;
  if (estimate && *estimate > 0.0) {
    noise_px = std::pow(kNoiseStep, std::round(std::log(*estimate) / std::log(kNoiseStep)));
  }
  update_.is_noise_changed = noise_px != noise_px_;
  noise_px_ = noise_px;
}

QualityUpdate QualityMap::Impl::Finish() {
  const std::vector<BlockId> touched(touched_blocks_.begin(), touched_blocks_.end());
  std::vector<char> is_new(touched.size(), 1);  // As removed blocks are.
  ParallelFor(options_.num_threads, static_cast<int>(touched.size()), 1, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (blocks_.count(touched[i]) != 0) is_new[i] = Summarize(touched[i]) ? 1 : 0;
    }
  });
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (is_new[i] != 0) update_.blocks.push_back(touched[i]);
  }
  UpdateNoise();
  changed_views_.clear();
  changed_boxes_.clear();
  touched_blocks_.clear();
  return std::exchange(update_, {});
}

}  // namespace plumb
