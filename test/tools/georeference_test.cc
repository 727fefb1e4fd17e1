// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/georeference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "plumbline/common/atomic_file.h"
#include "plumbline/simulation/facade.h"
#include "plumbline/simulation/survey.h"
#include "test/support/marker_scene.h"
#include "test/support/synthetic_scene.h"
#include "tools/export_session.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kRadius_m = 0.25;

Camera SmallCamera() {
  return Camera("small",
                1200,
                800,
                DistortionModel::kPlumbBob,
                {1000, 1000, 599.5, 399.5, 0, 0, 0, 0, 0, 0, 0, 0});
}

// Marker i of a facade in y = 0, about a metre apart in x and z.
Vector3d MarkerPlace(int i) {
  return {0.9 * (i % 4) - 1.4, 0.12 * (i % 3), 1.0 * (i / 4) - 0.6 + 0.1 * (i % 2)};
}

// Four located photos of eight markers, as a session with a map of its own.
class GeoreferenceTest : public testing::Test {
 protected:
  GeoreferenceTest() {
    std::string pattern = testing::TempDir() + "georeference_XXXXXX";
    root_ = ::mkdtemp(pattern.data());
    arguments_.session = root_ + "/session";
    arguments_.survey = root_ + "/survey.csv";
    MakeSession();
    WriteSurvey(Vector3d::Zero(), "");
  }
  ~GeoreferenceTest() override { fs::remove_all(root_); }

  static Rigid3 CamFromWorld(int k) {
    const Vector3d center(1.2 * k - 1.8, -4.5 - 0.3 * (k % 2), 0.2 * k - 0.3);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.12 * (1.5 - k), Vector3d::UnitY()) *
                                  test::FacingFacade());
    return {turn, -(turn * center)};
  }

  static cv::Mat Photograph(const Rigid3& cam_from_world) {
    Eigen::Matrix3d world_from_marker;  // Columns: right, down, into the wall.
    world_from_marker << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    std::vector<test::PlacedFace> faces;
    for (int i = 0; i < 8; ++i) {
      // Lengths in outer radii.
      const Vector3d in_cam = (cam_from_world * MarkerPlace(i)) / kRadius_m;
      faces.push_back(
          {test::MarkerFace(i),
           Rigid3(cam_from_world.rotation * Eigen::Quaterniond(world_from_marker), in_cam)});
    }
    test::PhotoConditions conditions;
    conditions.samples_per_axis = 4;
    return test::RenderPhoto(SmallCamera(), faces, conditions);
  }

  // Drawn once for all tests.
  static const std::vector<std::vector<std::uint8_t>>& Photos() {
    static const std::vector<std::vector<std::uint8_t>> photos = [] {
      std::vector<std::vector<std::uint8_t>> drawn(4);
      for (int k = 0; k < 4; ++k) {
        cv::imencode(".png", Photograph(CamFromWorld(k)), drawn[static_cast<std::size_t>(k)]);
      }
      return drawn;
    }();
    return photos;
  }

  void MakeSession() {
    SessionStore store(arguments_.session, SmallCamera());
    MapDelta delta;
    delta.sequence = 1;
    for (int k = 0; k < 4; ++k) {
      const PhotoId id{static_cast<std::uint32_t>(k)};
      const std::string name =
          store.SavePhoto(id, std::to_string(k) + ".png", Photos()[static_cast<std::size_t>(k)]);
      delta.views_set.push_back({id, name, {}, TransformCamera(map_from_world_, CamFromWorld(k))});
    }
    delta.landmarks_set = {{{0}, map_from_world_ * Vector3d(0.5, 0.25, -0.5), {1, 2, 3}}};
    delta.observations_added = {{{0}, {0}, 0, {10, 20}}, {{0}, {1}, 0, {30, 40}}};
    store.Apply(delta);
  }

  void WriteSurvey(const Vector3d& offset, const std::string& comments) const {
    std::ofstream file(arguments_.survey);
    file.precision(12);
    file << comments << "id,x_m,y_m,z_m,sigma_m,role\n";
    for (int i = 0; i < 8; ++i) {
      const Vector3d point = MarkerPlace(i) + offset;
      file << i << ',' << point.x() << ',' << point.y() << ',' << point.z() << ",0.001,"
           << (i % 4 == 2 ? "check" : "control") << '\n';
    }
  }

  std::string Run() {
    std::ostringstream out;
    Console console(&out, /*is_terminal=*/false);
    WriteSessionGeoreference(arguments_, &console);
    return out.str();
  }

  std::string ErrorOf() {
    try {
      Run();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  std::vector<std::string> Export() const { return ExportTo(root_ + "/out"); }

  std::vector<std::string> ExportTo(const std::string& folder) const {
    const SessionStore store = SessionStore::OpenExisting(arguments_.session);
    return ExportSession(store, ReadSessionMap(store), folder).lines;
  }

  // The header, and the one point behind it.
  std::string ReadPly(Vector3d* point) const {
    const std::vector<std::uint8_t> bytes = ReadFileBytes(root_ + "/out/points.ply");
    const std::string text(bytes.begin(), bytes.end());
    const std::size_t body = text.find("end_header\n") + 11;
    std::memcpy(point->data(), text.data() + body, sizeof(*point));
    return text.substr(0, body);
  }

  nlohmann::json Written() const {
    return nlohmann::json::parse(std::ifstream(GeoreferencePath(arguments_.session)));
  }

  Similarity3 map_from_world_{
      0.4, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitZ())), {1, 2, 3}};
  std::string root_;
  GeoreferenceArguments arguments_;
};

TEST_F(GeoreferenceTest, PlacesASessionByItsPhotos) {
  const std::string output = Run();
  EXPECT_THAT(output,
              AllOf(HasSubstr("control points: 6"),
                    HasSubstr("check points: 2"),
                    HasSubstr("by targets in local")));
  const nlohmann::json json = Written();
  EXPECT_EQ(json["source"], "targets");
  EXPECT_NEAR(json["enu_from_map"]["scale"].get<double>(), 1.0 / 0.4, 0.005);
  // A centre is found to some 0.05 px, which is 0.2 mm here.
  EXPECT_LT(json["control"]["max_mm"].get<double>(), 2.0);
  EXPECT_LT(json["check"]["max_mm"].get<double>(), 2.0);
  for (const auto& target : json["targets"]) EXPECT_EQ(target["state"], "good") << target;
  EXPECT_NEAR(json["marker_diameter_m"].get<double>(), 0.5, 0.02);
  EXPECT_FALSE(fs::exists(arguments_.session + "/export/gcp_list.txt"));  // Local: no word for it.
}

TEST_F(GeoreferenceTest, TheExportFollows) {
  WriteSurvey({500.0, 0.0, 20'000.0}, "");
  Run();
  EXPECT_THAT(Export()[0], HasSubstr("metres, enu about 500 0 20000"));
  Vector3d point;
  const std::string header = ReadPly(&point);
  EXPECT_LT((point - Vector3d(0.5, 0.25, -0.5)).norm(), 0.003);  // [m]
  EXPECT_THAT(header,
              AllOf(HasSubstr("comment crs: local\n"), HasSubstr("comment offset: 500 0 20000\n")));
  std::ifstream images(root_ + "/out/colmap/images.txt");
  std::string line;
  std::getline(images, line);
  std::getline(images, line);
  std::getline(images, line);
  std::istringstream fields(line);
  double id = 0.0;
  Eigen::Quaterniond q;
  Vector3d t;
  fields >> id >> q.w() >> q.x() >> q.y() >> q.z() >> t.x() >> t.y() >> t.z();
  EXPECT_LT((Rigid3(q, t).TargetOriginInSource() - CamFromWorld(0).TargetOriginInSource()).norm(),
            0.01);
  const auto frame = nlohmann::json::parse(std::ifstream(root_ + "/out/frame.json"));
  EXPECT_EQ(frame["crs"], "local");
  EXPECT_EQ(frame["offset"], (std::array<double, 3>{500.0, 0.0, 20'000.0}));
}

TEST_F(GeoreferenceTest, ExportsInTheCrsOfTheSurvey) {
  WriteSurvey({532112.0, 5212345.0, 361.0}, "# crs: EPSG:32633\n# heights: orthometric\n");
  Run();
  Export();
  Vector3d point;
  const std::string header = ReadPly(&point);
  const Vector3d in_crs = point + Vector3d(532110.0, 5212350.0, 360.0);
  EXPECT_THAT(header,
              AllOf(HasSubstr("comment crs: EPSG:32633\n"),
                    HasSubstr("comment heights: orthometric\n"),
                    HasSubstr("comment offset: 532110 5212350 360\n")));
  EXPECT_LT((in_crs - Vector3d(532112.5, 5212345.25, 360.5)).norm(), 0.003);
  EXPECT_FALSE(Written()["earth_from_map"].is_null());
  const Survey gcp = ReadSurvey(arguments_.session + "/export/gcp_list.txt");
  EXPECT_EQ(gcp.targets.size(), 6U);
  EXPECT_EQ(gcp.pointed.size(), 18U);  // The outer photos show four markers, the inner ones eight.
}

TEST_F(GeoreferenceTest, ExportsOfTheFormerGeoreferenceGo) {
  WriteSurvey({532112.0, 5212345.0, 361.0}, "# crs: EPSG:32633\n# heights: orthometric\n");
  Run();
  const std::string folder = arguments_.session + "/export";
  ExportTo(folder);
  std::ofstream(folder + "/notes.txt") << "mine";
  EXPECT_THAT(Run(), Not(HasSubstr("deleted")));  // The same again.
  EXPECT_TRUE(fs::exists(folder + "/points.ply"));
  EXPECT_TRUE(fs::exists(folder + "/gcp_list.txt"));
  WriteSurvey({500.0, 0.0, 20'000.0}, "");
  EXPECT_THAT(Run(),
              AllOf(HasSubstr("deleted " + folder + "/points.ply"),
                    HasSubstr("deleted " + folder + "/gcp_list.txt"),
                    HasSubstr("plumbline export and plumbline mesh write them anew")));
  for (const char* name : {"points.ply", "colmap", "frame.json", "gcp_list.txt"}) {
    EXPECT_FALSE(fs::exists(folder + '/' + name)) << name;
  }
  EXPECT_TRUE(fs::exists(folder + "/notes.txt"));
  // A survey that is refused leaves all as it was.
  ExportTo(folder);
  std::ofstream(arguments_.survey) << "0,0,0,0\n1,1,0,0\n";
  ErrorOf();
  EXPECT_TRUE(fs::exists(folder + "/points.ply"));
}

TEST_F(GeoreferenceTest, AnOldGeoreferenceIsNotTakenForANewMap) {
  Run();
  {
    SessionStore store(arguments_.session, SmallCamera());
    MapDelta delta;
    delta.sequence = 2;
    delta.landmarks_set = {{{0}, {7, 8, 9}, {1, 2, 3}}};
    store.Apply(delta);
  }
  EXPECT_THAT(
      Export()[0],
      AllOf(HasSubstr("is of an earlier map"), HasSubstr("run plumbline georeference again")));
  Vector3d point;
  EXPECT_THAT(ReadPly(&point), HasSubstr("comment frame: map\n"));
  EXPECT_EQ(point, Vector3d(7, 8, 9));
  EXPECT_FALSE(fs::exists(root_ + "/out/frame.json"));
}

TEST_F(GeoreferenceTest, SaysWhatIsWrongAndWritesNothing) {
  std::ofstream(arguments_.survey) << "0,0,0,0\n1,1,0,0\n";
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("2 of 2 control points"), HasSubstr("three")));
  std::ofstream(arguments_.survey) << "0,0,0,x\n";
  EXPECT_THAT(ErrorOf(), HasSubstr("survey.csv: line 1: z_m"));
  arguments_.survey.clear();
  EXPECT_THAT(ErrorOf(), HasSubstr("give --survey"));
  arguments_.settings = {"max_error_px=-1"};
  EXPECT_THAT(ErrorOf(), HasSubstr("max_error_px"));
  EXPECT_FALSE(fs::exists(GeoreferencePath(arguments_.session)));
}

TEST_F(GeoreferenceTest, GoesOnWithoutAPhotoThatIsGone) {
  fs::remove(arguments_.session + "/photos/2.png");
  EXPECT_THAT(Run(), AllOf(HasSubstr("2.png: left out"), HasSubstr("control points: 6")));
}

TEST_F(GeoreferenceTest, ReadsTheSurveyOfTheSimulator) {
  FacadeOptions facade;
  facade.width_m = 16.0;
  facade.height_m = 14.0;
  facade.num_storeys = 3;
  facade.num_targets = 7;
  const std::vector<SurveyedTarget> written = SurveyTargets(BuildFacade(facade), {});
  WriteSurveyCsv(written, arguments_.survey);
  const Survey survey = ReadSurvey(arguments_.survey);
  ASSERT_EQ(survey.targets.size(), written.size());
  EXPECT_EQ(survey.crs, kLocalCrs);
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(survey.targets[i].id, written[i].id);
    EXPECT_LT((survey.targets[i].point_in_crs - written[i].point_in_world).norm(), 1e-5);
    EXPECT_EQ(survey.targets[i].is_check, written[i].is_check);
    EXPECT_EQ(survey.targets[i].sigma_m, written[i].sigma_m);
  }
}

// The same session with a map of 80 landmarks, as the mapper leaves it but for an error: the two
// photos in the middle have been moved back.
class RefinementTest : public GeoreferenceTest {
 protected:
  RefinementTest() {
    SessionStore store(arguments_.session, SmallCamera());
    MapDelta delta;
    delta.sequence = 2;
    delta.landmarks_removed = {{0}};
    std::array<FeatureSet, 4> features;
    test::Random random(3);
    for (std::uint32_t i = 1; i <= 80; ++i) {
      const Vector3d point = random.InBox(1.0).cwiseProduct(Vector3d(2.0, 0.2, 1.2));
      delta.landmarks_set.push_back({{i}, map_from_world_ * point, {9, 9, 9}});
      for (std::uint32_t k = 0; k < 4; ++k) Observe(point, k, {i}, &features[k], &delta);
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      Rigid3 cam_from_world = CamFromWorld(static_cast<int>(k));
      if (k == 1 || k == 2) cam_from_world.translation.z() += 0.01;
      delta.views_set.push_back(
          {{k}, std::to_string(k) + ".png", {}, TransformCamera(map_from_world_, cam_from_world)});
      SaveFeatures({k}, features[k], &store);
    }
    store.Apply(delta);
  }

  static void Observe(const Vector3d& point,
                      std::uint32_t photo,
                      LandmarkId id,
                      FeatureSet* features,
                      MapDelta* delta) {
    const auto pixel = SmallCamera().Project(CamFromWorld(static_cast<int>(photo)) * point);
    if (!pixel || !SmallCamera().IsInImage(*pixel)) return;
    const Eigen::Vector2f raw = pixel->cast<float>();
    delta->observations_added.push_back(
        {id, {photo}, static_cast<std::uint32_t>(features->features.size()), raw});
    features->features.push_back({raw.x(), raw.y(), 2.0F, 0.0F});
    features->colors.push_back({9, 9, 9});
  }

  static void SaveFeatures(PhotoId photo, const FeatureSet& features, SessionStore* store) {
    PhotoAnalysis analysis;
    analysis.status = PhotoStatus::kOk;
    analysis.features = features;
    analysis.features.descriptors.setZero(static_cast<Eigen::Index>(features.features.size()),
                                          kDescriptorSize);
    store->SaveAnalysis(photo, {}, analysis);
  }

  std::vector<std::string> HeldLens() const {
    return {"refinement.bundle.refine_focal_length=false",
            "refinement.bundle.refine_principal_point=false",
            "refinement.bundle.refine_distortion=false"};
  }
};

TEST_F(RefinementTest, TheMapIsMendedAndTheOneBeforeIsKept) {
  Run();
  const nlohmann::json before = Written();
  const std::size_t num_views =
      SessionStore::OpenExisting(arguments_.session).Snapshot().views_set.size();
  arguments_.refine = true;
  arguments_.settings = HeldLens();
  EXPECT_THAT(Run(), HasSubstr("refined: focal length 1000.00 -> 1000.00 px"));
  const nlohmann::json after = Written();
  EXPECT_EQ(after["refined"], true);
  EXPECT_EQ(after["map_sequence"], before["map_sequence"]);
  EXPECT_LT(after["check"]["mean_mm"].get<double>(),
            0.5 * before["check"]["mean_mm"].get<double>());
  EXPECT_LT(after["check"]["mean_mm"].get<double>(), 1.0);
  {
    const SessionStore store = SessionStore::OpenExisting(arguments_.session);
    ASSERT_TRUE(store.RefinedSnapshot());
    EXPECT_EQ(store.Snapshot().views_set.size(), num_views);
    EXPECT_EQ(store.Snapshot().sequence, 2U);
  }
  EXPECT_THAT(Export()[0], HasSubstr("metres"));  // Of the refined map.

  arguments_.refine = false;
  EXPECT_THAT(Run(), HasSubstr("dropped"));
  EXPECT_EQ(Written()["refined"], false);
  EXPECT_EQ(Written()["check"], before["check"]);
  EXPECT_FALSE(SessionStore::OpenExisting(arguments_.session).RefinedSnapshot());
}

TEST_F(RefinementTest, AGeoreferenceOfTheOtherMapIsNotTaken) {
  Run();
  const nlohmann::json unrefined = Written();
  arguments_.refine = true;
  arguments_.settings = HeldLens();
  Run();
  std::ofstream(GeoreferencePath(arguments_.session)) << unrefined;
  EXPECT_THAT(Export()[0], HasSubstr("is of an earlier map"));
}

TEST_F(RefinementTest, SaysWhichOptionIsWrong) {
  arguments_.refine = true;
  arguments_.settings = {"refinement.num_rounds=0"};
  EXPECT_THAT(ErrorOf(), HasSubstr("refinement.num_rounds"));
  arguments_.settings = {"refinement.bundle.distance_exponent=9"};
  EXPECT_THAT(ErrorOf(), HasSubstr("distance_exponent"));
  EXPECT_FALSE(SessionStore::OpenExisting(arguments_.session).RefinedSnapshot());
}

}  // namespace
}  // namespace plumb::tools
