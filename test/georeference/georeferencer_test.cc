// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/georeferencer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "test/georeference/survey_scene.h"

namespace plumb {
namespace {

using test::FindFinding;
using test::MakeGeoreferencer;
using test::MakeSurveyScene;
using test::SurveyScene;
using test::SurveySceneOptions;
using testing::AllOf;
using testing::HasSubstr;

std::vector<int> IdsIn(const Georeference& georeference, TargetState state) {
  std::vector<int> ids;
  for (const TargetReport& target : georeference.targets) {
    if (target.state == state) ids.push_back(target.id);
  }
  return ids;
}

// Largest error of the model's points [mm].
double ModelError_mm(const SurveyScene& scene, const Similarity3& enu_from_map) {
  const Similarity3 truth = scene.map_from_enu.Inverse();
  double largest = 0.0;
  for (const LandmarkState& landmark : scene.map.landmarks_set) {
    const Eigen::Vector3d error =
        enu_from_map * landmark.position_in_map - truth * landmark.position_in_map;
    largest = std::max(largest, 1000.0 * error.norm());
  }
  return largest;
}

TEST(Georeferencer, PutsTheModelWhereTheSurveySays) {
  const SurveyScene scene = MakeSurveyScene();
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Georeference& georeference = georeferencer.Update();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kTargets);
  EXPECT_EQ(georeference.map_sequence, scene.map.sequence);
  EXPECT_EQ(IdsIn(georeference, TargetState::kGood).size(), 17U);
  EXPECT_EQ(georeference.control.count, 12);
  EXPECT_EQ(georeference.check.count, 5);
  // The survey is good to 1 mm, twelve targets fix the model to less than that at its edge.
  EXPECT_LT(ModelError_mm(scene, georeference.enu_from_map), 1.5);
  EXPECT_LT(georeference.control.rms_mm, 3.0);
  EXPECT_LT(georeference.check.rms_mm, 4.0);
  EXPECT_GT(georeference.check.rms_mm, 0.5);
  EXPECT_NEAR(*georeference.marker_diameter_m, 0.5, 0.01);
  EXPECT_FALSE(georeference.earth_from_map);
  EXPECT_FALSE(georeference.gps);
  EXPECT_TRUE(georeference.findings.empty()) << georeference.findings[0].text;
}

TEST(Georeferencer, ResidualsAreAsLargeAsTheirSigmas) {
  double sum = 0.0;
  for (int seed = 1; seed <= 20; ++seed) {
    SurveySceneOptions options;
    options.random_seed = seed;
    const SurveyScene scene = MakeSurveyScene(options);
    Georeferencer georeferencer = MakeGeoreferencer(scene);
    for (const TargetReport& target : georeferencer.Update().targets) {
      if (target.is_check) sum += std::pow(target.residual_m.norm() / target.sigma_m, 2);
    }
  }
  EXPECT_NEAR(sum / 100.0, 1.0, 0.3);
}

TEST(Georeferencer, NamesThreeWrongOfSeventeen) {
  SurveyScene scene = MakeSurveyScene();
  std::swap(scene.survey.targets[3].point_in_crs, scene.survey.targets[10].point_in_crs);
  scene.targets_in_enu[7] += Eigen::Vector3d(0.5, 0.0, 0.0);  // After it was measured.
  TakePhotos({}, &scene);
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Georeference& georeference = georeferencer.Update();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kTargets);
  EXPECT_EQ(IdsIn(georeference, TargetState::kWrong), (std::vector<int>{3, 7, 10}));
  EXPECT_EQ(georeference.control.count, 9);
  EXPECT_LT(ModelError_mm(scene, georeference.enu_from_map), 2.0);
  const Finding* moved = FindFinding(georeference, "wrong_target");
  ASSERT_NE(moved, nullptr);
  EXPECT_THAT(moved->text, AllOf(HasSubstr("target 7 "), HasSubstr("moved")));
  const Finding* exchanged = FindFinding(georeference, "exchanged_targets");
  ASSERT_NE(exchanged, nullptr);
  EXPECT_THAT(exchanged->text, AllOf(HasSubstr("target 3 "), HasSubstr("coordinates of 10")));
}

TEST(Georeferencer, NamesAWrongCheckPoint) {
  SurveyScene scene = MakeSurveyScene();
  ASSERT_TRUE(scene.survey.targets[5].is_check);
  scene.survey.targets[5].point_in_crs.z() += 0.5;
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Georeference& georeference = georeferencer.Update();
  EXPECT_EQ(IdsIn(georeference, TargetState::kWrong), (std::vector<int>{5}));
  EXPECT_EQ(georeference.check.count, 4);
  EXPECT_NEAR(georeference.targets[5].residual_m.z(), -0.5, 0.01);
}

TEST(Georeferencer, GrowsWithTheFlight) {
  const SurveyScene scene = MakeSurveyScene();
  Georeferencer georeferencer({}, scene.camera);
  georeferencer.SetSurvey(scene.survey);
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kNone);
  MapDelta delta;
  delta.landmarks_set = scene.map.landmarks_set;
  bool was_placed = false;
  for (const ViewState& view : scene.map.views_set) {
    ++delta.sequence;
    delta.views_set = {view};
    georeferencer.SetMarkers(view.photo, scene.markers.at(view.photo));
    ASSERT_TRUE(georeferencer.Apply(delta));
    delta.landmarks_set.clear();
    const Georeference& georeference = georeferencer.Update();
    const bool is_placed = georeference.source == GeoreferenceSource::kTargets;
    EXPECT_EQ(georeference.map_sequence, delta.sequence);
    EXPECT_EQ(is_placed,
              FindFinding(georeference, "too_few_targets") == nullptr &&
                  FindFinding(georeference, "collinear_targets") == nullptr);
    EXPECT_TRUE(is_placed || !was_placed);  // Once placed it stays.
    was_placed = is_placed;
  }
  EXPECT_TRUE(was_placed);
  // The same, whichever way the photos came.
  Georeferencer at_once = MakeGeoreferencer(scene);
  EXPECT_EQ(georeferencer.Update().enu_from_map.scale, at_once.Update().enu_from_map.scale);
}

TEST(Georeferencer, OnlyLocatedPhotosCount) {
  const SurveyScene scene = MakeSurveyScene();
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const int num_photos = georeferencer.Update().targets[0].num_photos;
  MapDelta delta;
  delta.sequence = scene.map.sequence + 1;
  for (const ViewState& view : scene.map.views_set) delta.views_removed.push_back(view.photo);
  ASSERT_GT(num_photos, 2);
  ASSERT_TRUE(georeferencer.Apply(delta));
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kNone);
  EXPECT_EQ(georeferencer.Update().targets[0].num_photos, 0);
  EXPECT_EQ(georeferencer.Update().targets[0].state, TargetState::kUnseen);
  EXPECT_FALSE(georeferencer.Apply(delta));  // Not the next.
}

TEST(Georeferencer, FollowsTheMapWhenABundleMovesIt) {
  const SurveyScene scene = MakeSurveyScene();
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  georeferencer.Update();
  const Similarity3 moved = {1.5, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {1, 2, 3}};
  MapDelta delta;
  delta.sequence = scene.map.sequence + 1;
  for (ViewState view : scene.map.views_set) {
    view.cam_from_map = TransformCamera(moved, view.cam_from_map);
    delta.views_set.push_back(view);
  }
  ASSERT_TRUE(georeferencer.Apply(delta));
  EXPECT_NEAR(
      georeferencer.Update().enu_from_map.scale * scene.map_from_enu.scale, 1.0 / 1.5, 1e-4);
}

TEST(Georeferencer, TheSurveyMayBeReplacedInFlight) {
  SurveyScene scene = MakeSurveyScene();
  Georeferencer georeferencer({}, scene.camera);
  georeferencer.Apply(scene.map);
  for (const auto& [photo, markers] : scene.markers) georeferencer.SetMarkers(photo, markers);
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kNone);
  EXPECT_EQ(IdsIn(georeferencer.Update(), TargetState::kUnsurveyed).size(), 17U);
  Survey shifted = scene.survey;
  for (SurveyTarget& target : shifted.targets) target.point_in_crs.x() += 100.0;
  georeferencer.SetSurvey(shifted);
  const Similarity3 before = georeferencer.Update().enu_from_map;
  georeferencer.SetSurvey(scene.survey);
  const Similarity3 after = georeferencer.Update().enu_from_map;
  EXPECT_NEAR((before.translation - after.translation).x(), 100.0, 1e-6);
  georeferencer.ClearSurvey();
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kNone);
}

TEST(Georeferencer, TwoPointsAreTooFewAndItSaysSo) {
  SurveyScene scene = MakeSurveyScene();
  scene.survey.targets.resize(2);
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Georeference& georeference = georeferencer.Update();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kNone);
  const Finding* finding = FindFinding(georeference, "too_few_targets");
  ASSERT_NE(finding, nullptr);
  EXPECT_EQ(finding->severity, Finding::Severity::kError);
  EXPECT_THAT(finding->text,
              AllOf(HasSubstr("survey.csv: 2 of 2 control points"),
                    HasSubstr("three"),
                    HasSubstr("survey more markers")));
  const Finding* unsurveyed = FindFinding(georeference, "unsurveyed_markers");
  ASSERT_NE(unsurveyed, nullptr);
  EXPECT_THAT(unsurveyed->text, HasSubstr("2, 3, 4,"));
}

TEST(Georeferencer, WarnsOfABadLayout) {
  const SurveyScene scene = MakeSurveyScene();
  const auto with = [&](const std::function<bool(const Eigen::Vector3d&)>& is_kept) {
    SurveyScene part = scene;
    auto& targets = part.survey.targets;
    for (SurveyTarget& target : targets) target.is_check = !is_kept(target.point_in_crs);
    Georeferencer georeferencer = MakeGeoreferencer(part);
    return georeferencer.Update();
  };
  const Georeference left = with([](const auto& point) { return point.x() < 25.0; });
  const Finding* one_sided = FindFinding(left, "one_sided_targets");
  ASSERT_NE(one_sided, nullptr);
  EXPECT_EQ(one_sided->severity, Finding::Severity::kWarning);
  EXPECT_THAT(one_sided->text, HasSubstr("towards +x"));
  EXPECT_EQ(left.source, GeoreferenceSource::kTargets);
  const Georeference low = with([](const auto& point) { return point.z() < 14.0; });
  ASSERT_NE(FindFinding(low, "one_sided_targets"), nullptr);
  EXPECT_THAT(FindFinding(low, "one_sided_targets")->text, HasSubstr("towards the top (+z)"));
  int kept = 0;
  const Georeference three = with([&](const auto&) { return kept++ % 4 == 0 && kept < 10; });
  ASSERT_NE(FindFinding(three, "few_targets"), nullptr);
  EXPECT_THAT(FindFinding(three, "few_targets")->text, HasSubstr("would not be noticed"));
}

TEST(Georeferencer, WarnsOfTargetsOnALine) {
  SurveyScene scene = MakeSurveyScene();
  const auto put_on_line = [&](double width_m) {
    for (std::size_t i = 0; i < scene.targets_in_enu.size(); ++i) {
      scene.targets_in_enu[i] = {
          3.0 * static_cast<double>(i), 0.0, 15.0 + (i % 2 == 0 ? 0.0 : width_m)};
      scene.survey.targets[i].point_in_crs = scene.targets_in_enu[i];
    }
    TakePhotos({}, &scene);
    Georeferencer georeferencer = MakeGeoreferencer(scene);
    return georeferencer.Update();
  };
  const Georeference near = put_on_line(2.0);
  ASSERT_NE(FindFinding(near, "collinear_targets"), nullptr);
  EXPECT_EQ(near.source, GeoreferenceSource::kTargets);
  const Georeference on = put_on_line(0.1);
  ASSERT_NE(FindFinding(on, "collinear_targets"), nullptr);
  EXPECT_EQ(FindFinding(on, "collinear_targets")->severity, Finding::Severity::kError);
  EXPECT_EQ(on.source, GeoreferenceSource::kNone);
}

TEST(Georeferencer, NoticesOtherUnitsByTheSizeOfTheMarkers) {
  const auto find_unit = [](double per_metre) {
    SurveyScene scene = MakeSurveyScene();
    for (SurveyTarget& target : scene.survey.targets) target.point_in_crs *= per_metre;
    Georeferencer georeferencer = MakeGeoreferencer(scene);
    const Georeference& georeference = georeferencer.Update();
    EXPECT_EQ(georeference.source, GeoreferenceSource::kNone);
    const Finding* unit = FindFinding(georeference, "unit");
    return unit != nullptr ? unit->text : "";
  };
  EXPECT_THAT(find_unit(1.0 / 0.3048),
              AllOf(HasSubstr("survey.csv"),
                    HasSubstr("1.64"),
                    HasSubstr("feet"),
                    HasSubstr("convert it to metres")));
  EXPECT_THAT(find_unit(1000.0), HasSubstr("millimetres"));
  EXPECT_THAT(find_unit(100.0), HasSubstr("centimetres"));
}

TEST(Georeferencer, NoticesMarkersOfAnotherSize) {
  const SurveyScene scene = MakeSurveyScene();
  GeoreferencerOptions options;
  options.marker_diameter_m = 0.3;
  Georeferencer georeferencer = MakeGeoreferencer(scene, options);
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kTargets);
  EXPECT_NE(FindFinding(georeferencer.Update(), "marker_diameter"), nullptr);
  options.marker_diameter_m = 0.0;
  Georeferencer unknown = MakeGeoreferencer(scene, options);
  EXPECT_TRUE(unknown.Update().findings.empty());
}

TEST(Georeferencer, NoticesExchangedAxesByTheMirroredShape) {
  SurveySceneOptions options;
  options.relief_m = 8.0;  // In a plane the mirror image would fit as well.
  SurveyScene scene = MakeSurveyScene(options);
  for (SurveyTarget& target : scene.survey.targets) {
    std::swap(target.point_in_crs.x(), target.point_in_crs.y());
  }
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Georeference& georeference = georeferencer.Update();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kNone);
  const Finding* swapped = FindFinding(georeference, "swapped_axes");
  ASSERT_NE(swapped, nullptr);
  EXPECT_THAT(swapped->text, HasSubstr("mirror image"));
}

TEST(Georeferencer, NoticesExchangedAxesOfAFlatFacade) {
  using Exchange = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
  const std::vector<Exchange> exchanges = {
      [](const auto& p) { return Eigen::Vector3d(p.y(), p.x(), p.z()); },
      [](const auto& p) { return Eigen::Vector3d(p.x(), p.z(), p.y()); },
      [](const auto& p) { return Eigen::Vector3d(-p.x(), p.y(), p.z()); }};
  for (const double relief_m : {0.1, 0.5}) {  // Each fits as it stands, within a map's bend.
    SurveySceneOptions options;
    options.relief_m = relief_m;
    for (const Exchange& exchange : exchanges) {
      SurveyScene scene = MakeSurveyScene(options);
      for (SurveyTarget& target : scene.survey.targets) {
        target.point_in_crs = exchange(target.point_in_crs);
      }
      Georeferencer georeferencer = MakeGeoreferencer(scene);
      const Georeference& georeference = georeferencer.Update();
      EXPECT_EQ(georeference.source, GeoreferenceSource::kNone);
      const Finding* swapped = FindFinding(georeference, "swapped_axes");
      ASSERT_NE(swapped, nullptr) << relief_m;
      EXPECT_EQ(swapped->severity, Finding::Severity::kError);
      EXPECT_THAT(swapped->text,
                  AllOf(HasSubstr("survey.csv: 12 control points fit as a mirror image to 0.00"),
                        HasSubstr("two axes are exchanged, or one counts the wrong way"),
                        HasSubstr("x_m is east")));
      EXPECT_EQ(FindFinding(georeference, "wrong_target"), nullptr);
    }
  }
}

TEST(Georeferencer, AFlatFacadeWhoseMapIsBentIsNotTakenForAMirrorImage) {
  for (int seed = 1; seed <= 10; ++seed) {
    SurveySceneOptions options;
    options.random_seed = seed;
    options.relief_m = 0.02;
    SurveyScene scene = MakeSurveyScene(options);
    for (Eigen::Vector3d& point : scene.targets_in_enu) {
      point.y() += 0.02 * std::pow(point.x() / 25.0 - 1.0, 2);
    }
    TakePhotos(options, &scene);
    Georeferencer georeferencer = MakeGeoreferencer(scene);
    EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kTargets) << seed;
    EXPECT_EQ(FindFinding(georeferencer.Update(), "swapped_axes"), nullptr) << seed;
  }
}

TEST(Georeferencer, NoticesThatTheHeightIsInAnotherColumn) {
  SurveyScene scene = MakeSurveyScene();
  scene.map_from_enu.rotation = Eigen::Quaterniond::Identity();  // The map's z is up, as it is.
  for (std::size_t k = 0; k < scene.cams_from_enu.size(); ++k) {
    scene.map.views_set[k].cam_from_map =
        TransformCamera(scene.map_from_enu, scene.cams_from_enu[k]);
  }
  EXPECT_EQ(FindFinding(MakeGeoreferencer(scene).Update(), "tilted"), nullptr);
  for (SurveyTarget& target : scene.survey.targets) {
    const Eigen::Vector3d point = target.point_in_crs;
    target.point_in_crs = {point.x(), point.z(), -point.y()};
  }
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Finding* tilted = FindFinding(georeferencer.Update(), "tilted");
  ASSERT_NE(tilted, nullptr);
  EXPECT_THAT(tilted->text, HasSubstr("not in the column z_m"));
}

TEST(Georeferencer, RefusesASurveyOfAnotherPlace) {
  SurveyScene scene = MakeSurveyScene();
  test::Random random(3);
  for (SurveyTarget& target : scene.survey.targets) target.point_in_crs = random.InBox(20.0);
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kNone);
  EXPECT_NE(FindFinding(georeferencer.Update(), "no_agreement"), nullptr);
}

TEST(Georeferencer, LeavesAnIdOutThatIsThereTwice) {
  SurveyScene scene = MakeSurveyScene();
  for (auto& [photo, markers] : scene.markers) {
    const std::vector<MarkerDetection> seen = markers;
    for (MarkerDetection marker : seen) {
      if (marker.id != 4) continue;
      marker.id = 9;
      markers.push_back(marker);
    }
  }
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Georeference& georeference = georeferencer.Update();
  EXPECT_EQ(IdsIn(georeference, TargetState::kDouble), (std::vector<int>{9}));
  const Finding* twice = FindFinding(georeference, "double_marker");
  ASSERT_NE(twice, nullptr);
  EXPECT_THAT(twice->text, HasSubstr("marker 9"));
  EXPECT_LT(ModelError_mm(scene, georeference.enu_from_map), 2.0);
}

TEST(Georeferencer, TakesTargetsThatAHandPointedAt) {
  SurveyScene scene = MakeSurveyScene();
  for (const auto& [photo, markers] : scene.markers) {
    for (const MarkerDetection& marker : markers) {
      scene.survey.pointed.push_back(
          {marker.id, std::to_string(photo.value) + ".jpg", marker.center_px});
    }
  }
  scene.markers.clear();
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  const Georeference& georeference = georeferencer.Update();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kTargets);
  EXPECT_EQ(IdsIn(georeference, TargetState::kGood).size(), 17U);
  EXPECT_FALSE(georeference.marker_diameter_m);
  EXPECT_EQ(georeferencer.Sightings().size(), scene.survey.pointed.size());
}

TEST(Georeferencer, HandsControlPointsToTheBundle) {
  SurveyScene scene = MakeSurveyScene();
  scene.survey.targets[7].point_in_crs.x() += 0.5;
  Georeferencer georeferencer = MakeGeoreferencer(scene);
  georeferencer.Update();
  const BundleConstraints constraints = georeferencer.Constraints();
  ASSERT_EQ(constraints.markers.size(), 17U);
  int num_surveyed = 0;
  for (const MarkerTrack& marker : constraints.markers) {
    const SurveyTarget& target = scene.survey.targets[static_cast<std::size_t>(marker.marker_id)];
    EXPECT_GE(marker.sightings.size(), 2U);
    EXPECT_GT(marker.sightings[0].sigma_px, 0.1);
    EXPECT_EQ(marker.survey.has_value(), !target.is_check && marker.marker_id != 7);
    if (!marker.survey) continue;
    ++num_surveyed;
    EXPECT_NEAR(marker.survey->sigma, 0.001 * scene.map_from_enu.scale, 1e-6);
    const Eigen::Vector3d truth = scene.map_from_enu * target.point_in_crs;
    EXPECT_LT((marker.survey->position_in_map - truth).norm(), 2e-3 * scene.map_from_enu.scale);
  }
  EXPECT_EQ(num_surveyed, 11);
}

TEST(Georeferencer, RefusesBadOptions) {
  GeoreferencerOptions options;
  options.max_error_px = 0.0;
  options.min_coverage = 2.0;
  EXPECT_EQ(options.Problems().size(), 2U);
  EXPECT_THROW(Georeferencer(options, test::MakeCamera()), std::invalid_argument);
  EXPECT_TRUE(GeoreferencerOptions().Problems().empty());
}

}  // namespace
}  // namespace plumb
