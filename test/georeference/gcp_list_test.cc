// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "plumbline/georeference/survey.h"

namespace plumb {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr char kList[] =
    "WGS84 UTM 33N\r\n"
    "# a remark\r\n"
    "532112.25 5212345.5 361.125 1021.5 877.25 a.jpg 7\r\n"
    "532112.25\t5212345.5\t361.125\t1100 800 b.jpg 7 more\r\n"
    "532120 5212346 362 10 20 a.jpg gcp01\r\n"
    "532130 5212347 363 30 40 a.jpg\r\n"
    "532130 5212347 363 50 60 b.jpg\r\n";

std::string ErrorOf(const std::string& text) {
  try {
    ParseSurvey(text, "gcp_list.txt");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(GcpList, ReadsPointsAndWhereAHandSawThem) {
  const Survey survey = ParseSurvey(kList, "gcp_list.txt");
  EXPECT_EQ(survey.crs, "WGS84 UTM 33N");
  EXPECT_EQ(survey.heights, HeightReference::kUnstated);
  ASSERT_EQ(survey.targets.size(), 3U);
  EXPECT_EQ(survey.targets[0].id, 7);
  EXPECT_EQ(survey.targets[0].point_in_crs, Eigen::Vector3d(532112.25, 5212345.5, 361.125));
  // Those whose name is no marker's have ids that no marker has.
  EXPECT_EQ(survey.targets[1].name, "gcp01");
  EXPECT_GE(survey.targets[1].id, 106);
  EXPECT_NE(survey.targets[1].id, survey.targets[2].id);
  ASSERT_EQ(survey.pointed.size(), 5U);
  EXPECT_EQ(survey.pointed[1].id, 7);
  EXPECT_EQ(survey.pointed[1].photo, "b.jpg");
  EXPECT_EQ(survey.pointed[0].pixel, Eigen::Vector2d(1021.5, 877.25));
  EXPECT_EQ(survey.pointed[3].id, survey.targets[2].id);
  EXPECT_EQ(survey.pointed[4].id, survey.targets[2].id);
}

TEST(GcpList, WritesWhatItReads) {
  const Survey survey = ParseSurvey(kList, "gcp_list.txt");
  const std::string text = ToGcpList(survey, survey.pointed);
  const Survey again = ParseSurvey(text, "gcp_list.txt");
  EXPECT_EQ(again.crs, survey.crs);
  ASSERT_EQ(again.targets.size(), survey.targets.size());
  for (std::size_t i = 0; i < again.targets.size(); ++i) {
    EXPECT_EQ(again.targets[i].point_in_crs, survey.targets[i].point_in_crs);
  }
  ASSERT_EQ(again.pointed.size(), survey.pointed.size());
  for (std::size_t i = 0; i < again.pointed.size(); ++i) {
    EXPECT_EQ(again.pointed[i].pixel, survey.pointed[i].pixel);
    EXPECT_EQ(again.pointed[i].photo, survey.pointed[i].photo);
  }
}

TEST(GcpList, LeavesCheckPointsOut) {
  Survey survey = ParseSurvey(kList, "gcp_list.txt");
  survey.targets[0].is_check = true;
  EXPECT_THAT(ToGcpList(survey, survey.pointed), testing::Not(HasSubstr("b.jpg 7")));
  survey.crs = kLocalCrs;
  EXPECT_THROW(ToGcpList(survey, {}), std::logic_error);
}

TEST(GcpList, DegreesAreLongitudeFirst) {
  const Survey survey = ParseSurvey("EPSG:4326\n15.44 47.07 400 1 2 a.jpg 3\n", "gcp_list.txt");
  EXPECT_EQ(survey.targets[0].point_in_crs, Eigen::Vector3d(15.44, 47.07, 400.0));
  EXPECT_THAT(ErrorOf("EPSG:4326\n47.07 105.44 400 1 2 a.jpg 3\n"), HasSubstr("exchange them"));
}

TEST(GcpList, NamesLineAndCureOfABadLine) {
  EXPECT_THAT(ErrorOf("EPSG:32633\n532112 5212345 361 10 20\n"),
              AllOf(HasSubstr("gcp_list.txt: line 2: has 5 fields"), HasSubstr("geo_x geo_y")));
  EXPECT_THAT(ErrorOf("EPSG:32633\n532112 5212345 NaN 10 20 a.jpg\n"),
              HasSubstr("line 2: geo_z \"NaN\" is not a number"));
  EXPECT_THAT(ErrorOf("EPSG:32633\n532112 5212345 361 10 20 a.jpg 7\n"
                      "532112 5212346 361 10 20 b.jpg 7\n"),
              HasSubstr("line 3: point 7 has another place than in line 2"));
  EXPECT_THAT(ErrorOf("EPSG:32633\n"), HasSubstr("holds no point"));
  EXPECT_THAT(ErrorOf("EPSG:99999\n1 2 3 4 5 a.jpg\n"), HasSubstr("\"EPSG:99999\" is no"));
  EXPECT_THAT(ErrorOf("EPSG:32633\n5212345 532112 361 10 20 a.jpg\n"), HasSubstr("exchange them"));
}

}  // namespace
}  // namespace plumb
