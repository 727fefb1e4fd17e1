// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the marker detector, and prints JSON, a line a result. The first argument is what:
//   scenes N    N markers in each rendered scene with known truth, beside ArUco and apriltag
//   frontal N   N markers of 16 px and N of 24 px, seen from the front: rates to a thousandth
//   mixed N     N markers of any size, tilt, blur, noise, contrast: are there wrong IDs?
//   photos DIR  photos without markers: is any seen? And the time of 16 megapixels
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "plumbline/common/stopwatch.h"
#include "plumbline/marker/marker_detector.h"
#include "test/benchmark/marker_kinds.h"
#include "test/support/marker_scene.h"
#include "test/support/photo_mosaic.h"
#include "test/support/random.h"

namespace plumb::test {
namespace {

using Json = nlohmann::ordered_json;

double CpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Scene {
  std::string name;
  double diameter_px = 30.0;
  double min_diameter_px = 0.0;  // If not 0, diameters are drawn from here to diameter_px.
  double min_tilt_deg = 0.0;
  double max_tilt_deg = 0.0;
  int spacing_px = 120;
  PhotoConditions conditions;
};

struct Tally {
  int num_shown = 0;
  int num_found = 0;  // Shown ones; a marker that is given twice counts once.
  int num_wrong = 0;  // Given where none with this ID is shown.
  std::vector<double> errors_px;
  double cpu_s = 0.0;
  double megapixels = 0.0;
};

Camera MakeCamera() {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 1000.0;
  lens[kCx] = 639.5;
  lens[kCy] = 479.5;
  return Camera("bench", 1280, 960, DistortionModel::kPlumbBob, lens);
}

constexpr double kMaxErrorPx = 3.0;  // Further off it is another marker's.

struct Photo {
  cv::Mat gray;
  std::vector<Found> truth;
};

// Markers on a grid, each placed and turned at random.
Photo RenderScene(const Kind& kind, const Scene& scene, const Camera& camera, int seed) {
  Random random(seed);
  std::vector<PlacedFace> faces;
  Photo photo;
  const int num_columns = camera.width_px() / scene.spacing_px;
  const int num_rows = camera.height_px() / scene.spacing_px;
  for (int i = 0; i < num_columns * num_rows; ++i) {
    const Eigen::Vector2d cell(i % num_columns, i / num_columns);
    const Eigen::Vector2d jitter(random.Uniform(0.5, 0.55), random.Uniform(0.5, 0.55));
    const Eigen::Vector2d pixel = scene.spacing_px * (cell + jitter);
    const int id = random.Index(kind.NumIds());
    const double tilt_deg = random.Uniform(scene.min_tilt_deg, scene.max_tilt_deg + 1e-9);
    const double diameter_px = scene.min_diameter_px > 0.0
                                   ? random.Uniform(scene.min_diameter_px, scene.diameter_px)
                                   : scene.diameter_px;
    const double axis_rad = random.Uniform(0.0, 2.0 * M_PI);
    const double turn_rad = random.Uniform(0.0, 2.0 * M_PI);
    faces.push_back(
        {kind.FaceOf(id),
         PlaceMarker(camera, pixel, diameter_px, tilt_deg * M_PI / 180.0, axis_rad, turn_rad),
         kind.HalfSide()});
    photo.truth.push_back({id, pixel});
  }
  PhotoConditions conditions = scene.conditions;
  conditions.seed = static_cast<std::uint32_t>(seed);
  photo.gray = RenderPhoto(camera, faces, conditions);
  return photo;
}

void MeasurePhoto(const Kind& kind, const Photo& photo, Tally* tally) {
  const double before_s = CpuSeconds();
  const std::vector<Found> found = kind.Detect(photo.gray);
  tally->cpu_s += CpuSeconds() - before_s;
  tally->megapixels += 1e-6 * static_cast<double>(photo.gray.total());
  tally->num_shown += static_cast<int>(photo.truth.size());
  std::vector<bool> is_found(photo.truth.size(), false);
  for (const Found& detection : found) {
    bool is_right = false;
    for (std::size_t i = 0; i < photo.truth.size(); ++i) {
      const double error_px = (photo.truth[i].center_px - detection.center_px).norm();
      if (photo.truth[i].id != detection.id || error_px > kMaxErrorPx) continue;
      is_right = true;
      if (!is_found[i]) tally->errors_px.push_back(error_px);
      is_found[i] = true;
    }
    if (!is_right) ++tally->num_wrong;
  }
  tally->num_found += static_cast<int>(std::count(is_found.begin(), is_found.end(), true));
}

Json Summary(const Kind& kind, const Scene& scene, Tally tally) {
  std::sort(tally.errors_px.begin(), tally.errors_px.end());
  double sum = 0.0;
  for (const double error_px : tally.errors_px) sum += error_px;
  const double count = std::max<double>(1.0, static_cast<double>(tally.errors_px.size()));
  const auto quantile = [&](double share) {
    return tally.errors_px.empty()
               ? 0.0
               : tally.errors_px[static_cast<std::size_t>(share * (count - 1.0))];
  };
  return {{"scene", scene.name},
          {"detector", kind.Name()},
          {"diameter_px", scene.diameter_px},
          {"tilt_deg", scene.max_tilt_deg},
          {"shown", tally.num_shown},
          {"rate", static_cast<double>(tally.num_found) / tally.num_shown},
          {"wrong", tally.num_wrong},
          {"mean_error_px", sum / count},
          {"p95_error_px", quantile(0.95)},
          {"max_error_px", quantile(1.0)},
          {"cpu_s_per_megapixel", tally.cpu_s / tally.megapixels}};
}

Scene MakeScene(const std::string& name, double diameter_px, double tilt_deg) {
  Scene scene;
  scene.name = name;
  scene.diameter_px = diameter_px;
  scene.min_tilt_deg = scene.max_tilt_deg = tilt_deg;
  if (diameter_px > 50.0) scene.spacing_px = 240;
  return scene;
}

// The usual noise and blur are PhotoConditions' own.
std::vector<Scene> Scenes() {
  std::vector<Scene> scenes;
  for (const double diameter_px :
       {9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 16.0, 20.0, 24.0, 30.0, 40.0, 80.0}) {
    scenes.push_back(MakeScene("frontal", diameter_px, 0.0));
  }
  for (const double tilt_deg : {30.0, 45.0, 60.0}) {
    for (const double diameter_px : {24.0, 30.0, 40.0, 80.0}) {
      scenes.push_back(MakeScene("tilted", diameter_px, tilt_deg));
    }
  }
  for (const double diameter_px : {16.0, 24.0, 30.0}) {
    Scene scene = MakeScene("blur 1.5 px, noise 5, contrast 80", diameter_px, 0.0);
    scene.conditions.blur_px = 1.5;
    scene.conditions.noise = 5.0;
    scene.conditions.black = 60.0;
    scene.conditions.white = 140.0;
    scenes.push_back(scene);
  }
  return scenes;
}

void MeasureScenes(int num_markers, const Camera& camera) {
  std::vector<std::unique_ptr<Kind>> kinds;
  kinds.push_back(std::make_unique<CodedRings>(nullptr));
  kinds.push_back(std::make_unique<Aruco>());
  kinds.push_back(std::make_unique<Apriltag>());
  for (const Scene& scene : Scenes()) {
    for (const std::unique_ptr<Kind>& kind : kinds) {
      Tally tally;
      for (int photo = 0; tally.num_shown < num_markers; ++photo) {
        MeasurePhoto(*kind, RenderScene(*kind, scene, camera, photo + 1), &tally);
      }
      std::cout << Summary(*kind, scene, tally).dump() << std::endl;
    }
  }
}

// Close together, for there are many.
void MeasureFrontal(int num_markers, const Camera& camera) {
  const CodedRings kind(nullptr);
  for (const double diameter_px : {16.0, 24.0}) {
    Scene scene = MakeScene("frontal", diameter_px, 0.0);
    scene.spacing_px = 64;
    scene.conditions.samples_per_axis = 4;
    Tally tally;
    for (int photo = 0; tally.num_shown < num_markers; ++photo) {
      MeasurePhoto(kind, RenderScene(kind, scene, camera, photo + 1), &tally);
    }
    std::cout << Summary(kind, scene, tally).dump() << std::endl;
  }
}

// Conditions change from photo to photo. The results so far are said again and again.
void MeasureMixed(int num_markers, const Camera& camera) {
  const CodedRings kind(nullptr);
  Scene scene = MakeScene("mixed", 50.0, 70.0);
  scene.min_diameter_px = 8.0;
  scene.min_tilt_deg = 0.0;
  scene.spacing_px = 80;
  scene.conditions.samples_per_axis = 4;
  constexpr int kPhotosPerResult = 25;
  Tally tally;
  for (int photo = 0; tally.num_shown < num_markers; ++photo) {
    if (photo % kPhotosPerResult == kPhotosPerResult - 1) {
      std::cout << Summary(kind, scene, tally).dump() << std::endl;
    }
    Random random(1000000 + photo);
    scene.conditions.blur_px = random.Uniform(0.4, 1.8);
    scene.conditions.noise = random.Uniform(0.5, 8.0);
    scene.conditions.black = random.Uniform(20.0, 90.0);
    scene.conditions.white = random.Uniform(scene.conditions.black + 40.0, 240.0);
    scene.conditions.background = random.Uniform(20.0, 240.0);
    MeasurePhoto(kind, RenderScene(kind, scene, camera, photo + 1), &tally);
  }
  std::cout << Summary(kind, scene, tally).dump() << std::endl;
}

struct PhotoTally {
  int num_photos = 0;
  double megapixels = 0.0;
  int num_found = 0;
  double cpu_s = 0.0;
  double wall_s = 0.0;
};

void MeasureEmptyPhoto(const cv::Mat& gray, PhotoTally* tally) {
  const double before_s = CpuSeconds();
  const Stopwatch stopwatch;
  tally->num_found += static_cast<int>(DetectMarkers({}, gray).size());
  tally->wall_s += stopwatch.Seconds();
  tally->cpu_s += CpuSeconds() - before_s;
  tally->megapixels += 1e-6 * static_cast<double>(gray.total());
  ++tally->num_photos;
}

Json Summary(const PhotoTally& tally) {
  const double count = std::max(1, tally.num_photos);
  return {{"photos", tally.num_photos},
          {"megapixels", tally.megapixels / count},
          {"found", tally.num_found},
          {"cpu_s", tally.cpu_s / count},
          {"wall_s", tally.wall_s / count}};
}

void MeasurePhotos(const std::string& folder) {
  constexpr int kMaxMosaics = 8;
  const cv::Size mosaic_size(4608, 3456);  // 16 megapixels.
  std::vector<cv::String> paths;
  cv::glob(folder, paths, true);
  PhotoTally originals;
  PhotoTally mosaics;
  for (const cv::String& path : paths) {
    const cv::Mat gray = cv::imread(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    if (gray.empty()) continue;
    MeasureEmptyPhoto(gray, &originals);
    if (mosaics.num_photos < kMaxMosaics) {
      MeasureEmptyPhoto(Mosaic(gray, mosaic_size), &mosaics);
    }
  }
  const Json result = {{"originals", Summary(originals)}, {"mosaics", Summary(mosaics)}};
  std::cout << result.dump() << std::endl;
}

}  // namespace
}  // namespace plumb::test

int main(int argc, char** argv) {
  using namespace plumb::test;
  const std::string what = argc == 3 ? argv[1] : "";
  const plumb::Camera camera = MakeCamera();
  if (what == "scenes") {
    MeasureScenes(std::stoi(argv[2]), camera);
  } else if (what == "frontal") {
    MeasureFrontal(std::stoi(argv[2]), camera);
  } else if (what == "mixed") {
    MeasureMixed(std::stoi(argv[2]), camera);
  } else if (what == "photos") {
    MeasurePhotos(argv[2]);
  } else {
    std::cerr << "usage: marker_benchmark scenes|frontal|mixed NUMBER, or photos FOLDER\n";
    return 2;
  }
  return 0;
}
