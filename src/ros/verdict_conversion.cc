// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/verdict_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumb::ros_adapter {
namespace {

bool FitsInt(std::uint32_t value) {
  return value <= static_cast<std::uint32_t>(std::numeric_limits<int>::max());
}

bool IsSound(const plumbline::PhotoVerdict& msg) {
  const double numbers[] = {msg.median_error_px,
                            msg.decode_s,
                            msg.features_s,
                            msg.retrieval_s,
                            msg.matching_s,
                            msg.pose_s,
                            msg.verdict_s};
  return FitsInt(msg.attempt) && FitsInt(msg.num_matches) && FitsInt(msg.num_inliers) &&
         std::all_of(std::begin(numbers), std::end(numbers), [](double number) {
           return std::isfinite(number);
         });
}

}  // namespace

plumbline::PhotoVerdict ToVerdictMsg(const PhotoVerdict& verdict,
                                     const std::string& map_frame_id,
                                     const ros::Time& stamp) {
  plumbline::PhotoVerdict msg;
  msg.header.frame_id = map_frame_id;
  msg.header.stamp = stamp;
  msg.sequence = verdict.photo.value;
  msg.name = verdict.name;
  msg.attempt = static_cast<std::uint32_t>(verdict.attempt);
  msg.status = ToString(verdict.status);
  msg.reason = ToString(verdict.reason);
  msg.hint = verdict.hint;
  msg.num_matches = static_cast<std::uint32_t>(verdict.num_matches);
  msg.num_inliers = static_cast<std::uint32_t>(verdict.num_inliers);
  msg.median_error_px = verdict.median_error_px;
  msg.decode_s = verdict.seconds.decode_s;
  msg.features_s = verdict.seconds.features_s;
  msg.retrieval_s = verdict.seconds.retrieval_s;
  msg.matching_s = verdict.seconds.matching_s;
  msg.pose_s = verdict.seconds.pose_s;
  msg.verdict_s = verdict.seconds.verdict_s;
  return msg;
}

std::optional<PhotoVerdict> FromVerdictMsg(const plumbline::PhotoVerdict& msg) {
  if (!IsSound(msg)) return std::nullopt;
  PhotoVerdict verdict;
  try {
    verdict.status = VerdictStatusFromString(msg.status);
    verdict.reason = RefusalReasonFromString(msg.reason);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  verdict.photo = PhotoId{msg.sequence};
  verdict.name = msg.name;
  verdict.attempt = static_cast<int>(msg.attempt);
  verdict.hint = msg.hint;
  verdict.num_matches = static_cast<int>(msg.num_matches);
  verdict.num_inliers = static_cast<int>(msg.num_inliers);
  verdict.median_error_px = msg.median_error_px;
  verdict.seconds.decode_s = msg.decode_s;
  verdict.seconds.features_s = msg.features_s;
  verdict.seconds.retrieval_s = msg.retrieval_s;
  verdict.seconds.matching_s = msg.matching_s;
  verdict.seconds.pose_s = msg.pose_s;
  verdict.seconds.verdict_s = msg.verdict_s;
  return verdict;
}

}  // namespace plumb::ros_adapter
