// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is looked at anew after a change, and what comes of it.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "image/parallel_for.h"
#include "quality/quality_map_impl.h"

namespace plumb {
namespace {

using internal::ImageRect;
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
  const std::vector<BlockState*> planned = Prepare();
  std::vector<BlockOutcome> outcomes(planned.size());
  ParallelFor(options_.num_threads, static_cast<int>(planned.size()), 1, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      outcomes[i] = Perform(planned[i]);
    }
  });
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const BlockId& id = planned[i]->block->mesh.id;
    update_.num_rays += outcomes[i].num_rays;
    if (outcomes[i].is_touched) touched_blocks_.insert(id);
    for (const PhotoId photo : outcomes[i].new_rows) blocks_of_view_[photo][id] = planned[i];
  }
}

// Plans and looks at the noise while the trees of the occluders are built.
std::vector<QualityMap::Impl::BlockState*> QualityMap::Impl::Prepare() {
  std::vector<BlockState*> planned;
  const std::vector<BlockId> regions(occluders_.changed_regions().begin(),
                                     occluders_.changed_regions().end());
  const int num_parts = 2 + static_cast<int>(regions.size());
  ParallelFor(options_.num_threads, num_parts, 1, [&](int part, int /*end*/) {
    if (part == 0) {
      planned = PlanLooks();
    } else if (part == 1) {
      UpdateNoise();
    } else {
      occluders_.CommitRegion(regions[static_cast<std::size_t>(part - 2)]);
    }
  });
  occluders_.Commit();
  return planned;
}

std::vector<QualityMap::Impl::BlockState*> QualityMap::Impl::PlanLooks() {
  std::vector<Eigen::AlignedBox3d> changed_boxes;
  for (const auto& [id, box] : changed_boxes_) {
    if (!box.isEmpty()) changed_boxes.push_back(box);
  }
  std::vector<BlockState*> all;
  std::vector<BlockState*> changed;
  for (auto& [id, state] : states_) {
    if (state.box.isEmpty()) continue;
    all.push_back(&state);
    if (state.is_changed) changed.push_back(&state);
  }
  for (const auto& [photo, sight] : sights_) {
    const Look look = {photo, &sight};
    const bool is_changed = changed_views_.count(photo) != 0;
    if (!is_changed) PlanLooksPast(look, changed_boxes);
    for (BlockState* state : is_changed ? all : changed) {
      if (!sight.MayShow(state->box.center(), 0.5 * state->box.diagonal().norm())) continue;
      state->looks.push_back(look);
    }
  }
  std::vector<BlockState*> planned;
  std::copy_if(all.begin(), all.end(), std::back_inserter(planned), [](const BlockState* state) {
    return !state->looks.empty() || !state->looks_past.empty();
  });
  return planned;
}

// Unchanged blocks that the view has to see past a changed one: what covers the same part of the
// image and is nearer may have come or gone.
void QualityMap::Impl::PlanLooksPast(const Look& look,
                                     const std::vector<Eigen::AlignedBox3d>& changed_boxes) {
  const auto shown = blocks_of_view_.find(look.photo);
  if (shown == blocks_of_view_.end()) return;
  std::vector<ImageRect> rects;
  for (const Eigen::AlignedBox3d& box : changed_boxes) {
    if (!look.sight->MayShow(box.center(), 0.5 * box.diagonal().norm())) continue;
    rects.push_back(look.sight->RectOf(box.min(), box.max()));
  }
  if (rects.empty()) return;
  for (const auto& [id, state] : shown->second) {
    if (state->is_changed) continue;
    const ImageRect own = look.sight->RectOf(state->box.min(), state->box.max());
    LookPast look_past{look, {}};
    for (const ImageRect& rect : rects) {
      if (rect.Meets(own) && rect.min_depth < own.max_depth) look_past.before.push_back(rect);
    }
    if (look_past.before.empty()) continue;
    state->looks_past.push_back(std::move(look_past));
  }
}

// Changes the block's own state only.
QualityMap::Impl::BlockOutcome QualityMap::Impl::Perform(BlockState* state) const {
  BlockOutcome outcome;
  std::vector<Test> tests;
  for (const LookPast& look : state->looks_past) CollectBehind(look, state, &tests);
  for (const Look& look : state->looks) MakeRow(look, state, &tests, &outcome);
  state->looks_past.clear();
  state->looks.clear();
  outcome.num_rays = tests.size();
  outcome.is_touched = !outcome.new_rows.empty();
  if (Decide(*state, tests)) outcome.is_touched = true;
  return outcome;
}

// Faces of the block in the view that lie behind what has changed, as it covers the image.
void QualityMap::Impl::CollectBehind(const LookPast& look,
                                     BlockState* state,
                                     std::vector<Test>* tests) {
  SightRow& row = state->rows.at(look.look.photo);
  const std::vector<FaceShape>& shapes = state->block->shapes;
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

void QualityMap::Impl::MakeRow(const Look& look,
                               BlockState* state,
                               std::vector<Test>* tests,
                               BlockOutcome* outcome) {
  const std::vector<FaceShape>& shapes = state->block->shapes;
  SightRow row(shapes.size());
  internal::FindStretches(look.sight->numbers(), state->faces, row.data());
  if (std::all_of(row.begin(), row.end(), [](float value) { return value == 0.0F; })) return;
  SightRow& stored = state->rows[look.photo];
  stored = std::move(row);
  outcome->new_rows.push_back(look.photo);
  for (std::uint32_t i = 0; i < stored.size(); ++i) {
    if (stored[i] == 0.0F) continue;
    tests->push_back({{i, &shapes[i].center_in_map, &look.sight->eye_in_map()}, &stored[i]});
  }
}

// Casts the rays, neighbouring ones together, and puts what they tell into the rows; whether that
// is another thing than before.
bool QualityMap::Impl::Decide(const BlockState& state, const std::vector<Test>& tests) const {
  const std::vector<std::uint32_t>& ranks = state.ranks;
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
  const std::vector<char> is_hidden = occluders_.FindHidden(state.block->mesh, lines);
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
bool QualityMap::Impl::Summarize(BlockState* state) const {
  QualityBlock& block = *state->block;
  SightSums sums(block.shapes.size());
  for (const auto& [photo, row] : state->rows) {
    internal::AddSight(sights_.at(photo).numbers(), state->faces, row.data(), &sums);
  }
  std::vector<FaceQuality> qualities(block.shapes.size());
  for (std::size_t i = 0; i < qualities.size(); ++i) {
    FaceQuality& quality = qualities[i];
    quality.gsd = sums.least_stretch[i];
    quality.num_views = sums.num_seen[i];
    quality.num_hidden = sums.num_hidden[i];
    if (quality.num_views >= 2) quality.sigma_per_px = LargestSigma(sums, i);
  }
  const bool is_new = state->is_changed || qualities != block.qualities;
  state->is_changed = false;
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
      const auto state = states_.find(touched[i]);
      if (state != states_.end()) is_new[i] = Summarize(&state->second) ? 1 : 0;
    }
  });
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (is_new[i] != 0) update_.blocks.push_back(touched[i]);
  }
  changed_views_.clear();
  changed_boxes_.clear();
  touched_blocks_.clear();
  return std::exchange(update_, {});
}

}  // namespace plumb
