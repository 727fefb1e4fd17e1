// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace plumb {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string ErrorOf(const std::string& text, const SurveyReading& reading = {}) {
  try {
    ParseSurvey(text, "points.csv", reading);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

// Three points in Graz, easting first.
constexpr char kGraz[] =
    "# crs: EPSG:31256\n# heights: orthometric\nid,x_m,y_m,z_m,sigma_m,role\n"
    "7,-68112.250,212345.500,361.125,0.002,control\n"
    "3,-68100.000,212345.000,362.000,0.002,check\n"
    "12,-68090.000,212350.000,370.000,0.003,\n";

TEST(ParseSurvey, ReadsColumnsByTheirNames) {
  const Survey survey = ParseSurvey(kGraz, "points.csv");
  EXPECT_EQ(survey.source, "points.csv");
  EXPECT_EQ(survey.crs, "EPSG:31256");
  EXPECT_EQ(survey.heights, HeightReference::kOrthometric);
  ASSERT_EQ(survey.targets.size(), 3U);
  EXPECT_EQ(survey.targets[0].id, 3);  // By id.
  EXPECT_TRUE(survey.targets[0].is_check);
  EXPECT_EQ(survey.targets[1].id, 7);
  EXPECT_EQ(survey.targets[1].line, 4);
  EXPECT_EQ(survey.targets[1].point_in_crs, Eigen::Vector3d(-68112.250, 212345.500, 361.125));
  EXPECT_EQ(survey.targets[1].sigma_m, 0.002);
  EXPECT_FALSE(survey.targets[1].is_check);
  EXPECT_FALSE(survey.targets[2].is_check);

  const Survey turned = ParseSurvey("role,z_m,y_m,x_m,id\ncheck,3,2,1,5\n", "points.csv");
  EXPECT_EQ(turned.targets[0].point_in_crs, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(turned.targets[0].sigma_m, SurveyReading().default_sigma_m);
  EXPECT_TRUE(turned.targets[0].is_check);
}

TEST(ParseSurvey, TakesWhatSpreadsheetsMakeOfCsv) {
  const Eigen::Vector3d point(1.5, -2.25, 3.0);
  for (const char* text :
       {"4,1.5,-2.25,3\n",
        "4,1.5,-2.25,3",
        "\xEF\xBB\xBFid,x_m,y_m,z_m\r\n4,1.5,-2.25,3\r\n",
        "\xEF\xBB\xBFid;x_m;y_m;z_m\r\n4;1,5;-2,25;3\r\n",
        "ID\tX_m\tY_m\tZ_m\n4\t1.5\t-2.25\t3\n",
        "id, x_m, y_m, z_m\n\n 4 , +1.5 , -2.25 , 3.0e0 \n\n",
        "\"id\",\"x_m\",\"y_m\",\"z_m\"\n\"4\",\"1.5\",\"-2.25\",\"3\"\n",
        "# crs: LOCAL;;;\n#\n# measured by hand\nid;x_m;y_m;z_m\n4;1.5;-2.25;3\n"}) {
    const Survey survey = ParseSurvey(text, "points.csv");
    ASSERT_EQ(survey.targets.size(), 1U) << text;
    EXPECT_EQ(survey.targets[0].id, 4) << text;
    EXPECT_EQ(survey.targets[0].point_in_crs, point) << text;
    EXPECT_EQ(survey.crs, kLocalCrs) << text;
    EXPECT_EQ(survey.heights, HeightReference::kLocal) << text;
  }
}

TEST(ParseSurvey, TheCallerKnowsBetter) {
  SurveyReading reading;
  reading.crs = "EPSG:31256";
  reading.heights = "ellipsoidal";
  reading.default_sigma_m = 0.02;
  const Survey survey = ParseSurvey("1,-68112,212345,361\n", "points.csv", reading);
  EXPECT_EQ(survey.crs, "EPSG:31256");
  EXPECT_EQ(survey.heights, HeightReference::kEllipsoidal);
  EXPECT_EQ(survey.targets[0].sigma_m, 0.02);
  reading.crs = "local";
  EXPECT_EQ(ParseSurvey(kGraz, "points.csv", reading).crs, kLocalCrs);
}

TEST(ParseSurvey, SaysWhatHeightsAre) {
  const auto heights = [](const std::string& crs) {
    return ParseSurvey("# crs: " + crs + "\n1,-68112,212345,361\n", "points.csv").heights;
  };
  EXPECT_EQ(heights("EPSG:31256"), HeightReference::kUnstated);
  EXPECT_EQ(heights("EPSG:31256+5778"), HeightReference::kOrthometric);
  EXPECT_EQ(ParseSurvey("# crs: EPSG:4979\nid,lon_deg,lat_deg,z_m\n1,15.4,47.1,400\n", "p").heights,
            HeightReference::kEllipsoidal);
  EXPECT_THAT(ErrorOf("# crs: EPSG:31256+5778\n# heights: ellipsoidal\n1,-68112,212345,361\n"),
              HasSubstr("correct one of them"));
  EXPECT_THAT(ErrorOf("# heights: barometric\n1,2,3,4\n"),
              AllOf(HasSubstr("line 1"), HasSubstr("ellipsoidal or orthometric")));
}

TEST(ParseSurvey, NamesLineAndCureOfABadLine) {
  const std::string header = "id,x_m,y_m,z_m,sigma_m,role\n";
  EXPECT_THAT(
      ErrorOf(header + "1,2,3,4\n2,abc,3,4\n"),
      AllOf(HasSubstr("points.csv: line 3: x_m \"abc\" is not a number"), HasSubstr("1234.567")));
  EXPECT_THAT(ErrorOf("1,2,3,4\n2,nan,3,4\n"), HasSubstr("line 2: x_m \"nan\""));
  EXPECT_THAT(ErrorOf("1,2,inf,4\n"), HasSubstr("line 1: y_m \"inf\""));
  EXPECT_THAT(ErrorOf("1;2;3;1.234,5\n"), HasSubstr("line 1: z_m \"1.234,5\""));
  EXPECT_THAT(ErrorOf("1,2,3,4 m\n"), HasSubstr("without units"));
  EXPECT_THAT(ErrorOf(header + "1,2,,4\n"), HasSubstr("line 2: y_m is empty"));
  EXPECT_THAT(ErrorOf("1,2,3\n"),
              AllOf(HasSubstr("line 1: has 3 fields"), HasSubstr("three coordinates")));
  EXPECT_THAT(ErrorOf("1 2 3 4\n"), HasSubstr("separated by commas, semicolons or tabulators"));
  EXPECT_THAT(ErrorOf(header + "1,2,3,4,-0.1\n"), HasSubstr("line 2: sigma_m is negative"));
  EXPECT_THAT(ErrorOf(header + "1,2,3,4,0.1,contol\n"),
              HasSubstr("line 2: role \"contol\" is neither control nor check"));
}

TEST(ParseSurvey, TellsOfDecimalCommasAmongCommas) {
  EXPECT_THAT(ErrorOf("id,x_m,y_m,z_m,sigma_m,role\n1,1,250,2,500,3,750,0,001,control\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("10 fields"), HasSubstr("semicolons")));
}

TEST(ParseSurvey, RefusesSigmasInMillimetres) {
  const std::string header = "id,x_m,y_m,z_m,sigma_m\n1,2,3,4,0.5\n";
  EXPECT_EQ(ErrorOf(header), "no error");
  EXPECT_THAT(ErrorOf(header + "2,2,3,5,3\n"),
              AllOf(HasSubstr("points.csv: line 3: sigma_m 3 is no standard deviation"),
                    HasSubstr("counts in metres, 0.003 for 3 mm"),
                    HasSubstr("convert the column")));
  EXPECT_THAT(ErrorOf("id;x_m;y_m;z_m;sigma_m\n1;2;3;4;0,6\n"),
              HasSubstr("line 2: sigma_m 0,6 is no"));
}

TEST(ParseSurvey, NamesBadColumns) {
  EXPECT_THAT(ErrorOf("id,x_ft,y_ft,z_ft\n1,2,3,4\n"),
              AllOf(HasSubstr("line 1: column \"x_ft\" is unknown"), HasSubstr("metres")));
  EXPECT_THAT(ErrorOf("id,x_m,y_m\n1,2,3,4\n"), HasSubstr("z_m, sigma_m and role is missing"));
  EXPECT_THAT(ErrorOf("id,x_m,x_m,y_m,z_m\n1,2,3,4,5\n"), HasSubstr("there twice"));
}

TEST(ParseSurvey, NamesUnknownAndRepeatedIds) {
  for (const char* id : {"-1", "106", "P7", "1.5", "99999999999"}) {
    EXPECT_THAT(ErrorOf("0,1,2,3\n" + std::string(id) + ",2,3,4\n").substr(0, 60),
                testing::StartsWith("points.csv: line "))
        << id;
    EXPECT_THAT(ErrorOf("0,1,2,3\n" + std::string(id) + ",2,3,4\n"),
                AllOf(HasSubstr("line 2: no marker has the id \"" + std::string(id) + '"'),
                      HasSubstr("0 to 105")));
  }
  EXPECT_THAT(ErrorOf("5,1,2,3\n6,2,3,4\n5,3,4,5\n"),
              AllOf(HasSubstr("line 3: id 5 stands in line 1 already"), HasSubstr("remove one")));
  EXPECT_THAT(ErrorOf("5,1,2,3\n6,2,3,4\n7,1,2,3\n"),
              AllOf(HasSubstr("line 3: ids 5 and 7 have one place"), HasSubstr("lines 1 and 3")));
}

TEST(ParseSurvey, RefusesWhatHoldsNoPoints) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("points.csv: is empty"));
  EXPECT_THAT(ErrorOf("\xEF\xBB\xBF\r\n \r\n"), HasSubstr("is empty"));
  EXPECT_THAT(ErrorOf("id,x_m,y_m,z_m\n"), HasSubstr("holds no point"));
  EXPECT_THAT(ErrorOf("# crs: EPSG:31256\n"), HasSubstr("holds no point"));
  EXPECT_THAT(ErrorOf(std::string("\xFF\xFEi\0d\0", 6)), HasSubstr("UTF-16; save it as"));
  EXPECT_THAT(ErrorOf(std::string("PK\0\0", 4)), HasSubstr("is no text file"));
}

TEST(ParseSurvey, NamesAnUnusableCrs) {
  const std::string point = "\n1,-68112,212345,361\n";
  EXPECT_THAT(ErrorOf("# crs: EPSG:99999" + point),
              AllOf(HasSubstr("\"EPSG:99999\" is no coordinate reference system"),
                    HasSubstr("give its EPSG code")));
  EXPECT_THAT(ErrorOf("# crs: Gauss-Krueger" + point), HasSubstr("\"Gauss-Krueger\" is no"));
  EXPECT_THAT(ErrorOf("# crs: EPSG:5778" + point), HasSubstr("give a projected CRS"));
  EXPECT_THAT(ErrorOf("# crs: EPSG:4978" + point), HasSubstr("give a projected CRS"));
  EXPECT_THAT(ErrorOf("# crs: EPSG:2263" + point),
              AllOf(HasSubstr("US survey foot"), HasSubstr("convert the points")));
  EXPECT_THAT(ErrorOf("# crs: EPSG:4326\nid,x_m,y_m,z_m" + point),
              HasSubstr("name the columns lon_deg and lat_deg"));
  EXPECT_THAT(ErrorOf("# crs: EPSG:31256\nid,lon_deg,lat_deg,z_m" + point),
              HasSubstr("name the columns x_m and y_m"));
  EXPECT_THAT(ErrorOf("id,lon_deg,lat_deg,z_m" + point), HasSubstr("need a geographic CRS"));
}

TEST(ParseSurvey, NoticesExchangedAxesByTheAreaOfTheCrs) {
  EXPECT_THAT(ErrorOf("# crs: EPSG:31256\n1,212345,-68112,361\n2,212350,-68100,362\n"),
              AllOf(HasSubstr("line 2: id 1 lies outside of \"EPSG:31256\""),
                    HasSubstr("exchange them, east comes first")));
  EXPECT_THAT(ErrorOf("# crs: EPSG:32633\n1,5212345,532112,361\n"), HasSubstr("exchange them"));
  // One point's typing error is not an exchange.
  const std::string error =
      ErrorOf("# crs: EPSG:31256\n1,-68112,212345,361\n2,-68112,2123450,361\n");
  EXPECT_THAT(error, AllOf(HasSubstr("line 3: id 2 lies outside"), HasSubstr("correct the point")));
  EXPECT_THAT(error, testing::Not(HasSubstr("exchange")));
}

TEST(ParseSurvey, TakesCodesAndStringsAsOthersWriteThem) {
  for (const char* crs : {"31256", "epsg:31256", "31256+5778"}) {
    EXPECT_EQ(ErrorOf("# crs: " + std::string(crs) + "\n1,-68112,212345,361\n"), "no error") << crs;
  }
  for (const char* crs : {"WGS84 UTM 33N",
                          "WGS 84 / UTM zone 33N",
                          "+proj=utm +zone=33 +datum=WGS84 +units=m +no_defs"}) {
    EXPECT_EQ(ErrorOf("# crs: " + std::string(crs) + "\n1,532112,5212345,361\n"), "no error")
        << crs;
  }
}

}  // namespace
}  // namespace plumb
