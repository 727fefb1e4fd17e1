// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "sfm/hints.h"
#include "sfm/mapper_impl.h"

namespace plumb {
namespace {

RefusalReason ReasonOf(PhotoStatus status) {
  switch (status) {
    case PhotoStatus::kUndecodable:
      return RefusalReason::kUndecodable;
    case PhotoStatus::kWrongSize:
      return RefusalReason::kWrongSize;
    case PhotoStatus::kTooBlurred:
      return RefusalReason::kTooBlurred;
    case PhotoStatus::kTooFewFeatures:
      return RefusalReason::kTooFewFeatures;
    case PhotoStatus::kOk:
      break;
  }
  return RefusalReason::kNone;
}

// These may still be located when the map has grown.
bool IsCurable(RefusalReason reason) {
  return reason == RefusalReason::kNone || reason == RefusalReason::kNoOverlap ||
         reason == RefusalReason::kTooFewInliers || reason == RefusalReason::kAmbiguous ||
         reason == RefusalReason::kNoParallax;
}

}  // namespace

bool Mapper::Impl::RefuseWithoutMap(const MapperPhoto& photo) {
  PhotoVerdict verdict = NewVerdict(photo.id);
  verdict.status = VerdictStatus::kRefused;
  verdict.reason = ReasonOf(photo.analysis.status);
  verdict.hint = photo.analysis.detail;
  const auto [same, is_new] = photo_of_hash_.try_emplace(photo.analysis.content_hash, photo.id);
  if (verdict.reason == RefusalReason::kNone && !is_new) {
    verdict.reason = RefusalReason::kDuplicate;
    verdict.hint = HintFor(verdict.reason, states_.at(same->second).verdict.name);
  }
  if (verdict.reason == RefusalReason::kNone) return false;
  Publish(std::move(verdict));
  return true;
}

PhotoVerdict Mapper::Impl::NewVerdict(PhotoId photo) const {
  const PhotoVerdict& last = states_.at(photo).verdict;
  PhotoVerdict verdict;
  verdict.photo = photo;
  verdict.name = last.name;
  verdict.attempt = last.attempt + 1;
  verdict.seconds = last.seconds;
  return verdict;
}

void Mapper::Impl::Publish(PhotoVerdict verdict) {
  PhotoVerdict& last = states_.at(verdict.photo).verdict;
  last = std::move(verdict);
  if (last.attempt == 1) last.seconds.verdict_s += since_add_.Seconds();
  listener_->OnVerdict(last);
}

void Mapper::Impl::PublishRefusal(PhotoId photo,
                                  RefusalReason reason,
                                  VerdictStatus status,
                                  const Location& location) {
  const PhotoVerdict& last = states_.at(photo).verdict;
  const bool is_news = last.attempt == 0 || last.status != status || last.reason != reason;
  if (!is_news) return;
  PhotoVerdict verdict = NewVerdict(photo);
  verdict.status = status;
  verdict.reason = reason;
  verdict.num_matches = location.localization.num_matches;
  verdict.num_inliers = static_cast<int>(location.localization.inliers.size());
  verdict.median_error_px = location.localization.median_error_px;
  const std::string likest =
      location.views.empty() ? std::string() : records_.at(location.views[0]).name;
  verdict.hint = map_.views().empty() ? HintWithoutMap(reason, likest) : HintFor(reason, likest);
  SetPixels(location, &verdict);
  Publish(std::move(verdict));
}

void Mapper::Impl::PublishAccepted(PhotoId photo, const Location& location) {
  PhotoVerdict verdict = NewVerdict(photo);
  verdict.status = VerdictStatus::kAccepted;
  verdict.num_matches = location.localization.num_matches;
  verdict.num_inliers = static_cast<int>(location.localization.inliers.size());
  verdict.median_error_px = location.localization.median_error_px;
  SetPixels(location, &verdict);
  Publish(std::move(verdict));
}

void Mapper::Impl::SetPixels(const Location& location, PhotoVerdict* verdict) const {
  const FeatureSet& features = *records_.at(verdict->photo).features;
  std::vector<char> is_inlier(features.size(), 0);
  for (const MapMatch& match : location.localization.inliers) {
    is_inlier[match.feature_idx] = 1;
    verdict->inlier_pixels.push_back(features.features[match.feature_idx].Pixel().cast<float>());
  }
  for (const MapMatch& match : location.matches) {
    if (is_inlier[match.feature_idx]) continue;
    is_inlier[match.feature_idx] = 1;  // Once is enough for the picture.
    verdict->outlier_pixels.push_back(features.features[match.feature_idx].Pixel().cast<float>());
  }
}

bool Mapper::Impl::IsPending(PhotoId photo) const {
  const PhotoVerdict& verdict = states_.at(photo).verdict;
  return verdict.status != VerdictStatus::kAccepted && IsCurable(verdict.reason) &&
         records_.count(photo) != 0;
}

std::vector<PhotoId> Mapper::Impl::PendingPhotos() const {
  std::vector<PhotoId> pending;
  for (const auto& [photo, state] : states_) {
    if (IsPending(photo)) pending.push_back(photo);
  }
  return pending;
}

void Mapper::Impl::EmitDelta() {
  const auto delta = map_.TakeDelta();
  if (delta) listener_->OnMapDelta(*delta);
}

}  // namespace plumb
