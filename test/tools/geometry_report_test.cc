// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/geometry_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "test/support/synthetic_scene.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

// A wall of 20 m x 10 m in y = 0 that faces the cameras at y = -10, and as much behind it unseen.
class GeometryReportTest : public testing::Test {
 protected:
  GeometryReportTest() {
    truth_.surface = path_ + "surface.ply";
    truth_.laser = path_ + "laser.ply";
    truth_.num_samples = 20'000;
    for (double x_m = 0.0; x_m <= 20.0; x_m += 5.0) {
      truth_.photos.push_back({"", test::FacingFacade(), {x_m, -10.0, 5.0}});
    }
    WriteSurface("property uchar main_wall\n", " 1", " 0");
    std::ofstream laser(truth_.laser);
    laser << "ply\nformat ascii 1.0\nelement vertex 80000\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n";
    for (int i = 0; i < 400; ++i) {
      for (int k = 0; k < 200; ++k) laser << 0.05 * i << " 0 " << 0.05 * k << '\n';
    }
    test::Random random(1);
    for (int i = 0; i < 30'000; ++i) {
      const double x_m = random.Uniform(0.0, 20.0);
      points_.emplace_back(x_m, -0.004, random.Uniform(0.0, 10.0));
    }
  }
  ~GeometryReportTest() override {
    std::filesystem::remove(truth_.surface);
    std::filesystem::remove(truth_.laser);
  }

  void WriteSurface(const std::string& property, const char* front, const char* back) {
    std::ofstream(truth_.surface)
        << "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
           "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
        << property << "end_header\n0 0 0\n20 0 0\n20 0 10\n0 0 10\n0 3 0\n20 3 0\n20 3 10\n"
        << "0 3 10\n4 0 1 2 3" << front << "\n4 4 5 6 7" << back << '\n';
  }

  Json Report() const {
    Json report = Json::object();
    ReportGeometry(truth_, test::MakeCamera(), points_, &report);
    return report;
  }

  std::string path_ = testing::TempDir() + "geometry_report_";
  GeometryTruth truth_;
  std::vector<Eigen::Vector3d> points_;  // 4 mm before the wall.
};

TEST_F(GeometryReportTest, HoldsPointsAgainstBothTruths) {
  const Json report = Report();
  for (const char* truth : {"surface", "laser"}) {
    const Json& accuracy = report.at(truth).at("accuracy");
    EXPECT_EQ(accuracy.at("points"), 30'000);
    EXPECT_NEAR(accuracy.at("mean_mm"), 4.0, truth == std::string("laser") ? 0.3 : 1e-6);
    EXPECT_EQ(accuracy.at("share_within").at("2 mm"), 0.0);
    EXPECT_GT(accuracy.at("share_within").at("5 mm"), 0.99);
  }
  // What stands behind the wall is in no photo, but near half of what lies in their cones.
  EXPECT_NEAR(report.at("surface").at("completeness").at("points"), 10'000, 1'000);
  EXPECT_EQ(report.at("laser").at("completeness").at("points"), 20'000);
  EXPECT_LT(report.at("wall").at("max_bend_mm"), 1e-6);
  EXPECT_EQ(report.at("wall").at("cells").size(), 50u);
}

TEST_F(GeometryReportTest, FindsTheBendOfTheWall) {
  for (Eigen::Vector3d& point : points_) point.y() -= 0.030 * std::pow(point.x() / 10.0 - 1.0, 2);
  EXPECT_NEAR(Report().at("wall").at("max_bend_mm"), 14.4, 0.6);  // As in wall_bend_test.cc.
}

TEST_F(GeometryReportTest, SaysNothingOfAWallThatIsNotMarked) {
  WriteSurface("", "", "");
  EXPECT_TRUE(Report().at("wall").is_null());
  truth_.surface.clear();
  const Json report = Report();
  EXPECT_FALSE(report.contains("surface"));
  EXPECT_FALSE(report.contains("wall"));
  EXPECT_TRUE(report.contains("laser"));
}

TEST_F(GeometryReportTest, NamesWhatIsUnusable) {
  std::ofstream(truth_.surface) << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                   "property float y\nproperty float z\nelement face 1\nproperty "
                                   "list uchar int vertex_index\nend_header\n"
                                   "0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n";
  try {
    Report();
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(truth_.surface));
  }
  points_.clear();
  EXPECT_THROW(Report(), std::runtime_error);
}

// A mesh 4 mm before the left half of the wall.
TEST_F(GeometryReportTest, HoldsAMeshAgainstBothTruths) {
  TriangleMesh mesh;
  mesh.vertices = {{0, -0.004, 0}, {10, -0.004, 0}, {10, -0.004, 10}, {0, -0.004, 10}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Json report = Json::object();
  ReportMesh(truth_, test::MakeCamera(), mesh, &report);
  for (const char* truth : {"surface", "laser"}) {
    const Json& of_mesh = report.at("mesh").at(truth);
    EXPECT_EQ(of_mesh.at("accuracy").at("points"), 20'000);
    EXPECT_NEAR(of_mesh.at("accuracy").at("median_mm"), 4.0, 0.3);
    EXPECT_NEAR(of_mesh.at("completeness").at("share_within").at("5 mm"), 0.5, 0.02);
    EXPECT_NEAR(of_mesh.at("f_score").at("5 mm"), 2.0 * 0.5 / 1.5, 0.02);
  }
  mesh.triangles.clear();
  EXPECT_THROW(ReportMesh(truth_, test::MakeCamera(), mesh, &report), std::runtime_error);
}

}  // namespace
}  // namespace plumb::tools
