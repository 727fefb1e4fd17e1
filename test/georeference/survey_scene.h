// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/similarity3.h"
#include "plumbline/georeference/georeferencer.h"
#include "test/support/synthetic_scene.h"

namespace plumb::test {

struct SurveySceneOptions {
  int num_targets = 17;
  double width_m = 50.0;
  double height_m = 30.0;
  double relief_m = 0.5;   // Targets lie up to so far behind the facade's plane.
  double noise_px = 0.05;  // Of a marker's centre, each axis.
  double survey_sigma_m = 0.001;
  double gps_sigma_m = 0.0;
  int num_columns = 12;  // Of photos, in three rows.
  int random_seed = 1;
};

// A flight along a facade with surveyed markers, in a map of its own.
struct SurveyScene {
  Camera camera = MakeCamera(-0.05, 0.02);
  Similarity3 map_from_enu;
  Survey survey;
  std::vector<Eigen::Vector3d> targets_in_enu;  // As they truly hang; index = id.
  MapDelta map;                                 // A snapshot with views and landmarks.
  std::vector<Rigid3> cams_from_enu;
  std::map<PhotoId, std::vector<MarkerDetection>> markers;
};

inline Similarity3 MakeMapFromEnu() {
  return {0.137,
          Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, -0.05, 1).normalized())),
          {3.0, -5.0, 2.0}};
}

inline MarkerDetection MakeDetection(int id, const Eigen::Vector2d& pixel, double diameter_px) {
  MarkerDetection marker;
  marker.id = id;
  marker.center_px = pixel;
  marker.center_covariance_px2 = 0.05 * 0.05 * Eigen::Matrix2d::Identity();
  marker.ellipse.semi_major_px = 0.5 * diameter_px;
  marker.ellipse.semi_minor_px = 0.5 * diameter_px;
  return marker;
}

// Photographs the markers anew, e.g. after targets_in_enu has changed.
inline void TakePhotos(const SurveySceneOptions& options, SurveyScene* scene) {
  constexpr double kDiameter_m = 0.5;
  Random random(options.random_seed + 1);
  scene->markers.clear();
  for (std::size_t k = 0; k < scene->cams_from_enu.size(); ++k) {
    std::vector<MarkerDetection>& markers = scene->markers[{static_cast<std::uint32_t>(k)}];
    for (std::size_t i = 0; i < scene->targets_in_enu.size(); ++i) {
      const Eigen::Vector3d in_cam = scene->cams_from_enu[k] * scene->targets_in_enu[i];
      const auto pixel = scene->camera.Project(in_cam);
      if (!pixel || !scene->camera.IsInImage(*pixel)) continue;
      const double diameter_px = scene->camera.MeanFocalLength() * kDiameter_m / in_cam.z();
      markers.push_back(MakeDetection(
          static_cast<int>(i), *pixel + random.Normal2(options.noise_px), diameter_px));
    }
  }
}

inline SurveyScene MakeSurveyScene(const SurveySceneOptions& options = {}) {
  Random random(options.random_seed);
  SurveyScene scene;
  scene.map_from_enu = MakeMapFromEnu();
  for (int i = 0; i < options.num_targets; ++i) {
    // Evenly over the facade, every third a check point.
    const double x = options.width_m * ((i * 7) % options.num_targets + 0.5) / options.num_targets;
    const double z = options.height_m * (i + 0.5) / options.num_targets;
    scene.targets_in_enu.emplace_back(x, random.Uniform(0.0, options.relief_m), z);
    SurveyTarget target;
    target.id = i;
    target.name = std::to_string(i);
    const double sigma = options.survey_sigma_m;
    const double dx = random.Normal(sigma);
    const double dy = random.Normal(sigma);
    target.point_in_crs =
        scene.targets_in_enu.back() + Eigen::Vector3d(dx, dy, random.Normal(sigma));
    target.sigma_m = sigma;
    target.is_check = i % 3 == 2;
    scene.survey.targets.push_back(target);
  }
  scene.survey.source = "survey.csv";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < options.num_columns; ++column) {
      const Eigen::Vector3d center(
          options.width_m * column / (options.num_columns - 1.0), -9.0 - row, 5.0 + 10.0 * row);
      const Eigen::Quaterniond rotation =
          Eigen::AngleAxisd(random.Uniform(-0.15, 0.15), Eigen::Vector3d::UnitY()) * FacingFacade();
      scene.cams_from_enu.emplace_back(rotation, -(rotation * center));
    }
  }
  scene.map.is_snapshot = true;
  scene.map.sequence = 7;
  for (std::size_t k = 0; k < scene.cams_from_enu.size(); ++k) {
    scene.map.views_set.push_back({{static_cast<std::uint32_t>(k)},
                                   std::to_string(k) + ".jpg",
                                   {},
                                   TransformCamera(scene.map_from_enu, scene.cams_from_enu[k])});
  }
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const double x = random.Uniform(0.0, options.width_m);
    const double y = random.Uniform(0.0, options.relief_m);
    const Eigen::Vector3d in_enu(x, y, random.Uniform(0.0, options.height_m));
    scene.map.landmarks_set.push_back({{i}, scene.map_from_enu * in_enu, {0, 0, 0}});
  }
  TakePhotos(options, &scene);
  return scene;
}

inline Georeferencer MakeGeoreferencer(const SurveyScene& scene,
                                       const GeoreferencerOptions& options = {}) {
  Georeferencer georeferencer(options, scene.camera);
  georeferencer.Apply(scene.map);
  for (const auto& [photo, markers] : scene.markers) georeferencer.SetMarkers(photo, markers);
  georeferencer.SetSurvey(scene.survey);
  return georeferencer;
}

inline const Finding* FindFinding(const Georeference& georeference, const std::string& code) {
  for (const Finding& finding : georeference.findings) {
    if (finding.code == code) return &finding;
  }
  return nullptr;
}

}  // namespace plumb::test
