// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/export/colmap_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "test/export/test_model.h"

namespace plumb {
namespace {

// COLMAP's model as its documentation describes the files, read independently of the writer.
struct ColmapImage {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d translation;
  int camera_id = 0;
  std::string name;
  std::vector<std::pair<Eigen::Vector2d, long>> points2d;
};
struct ColmapPoint {
  Eigen::Vector3d position;
  std::vector<int> color;
  double error = 0.0;
  std::vector<std::pair<int, std::size_t>> track;
};
struct ColmapModel {
  std::string camera_model;
  int width = 0;
  int height = 0;
  std::vector<double> parameters;
  std::map<int, ColmapImage> images;
  std::map<long, ColmapPoint> points;
};

std::vector<std::string> DataLines(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] != '#') lines.push_back(line);
  }
  return lines;
}

ColmapModel ReadModel(const std::string& folder) {
  ColmapModel model;
  int id = 0;
  std::istringstream camera(DataLines(folder + "/cameras.txt").at(0));
  camera >> id >> model.camera_model >> model.width >> model.height;
  for (double value; camera >> value;) model.parameters.push_back(value);
  const std::vector<std::string> image_lines = DataLines(folder + "/images.txt");
  for (std::size_t i = 0; i + 1 < image_lines.size(); i += 2) {
    std::istringstream pose(image_lines[i]);
    pose >> id;
    ColmapImage& image = model.images[id];
    pose >> image.rotation.w() >> image.rotation.x() >> image.rotation.y() >> image.rotation.z();
    pose >> image.translation.x() >> image.translation.y() >> image.translation.z();
    pose >> image.camera_id >> std::ws;
    std::getline(pose, image.name);
    std::istringstream points(image_lines[i + 1]);
    long point = 0;
    for (Eigen::Vector2d pixel; points >> pixel.x() >> pixel.y() >> point;) {
      image.points2d.emplace_back(pixel, point);
    }
  }
  for (const std::string& line : DataLines(folder + "/points3D.txt")) {
    std::istringstream text(line);
    long point_id = 0;
    text >> point_id;
    ColmapPoint& point = model.points[point_id];
    point.color.resize(3);
    text >> point.position.x() >> point.position.y() >> point.position.z();
    text >> point.color[0] >> point.color[1] >> point.color[2] >> point.error;
    std::size_t idx = 0;
    while (text >> id >> idx) point.track.emplace_back(id, idx);
  }
  return model;
}

// COLMAP 3.8, src/base/camera_models.h: PINHOLE, OPENCV and FULL_OPENCV.
Eigen::Vector2d ProjectLikeColmap(const ColmapModel& model, const Eigen::Vector3d& point_in_cam) {
  std::vector<double> p = model.parameters;
  p.resize(12, 0.0);
  const double u = point_in_cam.x() / point_in_cam.z();
  const double v = point_in_cam.y() / point_in_cam.z();
  const double r2 = u * u + v * v;
  const double r4 = r2 * r2;
  const double r6 = r4 * r2;
  const double radial =
      (1 + p[4] * r2 + p[5] * r4 + p[8] * r6) / (1 + p[9] * r2 + p[10] * r4 + p[11] * r6);
  const double du = u * radial + 2 * p[6] * u * v + p[7] * (r2 + 2 * u * u) - u;
  const double dv = v * radial + 2 * p[7] * u * v + p[6] * (r2 + 2 * v * v) - v;
  return {p[0] * (u + du) + p[2], p[1] * (v + dv) + p[3]};
}

class ColmapText : public testing::TestWithParam<std::vector<double>> {
 protected:
  ColmapText() {
    std::string pattern = testing::TempDir() + "colmap_text_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~ColmapText() override { std::filesystem::remove_all(folder_); }

  std::string folder_;
};

TEST_P(ColmapText, PointsProjectedInColmapsConventionFallOnTheirObservations) {
  const Camera camera = MakeCamera(GetParam());
  ExportColmapText(MakeModel(camera), camera, folder_ + "/colmap");
  const ColmapModel model = ReadModel(folder_ + "/colmap");
  ASSERT_EQ(model.images.size(), 5u);
  int num_checked = 0;
  for (const auto& [id, image] : model.images) {
    for (const auto& [pixel, point] : image.points2d) {
      const Eigen::Vector3d point_in_cam =
          image.rotation * model.points.at(point).position + image.translation;
      // Observations are float32: 6e-8 of 640 px.
      EXPECT_LT((ProjectLikeColmap(model, point_in_cam) - pixel).norm(), 1e-4);
      ++num_checked;
    }
  }
  EXPECT_EQ(num_checked, 150);
}

TEST_P(ColmapText, ColmapItselfOpensTheModelAndFindsNoError) {
  if (std::system("command -v colmap > /dev/null 2>&1") != 0) GTEST_SKIP() << "no colmap here";
  const Camera camera = MakeCamera(GetParam());
  ExportColmapText(MakeModel(camera), camera, folder_);
  const std::string log = folder_ + "/log";
  const std::string command =
      "QT_QPA_PLATFORM=offscreen colmap model_analyzer --path " + folder_ + " > " + log + " 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(log);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_THAT(text, testing::HasSubstr("Registered images: 5"));
  EXPECT_THAT(text, testing::HasSubstr("Points: 60"));
  EXPECT_THAT(text, testing::HasSubstr("Observations: 150"));
  EXPECT_THAT(text, testing::HasSubstr("Mean reprojection error: 0.0000"));
}

INSTANTIATE_TEST_SUITE_P(Lenses,
                         ColmapText,
                         testing::Values(std::vector<double>{},
                                         std::vector<double>{-0.05, 0.01, 0.001, -0.002},
                                         std::vector<double>{
                                             0.3, 0.1, 0.001, -0.002, 0.01, 0.35, 0.1, 0.02}));

using ColmapFiles = ColmapText;

TEST_F(ColmapFiles, SayWhatTheMapHolds) {
  const Camera camera = MakeCamera({});
  const MapDelta snapshot = MakeModel(camera);
  ExportColmapText(snapshot, camera, folder_);
  const ColmapModel model = ReadModel(folder_);
  EXPECT_EQ(model.camera_model, "PINHOLE");
  EXPECT_EQ(model.width, 640);
  EXPECT_EQ(model.height, 480);
  EXPECT_THAT(model.parameters, testing::ElementsAre(812.5, 810.25, 322.25, 238.625));
  const ColmapImage& image = model.images.at(5);  // Photo 4, the third view.
  EXPECT_EQ(image.name, "photo 2.jpg");
  EXPECT_EQ(image.camera_id, 1);
  EXPECT_EQ(image.rotation.coeffs(), snapshot.views_set[2].cam_from_map.rotation.coeffs());
  EXPECT_EQ(image.translation, snapshot.views_set[2].cam_from_map.translation);
  ASSERT_EQ(model.points.size(), 60u);
  const ColmapPoint& point = model.points.at(3 * 7 + 1);
  EXPECT_EQ(point.position, snapshot.landmarks_set[7].position_in_map);
  EXPECT_THAT(point.color, testing::ElementsAre(7, 128, 255));
  EXPECT_LT(point.error, 1e-4);
  for (const auto& [id, of_point] : model.points) {
    for (const auto& [image_id, idx] : of_point.track) {
      EXPECT_EQ(model.images.at(image_id).points2d.at(idx).second, id);
    }
  }
}

TEST_F(ColmapFiles, NameTheSmallestModelThatHoldsTheDistortion) {
  const auto model_of = [&](const std::vector<double>& distortion) {
    const Camera camera = MakeCamera(distortion);
    ExportColmapText(MakeModel(camera), camera, folder_);
    const ColmapModel model = ReadModel(folder_);
    return model.camera_model + ' ' + std::to_string(model.parameters.size());
  };
  EXPECT_EQ(model_of({}), "PINHOLE 4");
  EXPECT_EQ(model_of({0.0, 0.0, 0.001}), "OPENCV 8");
  EXPECT_EQ(model_of({0.1, 0.0, 0.0, 0.0, 0.01}), "FULL_OPENCV 12");
  EXPECT_EQ(model_of({0.1, 0.0, 0.0, 0.0, 0.0, 0.1}), "FULL_OPENCV 12");
}

TEST_F(ColmapFiles, CarryTheRefinedLens) {
  const Camera camera = MakeCamera({});
  MapDelta snapshot = MakeModel(camera);
  LensParameters<double> lens = camera.lens();
  lens[kFx] = 900.5;
  snapshot.lens = lens;
  ExportColmapText(snapshot, camera, folder_);
  EXPECT_EQ(ReadModel(folder_).parameters[0], 900.5);
}

TEST_F(ColmapFiles, OfAnEmptyMapAreEmptyAndValid) {
  ExportColmapText(MapDelta(), MakeCamera({}), folder_);
  const ColmapModel model = ReadModel(folder_);
  EXPECT_TRUE(model.images.empty());
  EXPECT_TRUE(model.points.empty());
}

TEST_F(ColmapFiles, AFolderThatCannotBeMadeIsNamed) {
  std::ofstream(folder_ + "/file") << "in the way";
  try {
    ExportColmapText(MapDelta(), MakeCamera({}), folder_ + "/file/colmap");
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(folder_ + "/file/colmap"));
  }
}

}  // namespace
}  // namespace plumb
