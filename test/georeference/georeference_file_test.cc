// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/georeference_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "test/georeference/survey_scene.h"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::HasSubstr;

class GeoreferenceFileTest : public testing::Test {
 protected:
  ~GeoreferenceFileTest() override { std::filesystem::remove(path_); }

  StoredGeoreference WriteAndRead(const Json& json) {
    WriteFileAtomically(path_, json.dump(2));
    return ReadGeoreference(path_);
  }

  std::string ErrorOf(const Json& json) {
    try {
      WriteAndRead(json);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  std::string path_ = testing::TempDir() + "georeference_file_test.json";
};

Georeference MakeGeoreference() {
  Georeferencer georeferencer = test::MakeGeoreferencer(test::MakeSurveyScene());
  return georeferencer.Update();
}

TEST_F(GeoreferenceFileTest, ReadsBackToTheLastBit) {
  const Georeference georeference = MakeGeoreference();
  const StoredGeoreference stored = WriteAndRead(ToJson(georeference));
  EXPECT_FALSE(stored.is_coarse);
  EXPECT_EQ(stored.map_sequence, georeference.map_sequence);
  EXPECT_EQ(stored.enu_from_map.scale, georeference.enu_from_map.scale);
  EXPECT_EQ(stored.enu_from_map.rotation.coeffs(), georeference.enu_from_map.rotation.coeffs());
  EXPECT_EQ(stored.enu_from_map.translation, georeference.enu_from_map.translation);
  EXPECT_EQ(stored.frame.crs(), kLocalCrs);
}

TEST_F(GeoreferenceFileTest, SaysWhatIsKnownAndNullForWhatIsNot) {
  Json json = ToJson(MakeGeoreference());
  EXPECT_EQ(json["source"], "targets");
  EXPECT_EQ(json["coarse"], false);
  EXPECT_TRUE(json["earth_from_map"].is_null());
  EXPECT_TRUE(json["gps"].is_null());
  EXPECT_EQ(json["control"]["count"], 12);
  ASSERT_EQ(json["targets"].size(), 17U);
  const Json& target = json["targets"][2];
  EXPECT_EQ(target["role"], "check");
  EXPECT_EQ(target["state"], "good");
  EXPECT_GT(target["error_mm"].get<double>(), 0.0);
  EXPECT_GT(target["sigma_mm"].get<double>(), 1.0);
  const Json nothing = ToJson(Georeference());
  EXPECT_EQ(nothing["source"], "none");
  EXPECT_TRUE(nothing["enu_from_map"].is_null());
  EXPECT_TRUE(nothing["control"].is_null());
}

TEST_F(GeoreferenceFileTest, NamesFaultAndCure) {
  Json json = ToJson(MakeGeoreference());
  Json bad = json;
  bad["enu_from_map"]["scale"] = -1.0;
  EXPECT_THAT(ErrorOf(bad),
              AllOf(HasSubstr(path_),
                    HasSubstr("no similarity"),
                    HasSubstr("run plumbline georeference again")));
  bad = json;
  bad["frame"]["crs"] = "EPSG:99999";
  EXPECT_THAT(ErrorOf(bad), HasSubstr("EPSG:99999"));
  bad = json;
  bad.erase("map_sequence");
  EXPECT_THAT(ErrorOf(bad), HasSubstr("map_sequence"));
  bad = json;
  bad["enu_from_map"] = nullptr;
  EXPECT_THAT(ErrorOf(bad), HasSubstr("is no georeference"));
  EXPECT_THAT(ErrorOf("text"), HasSubstr("is no georeference"));
  EXPECT_THROW(ReadGeoreference(path_ + ".missing"), std::runtime_error);
}

}  // namespace
}  // namespace plumb
