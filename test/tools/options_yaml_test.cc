// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options_yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "plumbline/map/run_report.h"
#include "plumbline/sfm/mapper_options.h"
#include "plumbline/surface/surface_options.h"

namespace plumb::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;

MapperOptions Read(const std::string& text) {
  MapperOptions options;
  ReadValue(ParseYaml(text, "file.yaml"), {"file.yaml", ""}, &options);
  return options;
}

std::string ErrorOf(const std::string& text) {
  try {
    Read(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(ReadOptions, SetsWhatIsGivenAndKeepsTheRest) {
  const MapperOptions options = Read(
      "localizer: {min_num_inliers: 17, max_error_px: 3}\n"
      "retrieval:\n  vocabulary_path: \"12\"\n"
      "deterministic: false\n"
      "matcher:\n");
  EXPECT_EQ(options.localizer.min_num_inliers, 17);
  EXPECT_EQ(options.localizer.max_error_px, 3.0);
  EXPECT_EQ(options.retrieval.vocabulary_path, "12");
  EXPECT_FALSE(options.deterministic);
  EXPECT_EQ(options.localizer.num_views, LocalizerOptions().num_views);
  EXPECT_EQ(OptionsToJson(Read("")), OptionsToJson(MapperOptions()));
}

TEST(ReadOptions, EveryFieldReadsBackFromItsReport) {
  MapperOptions options;
  options.localizer.max_error_px = 1.0 / 3.0;
  options.bundle.refine_distortion = true;
  const std::string json = OptionsToJson(options).dump();  // JSON is YAML.
  EXPECT_EQ(OptionsToJson(Read(json)).dump(), json);
}

TEST(ReadOptions, NamesFileFieldAndCureOfWhatIsWrong) {
  EXPECT_THAT(ErrorOf("localizer: {min_num_inliers: 3.5}"),
              AllOf(HasSubstr("file.yaml: localizer.min_num_inliers: must be a whole number"),
                    HasSubstr("\"3.5\"")));
  EXPECT_THAT(ErrorOf("localizer: {min_num_inliers: '30'}"), HasSubstr("a whole number"));
  EXPECT_THAT(ErrorOf("localizer: {max_error_px: [1]}"), HasSubstr("a number"));
  EXPECT_THAT(ErrorOf("deterministic: 1"), HasSubstr("true or false"));
  EXPECT_THAT(ErrorOf("localizer: 3"), HasSubstr("file.yaml: localizer: must be a map"));
  EXPECT_THAT(ErrorOf("localizer: {min_inliers: 3}"),
              AllOf(HasSubstr("file.yaml: localizer: unknown option \"min_inliers\""),
                    HasSubstr("min_num_inliers")));
  EXPECT_THAT(ErrorOf("mapper: {}"), HasSubstr("unknown option \"mapper\""));
  EXPECT_THAT(ErrorOf("deterministic: true\ndeterministic: false"), HasSubstr("twice"));
  EXPECT_THAT(ErrorOf("a: b: c"), HasSubstr("file.yaml: line 1: is no YAML"));
  EXPECT_THAT(ErrorOf("- 1"), HasSubstr("must be a map"));
}

TEST(ParseSetting, SetsANestedField) {
  MapperOptions options;
  ReadValue(ParseSetting("localizer.max_error_px=2.5"), {"--set", ""}, &options);
  ReadValue(ParseSetting("max_retries_per_photo=7"), {"--set", ""}, &options);
  EXPECT_EQ(options.localizer.max_error_px, 2.5);
  EXPECT_EQ(options.max_retries_per_photo, 7);
  EXPECT_THROW(ParseSetting("localizer"), std::runtime_error);
  EXPECT_THROW(ParseSetting("=3"), std::runtime_error);
  EXPECT_THROW(ReadValue(ParseSetting("localizer.=3"), {"--set", ""}, &options),
               std::runtime_error);
}

TEST(ParseSetting, TakesNamesAsRosWritesThem) {
  for (const char* name : {"localizer/max_error_px",
                           "mapper/localizer/max_error_px",
                           "~mapper/localizer/max_error_px",
                           "/plumbline/mapper/mapper/localizer/max_error_px"}) {
    MapperOptions options;
    ReadValue(ParseSetting(std::string(name) + "=2.5"), {"--set", ""}, &options);
    EXPECT_EQ(options.localizer.max_error_px, 2.5) << name;
  }
  for (const char* name : {"surface/block_side", "/plumbline/mesher/surface/block_side"}) {
    SurfaceOptions options;
    ReadValue(ParseSetting(std::string(name) + "=2.5"), {"--set", ""}, &options);
    EXPECT_EQ(options.block_side, 2.5) << name;
  }
  MapperOptions options;
  ReadValue(ParseSetting("retrieval/vocabulary_path=/data/tree"), {"--set", ""}, &options);
  EXPECT_EQ(options.retrieval.vocabulary_path, "/data/tree");
}

}  // namespace
}  // namespace plumb::tools
