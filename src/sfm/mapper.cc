// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/mapper.h"

#include <stdexcept>
#include <utility>

#include "plumbline/common/check.h"
#include "sfm/expander.h"
#include "sfm/mapper_impl.h"

namespace plumb {
namespace {

// At the end of a session the bounds on errors are opened by these factors and closed again: what
// an early, bent state of the map had shut out gets another chance. Over five orders of
// Herz-Jesus-P8 this took the mean error from 3.4-3.8 mm to 3.2-3.5 mm (at a bound of 6 px).
constexpr double kFinalBoundFactors[] = {2.0, 2.0, 1.0, 1.0};

RetrievalOptions RetrievalOptionsOf(const MapperOptions& options) {
  RetrievalOptions retrieval = options.retrieval;
  retrieval.deterministic = options.deterministic;
  return retrieval;
}

ExpanderOptions Widened(ExpanderOptions options, double factor) {
  options.max_epipolar_error_px *= factor;
  options.max_error_px *= factor;
  return options;
}

}  // namespace

Mapper::Impl::Impl(const MapperOptions& options, const Camera& camera, MapperListener* listener)
    : options_(options),
      camera_(camera),
      listener_(listener),
      retrieval_(RetrievalOptionsOf(options)),
      matches_(options.matcher),
      background_(options.bundle) {
  ThrowIfProblems("mapper", options.Problems());
  PLUMB_CHECK(listener != nullptr);
}

void Mapper::Impl::Add(MapperPhoto photo) {
  since_add_.Restart();
  PLUMB_CHECK(states_.count(photo.id) == 0);
  ++num_photos_;
  PhotoState& state = states_[photo.id];
  state.verdict.photo = photo.id;
  state.verdict.name = photo.name;
  state.verdict.attempt = 0;
  state.verdict.seconds.decode_s = photo.analysis.decode_s;
  state.verdict.seconds.features_s = photo.analysis.features_s;
  state.verdict.seconds.verdict_s = photo.seconds_since_arrival;
  ManageBackground();
  if (RefuseWithoutMap(photo)) return;

  const PhotoId id = photo.id;
  records_[id] = MakePhotoRecord(
      camera_, id, photo.name, photo.exposure_time, std::move(photo.analysis.features));
  if (map_.views().empty()) {
    TryStart(id);
  } else {
    TryAccept(id);
    ReconsiderStart(id);
  }
  retrieval_.Add(id, records_.at(id).features->descriptors);
  RetryQueued(options_.max_retries_per_photo);
  ManageBackground();
}

void Mapper::Impl::Poll() {
  if (!options_.deterministic) ManageBackground();
  RetryQueued(1);
  MatchQueuedPairs(1);
}

void Mapper::Impl::Finish() {
  if (background_.IsRunning()) TakeBackground();
  if (!map_.views().empty()) RetryAllPending();
  retry_queue_.clear();
  for (const PhotoId photo : PendingPhotos()) {
    const PhotoVerdict& verdict = states_.at(photo).verdict;
    if (verdict.status != VerdictStatus::kWaiting) continue;
    const RefusalReason reason =
        verdict.reason == RefusalReason::kNone ? RefusalReason::kNoOverlap : verdict.reason;
    Location nowhere;
    nowhere.views = LikestPhotos(photo);
    PublishRefusal(photo, reason, VerdictStatus::kRefused, nowhere);
  }
  if (map_.views().empty()) return;
  MatchQueuedPairs(unmatched_pairs_.size());
  FinalBundle();
}

BundleProblem Mapper::Impl::GlobalBundle() const {
  return MakeGlobalBundle(
      options_.bundle, map_, camera_.lens(), MovedWithMap(constraints_, camera_, map_));
}

// Takes in a background bundle when it is due and starts one when the map has grown.
void Mapper::Impl::ManageBackground() {
  const bool is_due =
      options_.deterministic
          ? num_photos_ >=
                background_start_ + static_cast<std::size_t>(options_.bundle.global_latency_photos)
          : background_.IsDone();
  if (background_.IsRunning() && is_due) TakeBackground();

  const std::size_t num_views = map_.views().size();
  const bool is_local_enough =
      num_views <= static_cast<std::size_t>(options_.bundle.num_local_views) + 1;
  const bool has_grown =
      static_cast<double>(num_views) >=
      options_.bundle.global_growth_ratio * static_cast<double>(num_views_at_last_bundle_);
  if (background_.IsRunning() || is_local_enough || !has_grown) return;
  num_views_at_last_bundle_ = num_views;
  background_start_ = num_photos_;
  background_.Start(GlobalBundle());
}

void Mapper::Impl::TakeBackground() {
  const BackgroundBundle::Outcome outcome = background_.Take();
  if (!outcome.report.is_usable || !AdoptLens(outcome.after.lens)) return;
  ApplyStaleBundle(outcome.before, outcome.after, &map_);
  CullLandmarks(options_.expander, camera_, map_.LandmarkIds(), &map_);
  EmitDelta();
}

// False if no camera can have that lens: a bundle of too few views may bend it out of shape.
bool Mapper::Impl::AdoptLens(const LensParameters<double>& lens) {
  if (lens == camera_.lens()) return true;
  std::optional<Camera> camera = camera_.WithLens(lens);
  if (!camera) return false;
  camera_ = *std::move(camera);
  map_.SetLens(lens);
  for (auto& [photo, record] : records_) UpdateRays(camera_, &record);
  return true;
}

void Mapper::Impl::FinalBundle() {
  for (const double factor : kFinalBoundFactors) {
    const ExpanderOptions options = Widened(options_.expander, factor);
    for (const auto& [photo, view] : map_.views()) {
      ExpandMap(options, camera_, matches_, records_, photo, &map_);
    }
    CompleteTracks(options, camera_, matches_, map_.LandmarkIds(), &map_);
    BundleProblem problem = GlobalBundle();
    const BundleReport report = SolveBundle(options_.bundle,
                                            options_.bundle.max_global_iterations,
                                            options_.bundle.function_tolerance,
                                            nullptr,
                                            &problem);
    if (report.is_usable && AdoptLens(problem.lens)) ApplyBundle(problem, &map_);
    CullLandmarks(options, camera_, map_.LandmarkIds(), &map_);
  }
  num_views_at_last_bundle_ = map_.views().size();
  EmitDelta();
}

Mapper::Mapper(const MapperOptions& options, const Camera& camera, MapperListener* listener)
    : impl_(std::make_unique<Impl>(options, camera, listener)) {}

Mapper::~Mapper() = default;

void Mapper::Add(MapperPhoto photo) { impl_->Add(std::move(photo)); }

void Mapper::Poll() { impl_->Poll(); }

void Mapper::Finish() { impl_->Finish(); }

void Mapper::SetConstraints(BundleConstraints constraints) {
  impl_->SetConstraints(std::move(constraints));
}

void Mapper::Restore(std::vector<MapperPhoto> photos,
                     const std::vector<PhotoVerdict>& verdicts,
                     const MapDelta& snapshot) {
  impl_->Restore(std::move(photos), verdicts, snapshot);
}

const Map& Mapper::map() const { return impl_->map(); }

const Camera& Mapper::camera() const { return impl_->camera(); }

}  // namespace plumb
