// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/run_report.h"

#include <sys/resource.h>

#include <map>

#include "plumbline/common/atomic_file.h"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Json ToJson(const StageSeconds& seconds) {
  return {{"decode_s", seconds.decode_s},
          {"features_s", seconds.features_s},
          {"retrieval_s", seconds.retrieval_s},
          {"matching_s", seconds.matching_s},
          {"pose_s", seconds.pose_s},
          {"verdict_s", seconds.verdict_s},
          {"expand_s", seconds.expand_s},
          {"bundle_s", seconds.bundle_s}};
}

// What is the same for the latest verdict and for any attempt.
void AddVerdict(const PhotoVerdict& verdict, Json* json) {
  (*json)["attempt"] = verdict.attempt;
  (*json)["verdict"] = ToString(verdict.status);
  (*json)["reason"] = ToString(verdict.reason);
  (*json)["hint"] = verdict.hint;
  (*json)["matches"] = verdict.num_matches;
  (*json)["inliers"] = verdict.num_inliers;
  (*json)["median_error_px"] = verdict.median_error_px;
  (*json)["seconds"] = ToJson(verdict.seconds);
}

// Precondition: at least one verdict, all of one photo.
Json PhotoJson(const std::vector<const PhotoVerdict*>& verdicts) {
  const PhotoVerdict& latest = *verdicts.back();
  Json json = {{"id", latest.photo.value}, {"name", latest.name}};
  AddVerdict(latest, &json);
  json["attempts"] = Json::array();
  for (const PhotoVerdict* verdict : verdicts) {
    Json attempt = Json::object();
    AddVerdict(*verdict, &attempt);
    json["attempts"].push_back(std::move(attempt));
  }
  return json;
}

}  // namespace

ProcessUsage CurrentProcessUsage() {
  rusage usage = {};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr std::int64_t kBytesPerUnit = 1024;  // Of ru_maxrss on Linux.
  return {Seconds(usage.ru_utime) + Seconds(usage.ru_stime), kBytesPerUnit * usage.ru_maxrss};
}

Json ToJson(const RunReport& report) {
  std::map<PhotoId, std::vector<const PhotoVerdict*>> verdicts_of_photo;
  for (const PhotoVerdict& verdict : report.verdicts) {
    verdicts_of_photo[verdict.photo].push_back(&verdict);
  }
  std::map<VerdictStatus, std::size_t> count;
  Json photos = Json::array();
  for (const auto& [photo, verdicts] : verdicts_of_photo) {
    ++count[verdicts.back()->status];
    photos.push_back(PhotoJson(verdicts));
    const auto turn = report.turns.find(photo);
    if (turn == report.turns.end()) continue;
    photos.back()["turn"] = {{"wall_s", turn->second.wall_s}, {"cpu_s", turn->second.cpu_s}};
  }
  return {{"run",
           {{"wall_s", report.wall_s},
            {"cpu_s", report.usage.cpu_s},
            {"peak_memory_bytes", report.usage.peak_memory_bytes},
            {"interrupted", report.interrupted},
            {"unread", report.unread}}},
          {"session",
           {{"photos", photos.size()},
            {"accepted", count[VerdictStatus::kAccepted]},
            {"waiting", count[VerdictStatus::kWaiting]},
            {"refused", count[VerdictStatus::kRefused]},
            {"landmarks", report.num_landmarks},
            {"observations", report.num_observations}}},
          {"photos", std::move(photos)},
          {"options", report.options}};
}

void WriteRunReport(const RunReport& report, const std::string& path) {
  // A file name may hold bytes that are no UTF-8; they must not cost the report.
  WriteFileAtomically(path,
                      ToJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace plumb
