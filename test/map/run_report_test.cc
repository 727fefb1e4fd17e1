// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "test/map/session_fixture.h"

namespace plumb {
namespace {

using RunReportTest = SessionTest;

PhotoVerdict MakeVerdict(std::uint32_t photo, int attempt, VerdictStatus status) {
  PhotoVerdict verdict;
  verdict.photo = {photo};
  verdict.name = "photo" + std::to_string(photo) + ".jpg";
  verdict.attempt = attempt;
  verdict.status = status;
  return verdict;
}

TEST_F(RunReportTest, SaysOfEachPhotoItsLatestVerdictAndEveryAttempt) {
  RunReport report;
  PhotoVerdict refused = MakeVerdict(0, 1, VerdictStatus::kRefused);
  refused.reason = RefusalReason::kNoOverlap;
  refused.hint = "fly closer";
  refused.num_matches = 12;
  report.verdicts = {refused,
                     MakeVerdict(1, 1, VerdictStatus::kWaiting),
                     MakeVerdict(0, 2, VerdictStatus::kAccepted)};
  report.verdicts[2].num_inliers = 345;
  report.verdicts[2].seconds.verdict_s = 0.25;
  report.wall_s = 12.5;
  report.turns[{1}] = {0.5, 0.75};
  report.usage = {20.25, 123456789};
  const std::string path = (root_ / "report.json").string();
  WriteRunReport(report, path);

  const auto json = nlohmann::json::parse(std::ifstream(path));
  EXPECT_EQ(json["run"]["wall_s"], 12.5);
  EXPECT_EQ(json["run"]["cpu_s"], 20.25);
  EXPECT_EQ(json["run"]["peak_memory_bytes"], 123456789);
  EXPECT_EQ(json["session"]["photos"], 2);
  EXPECT_EQ(json["session"]["accepted"], 1);
  EXPECT_EQ(json["session"]["waiting"], 1);
  EXPECT_EQ(json["session"]["refused"], 0);
  ASSERT_EQ(json["photos"].size(), 2u);
  const auto& photo = json["photos"][0];
  EXPECT_EQ(photo["name"], "photo0.jpg");
  EXPECT_EQ(photo["verdict"], "accepted");
  EXPECT_EQ(photo["inliers"], 345);
  EXPECT_EQ(photo["seconds"]["verdict_s"], 0.25);
  ASSERT_EQ(photo["attempts"].size(), 2u);
  EXPECT_EQ(photo["attempts"][0]["verdict"], "refused");
  EXPECT_EQ(photo["attempts"][0]["reason"], "no_overlap");
  EXPECT_EQ(photo["attempts"][0]["hint"], "fly closer");
  EXPECT_EQ(photo["attempts"][0]["matches"], 12);
  EXPECT_FALSE(photo.contains("turn"));  // Of an earlier run.
  EXPECT_EQ(json["photos"][1]["turn"]["wall_s"], 0.5);
  EXPECT_EQ(json["photos"][1]["turn"]["cpu_s"], 0.75);
}

TEST_F(RunReportTest, AFileNameThatIsNoUtf8DoesNotCostTheReport) {
  RunReport report;
  report.verdicts = {MakeVerdict(0, 1, VerdictStatus::kAccepted)};
  report.verdicts[0].name =
      "Stra\xdf"
      "e.jpg";
  const std::string path = (root_ / "report.json").string();
  WriteRunReport(report, path);
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(path))["photos"].size(), 1u);
}

struct Inner {
  double width_px = 0.5;
};
template <typename Visitor>
void VisitFields(Inner& options, Visitor&& visit) {
  visit("width_px", options.width_px);
}
struct Outer {
  Inner inner;
  std::string path = "a";
  bool on = true;
  int count = 3;
};
template <typename Visitor>
void VisitFields(Outer& options, Visitor&& visit) {
  visit("inner", options.inner);
  visit("path", options.path);
  visit("on", options.on);
  visit("count", options.count);
}

TEST(OptionsToJson, NestsStructsAndKeepsTypes) {
  EXPECT_EQ(OptionsToJson(Outer()).dump(),
            R"({"inner":{"width_px":0.5},"path":"a","on":true,"count":3})");
}

TEST(CurrentProcessUsage, CountsTheWorkAndTheMemoryOfThisProcess) {
  const ProcessUsage before = CurrentProcessUsage();
  std::vector<char> ballast(static_cast<std::size_t>(before.peak_memory_bytes) + (64 << 20), 'x');
  EXPECT_EQ(ballast[ballast.size() / 2], 'x');
  const ProcessUsage after = CurrentProcessUsage();
  EXPECT_GE(after.cpu_s, before.cpu_s);
  EXPECT_GE(after.peak_memory_bytes, before.peak_memory_bytes + (64 << 20));
}

}  // namespace
}  // namespace plumb
