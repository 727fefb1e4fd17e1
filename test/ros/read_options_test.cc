// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/read_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ros/camera_ingest_options.h"
#include "ros/georeferencer_ros_options.h"
#include "ros/mapper_ros_options.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using XmlRpc::XmlRpcValue;

template <typename Options>
std::vector<std::string> Read(const XmlRpcValue& tree, Options* options) {
  std::vector<std::string> problems;
  OptionReader reader(tree, "", &problems);
  VisitFields(*options, reader);
  reader.RefuseUnknown();
  return problems;
}

TEST(OptionReader, SetsWhatIsGivenAndLeavesTheRest) {
  XmlRpcValue tree;
  tree["max_in_flight"] = 7;
  tree["resend_after_s"] = 3;  // A whole number is a fine double.
  tree["camera_file"] = "/c.yaml";
  CameraIngestOptions options;
  EXPECT_THAT(Read(tree, &options), IsEmpty());
  EXPECT_EQ(options.max_in_flight, 7);
  EXPECT_EQ(options.resend_after_s, 3.0);
  EXPECT_EQ(options.camera_file, "/c.yaml");
  EXPECT_EQ(options.untouched_for_s, CameraIngestOptions().untouched_for_s);
}

TEST(OptionReader, RefusesAFractionForAnInteger) {
  XmlRpcValue tree;
  tree["max_in_flight"] = 30.7;
  CameraIngestOptions options;
  EXPECT_THAT(Read(tree, &options),
              ElementsAre(AllOf(HasSubstr("max_in_flight"), HasSubstr("30.7"))));
}

TEST(OptionReader, RefusesOtherTypes) {
  CameraIngestOptions options;
  XmlRpcValue tree;
  tree["max_in_flight"] = true;
  EXPECT_EQ(Read(tree, &options).size(), 1U);
  tree["max_in_flight"] = "4";
  EXPECT_EQ(Read(tree, &options).size(), 1U);
  tree = XmlRpcValue();
  tree["camera_file"] = 12;
  EXPECT_EQ(Read(tree, &options).size(), 1U);
}

TEST(OptionReader, RefusesUnknownNamesAtEachLevelWithTheirPath) {
  XmlRpcValue tree;
  tree["sesion_folder"] = "/s";
  tree["mapper"]["localizer"]["min_inliers"] = 3;
  MapperRosOptions options;
  EXPECT_THAT(Read(tree, &options),
              ElementsAre(HasSubstr("mapper/localizer/min_inliers is unknown"),
                          HasSubstr("sesion_folder is unknown")));
}

TEST(OptionReader, ReadsNestedGroups) {
  XmlRpcValue tree;
  tree["mapper"]["features"]["max_features"] = 1234;
  tree["mapper"]["deterministic"] = true;
  MapperRosOptions options;
  EXPECT_THAT(Read(tree, &options), IsEmpty());
  EXPECT_EQ(options.mapper.features.max_features, 1234);
  EXPECT_TRUE(options.mapper.deterministic);
}

TEST(OptionReader, RefusesAValueWhereAGroupBelongs) {
  XmlRpcValue tree;
  tree["mapper"] = 3;
  MapperRosOptions options;
  EXPECT_THAT(Read(tree, &options), ElementsAre(HasSubstr("mapper must be a group")));
}

TEST(CameraIngestOptions, DefaultsNeedOnlyFolderSessionAndCamera) {
  CameraIngestOptions options;
  EXPECT_FALSE(options.Problems().empty());
  options.photos_folder = "/photos";
  options.session_folder = "/session";
  EXPECT_THAT(options.Problems(), ElementsAre(HasSubstr("camera_file")));
  options.camera_file = "/camera.yaml";
  EXPECT_THAT(options.Problems(), IsEmpty());
  options.max_in_flight = 0;
  EXPECT_THAT(options.Problems(), ElementsAre(AllOf(HasSubstr("max_in_flight"), HasSubstr("0"))));
}

TEST(CameraIngestOptions, ATopicMayBringItsOwnCameraInfo) {
  CameraIngestOptions options;
  options.session_folder = "/session";
  options.image_topic = "image_raw";
  EXPECT_THAT(options.Problems(), IsEmpty());
}

TEST(CameraIngestOptions, RelativePathsAreRefusedWithWhatTheyWereMeantToBe) {
  setenv("PLUMBLINE_CALLED_FROM", "/home/pilot", 1);
  CameraIngestOptions options;
  options.photos_folder = "card";
  options.session_folder = "flights/12";
  options.camera_file = "../camera.yaml";
  EXPECT_THAT(options.Problems(),
              ElementsAre(AllOf(HasSubstr("session_folder"), HasSubstr("/home/pilot/flights/12")),
                          AllOf(HasSubstr("photos_folder"), HasSubstr("/home/pilot/card")),
                          AllOf(HasSubstr("camera_file"), HasSubstr("/home/camera.yaml"))));
}

TEST(CameraIngestOptions, PhotosMustNotLieInTheSession) {
  CameraIngestOptions options;
  options.session_folder = "/flights/12";
  options.camera_file = "/camera.yaml";
  for (const char* folder : {"/flights/12", "/flights/12/photos/", "/flights/11/../12"}) {
    options.photos_folder = folder;
    EXPECT_THAT(options.Problems(), ElementsAre(HasSubstr("outside the session"))) << folder;
  }
  options.photos_folder = "/flights/123";
  EXPECT_THAT(options.Problems(), IsEmpty());
}

TEST(MapperRosOptions, ARelativeSessionIsRefused) {
  MapperRosOptions options;
  options.session_folder = "flights/12";
  EXPECT_THAT(options.Problems(), ElementsAre(HasSubstr("absolute path")));
}

TEST(MapperRosOptions, DefaultsNeedOnlyASession) {
  MapperRosOptions options;
  EXPECT_THAT(options.Problems(), ElementsAre(HasSubstr("session_folder")));
  options.session_folder = "/session";
  EXPECT_THAT(options.Problems(), IsEmpty());
  EXPECT_FALSE(options.mapper.deterministic);
}

TEST(MapperRosOptions, NamesProblemsOfNestedOptionsByTheirPath) {
  MapperRosOptions options;
  options.session_folder = "/session";
  options.mapper.max_retries_per_photo = -1;
  options.mapper.features.min_contrast = -1.0;
  EXPECT_THAT(options.Problems(),
              UnorderedElementsAre(HasSubstr("mapper.features.min_contrast"),
                                   HasSubstr("mapper.max_retries_per_photo")));
}

TEST(GeoreferencerRosOptions, DefaultsNeedNothing) {
  EXPECT_THAT(GeoreferencerRosOptions().Problems(), IsEmpty());
}

TEST(GeoreferencerRosOptions, NamesWhatIsWrong) {
  setenv("PLUMBLINE_CALLED_FROM", "/home/pilot", 1);
  GeoreferencerRosOptions options;
  options.survey_file = "survey.csv";
  options.survey_heights = "mean sea level";
  options.enu_frame_id = "map";
  options.earth_frame_id = "map";
  options.residual_magnification = 0.0;
  options.georeferencer.max_error_px = 0.0;
  EXPECT_THAT(options.Problems(),
              ElementsAre(AllOf(HasSubstr("survey_file"), HasSubstr("/home/pilot/survey.csv")),
                          HasSubstr("survey_heights"),
                          HasSubstr("enu_frame_id"),
                          HasSubstr("earth_frame_id"),
                          HasSubstr("residual_magnification"),
                          HasSubstr("georeferencer.max_error_px")));
}

}  // namespace
}  // namespace plumb::ros_adapter
