// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/stored_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/map/session_fixture.h"

namespace plumb {
namespace {

using StoredSessionTest = SessionTest;

PhotoVerdict MakeVerdict(std::uint32_t photo, VerdictStatus status) {
  PhotoVerdict verdict;
  verdict.photo = {photo};
  verdict.status = status;
  return verdict;
}

TEST_F(StoredSessionTest, TellsAnsweredPhotosFromThoseCutOff) {
  SessionStore store(folder_, MakeCamera());
  for (std::uint32_t i = 0; i < 5; ++i) {
    store.SavePhoto({i}, "photo" + std::to_string(i) + ".jpg", MakeBytes(100, i));
    if (i < 4) store.SaveAnalysis({i}, Timestamp{10 + i}, MakeAnalysis(20, i));
  }
  store.SaveVerdict(MakeVerdict(0, VerdictStatus::kAccepted));
  store.Apply(MakeDelta(1, 0, 10));
  store.SaveVerdict(MakeVerdict(1, VerdictStatus::kRefused));
  store.SaveVerdict(MakeVerdict(2, VerdictStatus::kAccepted));  // Its view did not reach the disk.

  const StoredSession session = ReadStoredSession(store);
  ASSERT_EQ(session.photos.size(), 2u);
  EXPECT_EQ(session.photos[0].id, PhotoId{0});
  EXPECT_EQ(session.photos[0].name, "photo0.jpg");
  EXPECT_EQ(session.photos[0].exposure_time, Timestamp{10});
  EXPECT_EQ(session.photos[0].analysis.features.size(), 20u);
  EXPECT_EQ(session.photos[1].id, PhotoId{1});
  ASSERT_EQ(session.verdicts.size(), 2u);
  EXPECT_EQ(session.verdicts[1].status, VerdictStatus::kRefused);
  EXPECT_EQ(session.snapshot.views_set.size(), 1u);
  std::vector<std::uint32_t> unfinished;
  for (const StoredPhoto& photo : session.unfinished) unfinished.push_back(photo.id.value);
  EXPECT_THAT(unfinished, testing::ElementsAre(2, 3, 4));
}

TEST_F(StoredSessionTest, OfANewSessionIsEmpty) {
  const SessionStore store(folder_, MakeCamera());
  const StoredSession session = ReadStoredSession(store);
  EXPECT_TRUE(session.photos.empty());
  EXPECT_TRUE(session.unfinished.empty());
  EXPECT_EQ(session.snapshot.sequence, 0u);
}

}  // namespace
}  // namespace plumb
