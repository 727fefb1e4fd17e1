// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/detections_follower.h"

#include <plumbline/GetMarkerDetections.h>
#include <ros/service.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ros/marker_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr std::uint32_t kDetectionsQueue = 1000;
constexpr double kAskEvery_s = 0.5;
constexpr double kComplainEvery_s = 5.0;

}  // namespace

DetectionsFollower::DetectionsFollower(const ros::NodeHandle& handle, Take take)
    : take_(std::move(take)), handle_(handle) {
  detections_subscriber_ = handle_.subscribe(
      "marker_detections", kDetectionsQueue, &DetectionsFollower::OnDetections, this);
  searched_subscriber_ =
      handle_.subscribe("searched_photos", 1, &DetectionsFollower::OnSearchedPhotos, this);
}

bool DetectionsFollower::LacksAny() const {
  return std::any_of(searched_.begin(), searched_.end(), [this](std::uint32_t sequence) {
    return heard_.count(sequence) == 0;
  });
}

// The list may overtake the answer on its way: that one is given the time to come.
void DetectionsFollower::Poll() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if ((now - last_asked_).toSec() < kAskEvery_s || !LacksAny()) return;
  last_asked_ = now;
  const std::string service = handle_.resolveName("get_marker_detections");
  if (!ros::service::exists(service, /*print_failure_reason=*/false)) return;
  plumbline::GetMarkerDetections detections;
  if (!ros::service::call(service, detections)) return;
  searched_.clear();
  for (const plumbline::MarkerDetectionArray& answer : detections.response.answers) {
    heard_.insert(answer.sequence);
    Hear(answer);
  }
}

void DetectionsFollower::OnDetections(const plumbline::MarkerDetectionArray& msg) {
  // One that was not searched may be searched later.
  if (msg.reason.empty()) heard_.insert(msg.sequence);
  Hear(msg);
}

void DetectionsFollower::OnSearchedPhotos(const plumbline::SearchedPhotos& msg) {
  const bool lacked_any = LacksAny();
  searched_ = msg.sequences;
  if (!lacked_any && !heard_.empty()) last_asked_ = ros::SteadyTime::now();
}

void DetectionsFollower::Hear(const plumbline::MarkerDetectionArray& msg) {
  if (!msg.reason.empty()) return;
  std::optional<std::vector<MarkerDetection>> detections = FromMarkerDetectionsMsg(msg);
  if (!detections || msg.sequence == 0 || !PhotoId{msg.sequence}.IsValid()) {
    ROS_ERROR_THROTTLE(kComplainEvery_s,
                       "the markers of photo %u (%s) are dropped: their numbers make no sense",
                       msg.sequence,
                       msg.name.c_str());
    return;
  }
  take_(PhotoId{msg.sequence}, std::move(*detections));
}

}  // namespace plumb::ros_adapter
