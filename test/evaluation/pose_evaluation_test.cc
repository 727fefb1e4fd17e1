// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/pose_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace plumb {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Corners of a square of 2 m, and one 1 m above its middle; each camera turned differently.
std::vector<TruePose> MakeTruth() {
  std::vector<TruePose> truth;
  const std::vector<Eigen::Vector3d> centers = {
      {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const double angle_rad = 0.3 * static_cast<double>(i);
    truth.push_back({std::to_string(i) + ".jpg",
                     Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitX())),
                     centers[i]});
  }
  return truth;
}

// The same cameras in a map that is turned, scaled and shifted against the world.
std::vector<ViewState> ViewsOf(const std::vector<TruePose>& truth,
                               const Similarity3& map_from_world) {
  std::vector<ViewState> views;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Rigid3 cam_from_world(truth[i].cam_from_world_rotation,
                                -(truth[i].cam_from_world_rotation * truth[i].center_in_world_m));
    views.push_back({{static_cast<std::uint32_t>(i)},
                     truth[i].photo,
                     {},
                     TransformCamera(map_from_world, cam_from_world)});
  }
  return views;
}

Similarity3 MakeMapFromWorld() {
  return {0.037,
          Eigen::Quaterniond(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, -2, 0.5).normalized())),
          {10, -20, 30}};
}

TEST(EvaluatePoses, FindsNoErrorInATransformedTruth) {
  const std::vector<TruePose> truth = MakeTruth();
  const PoseEvaluation evaluation = EvaluatePoses(ViewsOf(truth, MakeMapFromWorld()), truth);
  EXPECT_EQ(evaluation.num_truth, 5);
  EXPECT_EQ(evaluation.num_registered, 5);
  EXPECT_LT(evaluation.center_error_mm.max, 1e-9);
  EXPECT_LT(evaluation.rotation_error_deg.max, 1e-5);  // acos loses half the digits at 1.
  EXPECT_NEAR(evaluation.world_from_map.scale, 1.0 / 0.037, 1e-9);
}

TEST(EvaluatePoses, MeasuresAKnownDisplacement) {
  // The tip of the pyramid is 90 mm too high, its base fits. By symmetry the best
  // similarity only scales about the centroid and shifts along z, and what is left is
  // computed here from Umeyama's closed form for that case.
  const std::vector<TruePose> truth = MakeTruth();
  std::vector<TruePose> measured = truth;
  measured[4].center_in_world_m.z() += 0.09;
  const double mean_true = 1.0 / 5.0;
  const double mean_measured = 1.09 / 5.0;
  double covariance = 4 * 2.0;  // The base's x and y: 4 corners at distance sqrt(2).
  double variance = 4 * 2.0;
  const auto add = [&](double z_measured, double z_true) {
    covariance += (z_measured - mean_measured) * (z_true - mean_true);
    variance += (z_measured - mean_measured) * (z_measured - mean_measured);
  };
  for (int i = 0; i < 4; ++i) add(0.0, 0.0);
  add(1.09, 1.0);
  const double scale = covariance / variance;
  const double tip_mm = 1e3 * std::abs(scale * (1.09 - mean_measured) + mean_true - 1.0);
  const double corner_mm =
      1e3 * std::hypot((scale - 1.0) * std::sqrt(2.0), scale * -mean_measured + mean_true);
  const PoseEvaluation evaluation = EvaluatePoses(ViewsOf(measured, MakeMapFromWorld()), truth);
  EXPECT_NEAR(evaluation.photos[4].center_error_mm, tip_mm, 1e-6);
  EXPECT_NEAR(evaluation.photos[0].center_error_mm, corner_mm, 1e-6);
  EXPECT_NEAR(evaluation.center_error_mm.max, tip_mm, 1e-6);
  EXPECT_NEAR(evaluation.center_error_mm.median, corner_mm, 1e-6);
  EXPECT_NEAR(evaluation.center_error_mm.mean, (4 * corner_mm + tip_mm) / 5, 1e-6);
}

TEST(EvaluatePoses, MeasuresAKnownTurnOfOneCamera) {
  const std::vector<TruePose> truth = MakeTruth();
  std::vector<TruePose> measured = truth;
  measured[2].cam_from_world_rotation =
      Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, 3).normalized()) *
      truth[2].cam_from_world_rotation;
  const PoseEvaluation evaluation = EvaluatePoses(ViewsOf(measured, MakeMapFromWorld()), truth);
  const double turn_deg = 0.02 * 180.0 / M_PI;
  EXPECT_NEAR(evaluation.photos[2].rotation_error_deg, turn_deg, 1e-6);
  EXPECT_NEAR(evaluation.rotation_error_deg.max, turn_deg, 1e-6);
  EXPECT_NEAR(evaluation.rotation_error_deg.mean, turn_deg / 5, 1e-5);
  EXPECT_NEAR(evaluation.rotation_error_deg.median, 0.0, 1e-5);
}

TEST(EvaluatePoses, PairsByNameAndNamesWhatTheMapMissed) {
  const std::vector<TruePose> truth = MakeTruth();
  std::vector<ViewState> views = ViewsOf(truth, MakeMapFromWorld());
  std::swap(views[0], views[3]);
  views.erase(views.begin() + 1);
  views.push_back(views[0]);
  views.back().name = "extra.jpg";
  const PoseEvaluation evaluation = EvaluatePoses(views, truth);
  EXPECT_EQ(evaluation.num_registered, 4);
  EXPECT_THAT(evaluation.missed, testing::ElementsAre("1.jpg"));
  EXPECT_THAT(evaluation.without_truth, testing::ElementsAre("extra.jpg"));
  EXPECT_LT(evaluation.center_error_mm.max, 1e-9);
}

TEST(EvaluatePoses, OneWrongPoseDoesNotSpoilTheOthers) {
  const std::vector<TruePose> truth = MakeTruth();
  std::vector<TruePose> measured = truth;
  measured[1].center_in_world_m += Eigen::Vector3d(0.0, 20.0, 0.0);
  measured[3].center_in_world_m.x() += 0.01;  // Inaccurate, not wrong.
  const PoseEvaluation evaluation = EvaluatePoses(ViewsOf(measured, MakeMapFromWorld()), truth);
  EXPECT_THAT(evaluation.wrong, testing::ElementsAre("1.jpg"));
  EXPECT_NEAR(evaluation.center_error_mm.max, 20'000.0, 20.0);
  EXPECT_LT(evaluation.center_error_mm.median, 10.0);
}

TEST(EvaluatePoses, ACameraThatIsOnlyTurnedIsWrong) {
  const std::vector<TruePose> truth = MakeTruth();
  std::vector<TruePose> measured = truth;
  measured[2].cam_from_world_rotation =
      Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()) * truth[2].cam_from_world_rotation;
  const auto views = ViewsOf(measured, MakeMapFromWorld());
  EXPECT_THAT(EvaluatePoses(views, truth).wrong, testing::ElementsAre("2.jpg"));
  EXPECT_THAT(EvaluatePoses(views, truth, {0.1, 1.5}).wrong, testing::IsEmpty());
}

TEST(EvaluatePoses, WithoutAMajorityAllCountAlike) {
  const std::vector<TruePose> truth = MakeTruth();
  std::vector<TruePose> measured = truth;
  for (std::size_t i = 0; i < 3; ++i) {
    measured[i].center_in_world_m *= 3.0 + static_cast<double>(i);
  }
  const PoseEvaluation evaluation = EvaluatePoses(ViewsOf(measured, MakeMapFromWorld()), truth);
  EXPECT_GE(evaluation.wrong.size(), 3u);
}

TEST(EvaluatePoses, NeedsThreeCommonPhotosThatAreNotInALine) {
  std::vector<TruePose> truth = MakeTruth();
  const std::vector<ViewState> views = ViewsOf(truth, MakeMapFromWorld());
  EXPECT_THROW(EvaluatePoses({views[0], views[1]}, truth), std::runtime_error);
  EXPECT_THROW(EvaluatePoses({}, truth), std::runtime_error);
  for (TruePose& pose : truth) pose.center_in_world_m.tail<2>().setZero();
  for (std::size_t i = 0; i < 5; ++i) truth[i].center_in_world_m.x() = static_cast<double>(i);
  try {
    EvaluatePoses(ViewsOf(truth, MakeMapFromWorld()), truth);
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("line"));
  }
}

TEST(EvaluatePoses, ANearlyStraightRowIsTurnedAboutItselfByItsRotations) {
  std::vector<TruePose> truth = MakeTruth();
  for (std::size_t i = 0; i < 5; ++i) {
    truth[i].center_in_world_m = {static_cast<double>(i), 0.0, i == 2 ? 0.02 : 0.0};
  }
  // The bulge of the row, which alone tells the turn by the centres, measured on another side.
  std::vector<TruePose> measured = truth;
  measured[2].center_in_world_m = {2.0, 0.02, 0.0};
  const PoseEvaluation evaluation = EvaluatePoses(ViewsOf(measured, MakeMapFromWorld()), truth);
  EXPECT_LT(evaluation.rotation_error_deg.max, 1.0);
  EXPECT_LT(evaluation.center_error_mm.max, 30.0);  // 20 mm across, in two directions.
  EXPECT_THAT(evaluation.wrong, testing::IsEmpty());

  measured[1].cam_from_world_rotation =
      Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()) * truth[1].cam_from_world_rotation;
  EXPECT_THAT(EvaluatePoses(ViewsOf(measured, MakeMapFromWorld()), truth).wrong,
              testing::ElementsAre("1.jpg"));
}

class ReadTruePosesTest : public testing::Test {
 protected:
  ~ReadTruePosesTest() override { std::remove(path_.c_str()); }

  void Write(const std::string& text) { std::ofstream(path_) << text; }
  std::string ErrorOf(const std::string& text) {
    Write(text);
    try {
      ReadTruePoses(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  std::string path_ = testing::TempDir() + "true_poses_test.csv";
};

constexpr char kHeader[] = "# comment\nphoto,qw,qx,qy,qz,center_x_m,center_y_m,center_z_m\n";

TEST_F(ReadTruePosesTest, ReadsWhatThePagesOfTheDataSay) {
  Write(std::string(kHeader) +
        "a.jpg,0.5,-0.5,0.5,0.5,1,-2.5,3e2\r\n\nb.jpg, 1, 0, 0, 0, 0, 0, 0\n");
  const std::vector<TruePose> poses = ReadTruePoses(path_);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].photo, "a.jpg");
  EXPECT_EQ(poses[0].cam_from_world_rotation.w(), 0.5);
  EXPECT_EQ(poses[0].cam_from_world_rotation.x(), -0.5);
  EXPECT_EQ(poses[0].center_in_world_m, Eigen::Vector3d(1.0, -2.5, 300.0));
  EXPECT_EQ(poses[1].photo, "b.jpg");
}

TEST_F(ReadTruePosesTest, NamesTheFileTheLineAndTheFault) {
  const std::string header = kHeader;
  EXPECT_THAT(ErrorOf(header + "a.jpg,1,0,0,0,0,0\n"),
              AllOf(HasSubstr(path_ + ": line 3"), HasSubstr("7 fields")));
  EXPECT_THAT(ErrorOf(header + "\na.jpg,1,0,0,zero,0,0,0\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("\"zero\" is not a number")));
  EXPECT_THAT(ErrorOf(header + "a.jpg,1,0,0,0,0,0,nan\n"), HasSubstr("\"nan\""));
  EXPECT_THAT(ErrorOf(header + "a.jpg,1,0,0,0,0,0,1.5m\n"), HasSubstr("\"1.5m\""));
  EXPECT_THAT(ErrorOf(header + "a.jpg,0,0,0,0,0,0,0\n"), HasSubstr("unit length"));
  EXPECT_THAT(ErrorOf(header + "a.jpg,1,0,0,0,0,0,0\na.jpg,1,0,0,0,0,0,0\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("a.jpg a second time")));
  EXPECT_THAT(ErrorOf(header + ",1,0,0,0,0,0,0\n"), HasSubstr("names no photo"));
  EXPECT_THAT(ErrorOf(header), HasSubstr("holds no pose"));
}

TEST_F(ReadTruePosesTest, AnAbsentFileIsNamed) {
  EXPECT_THROW(ReadTruePoses(path_ + ".absent"), std::runtime_error);
}

TEST_F(ReadTruePosesTest, ReadsTheSharedScenes) {
  const char* data = std::getenv("PLUMBLINE_DATA");
  const std::filesystem::path root = data ? data : PLUMBLINE_SOURCE_DIR "/../shared/data";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << root << " is absent: set PLUMBLINE_DATA";
  EXPECT_EQ(ReadTruePoses((root / "fountain-P11/ground_truth/poses.csv").string()).size(), 11u);
  EXPECT_EQ(ReadTruePoses((root / "Herz-Jesus-P8/ground_truth/poses.csv").string()).size(), 8u);
}

}  // namespace
}  // namespace plumb
