// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the marker detector, and prints JSON, a line per result:
//   marker_benchmark scenes N    N markers a rendered scene with known truth, beside ArUco,
//   apriltag marker_benchmark mixed N     N markers of any size, tilt, blur, noise, contrast: wrong
//   IDs marker_benchmark photos DIR  photos without markers, as they are and enlarged to 16
//   megapixels
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/aruco.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "plumbline/common/stopwatch.h"
#include "plumbline/marker/marker_detector.h"
#include "test/support/marker_scene.h"
#include "test/support/random.h"

namespace plumb::test {
namespace {

using Json = nlohmann::ordered_json;

double CpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Found {
  int id;
  Eigen::Vector2d center_px;
};

// One kind of marker with its detector.
class Kind {
 public:
  virtual ~Kind() = default;
  virtual std::string Name() const = 0;
  virtual int NumIds() const = 0;
  virtual Face FaceOf(int id) const = 0;
  virtual double HalfSide() const = 0;  // Of the plate, in outer radii.
  virtual std::vector<Found> Detect(const cv::Mat& gray) const = 0;
};

class CodedRings : public Kind {
 public:
  explicit CodedRings(const Camera* camera) : camera_(camera) {}
  std::string Name() const override { return "plumbline"; }
  int NumIds() const override { return MarkerCodebook::Get().size(); }
  Face FaceOf(int id) const override { return MarkerFace(id); }
  double HalfSide() const override { return kQuietRadius; }
  std::vector<Found> Detect(const cv::Mat& gray) const override {
    const MarkerDetectorOptions options;
    std::vector<Found> found;
    for (const MarkerDetection& detection : DetectMarkers(options, gray, camera_)) {
      found.push_back({detection.id, detection.center_px});
    }
    return found;
  }

 private:
  const Camera* camera_;
};

// A face by its modules, row by row; true is white.
Face ModuleFace(const cv::Mat& modules) {
  return [modules](const Eigen::Vector2d& point) {
    if (point.cwiseAbs().maxCoeff() >= 1.0) return true;
    const int x = static_cast<int>((point.x() + 1.0) * 0.5 * modules.cols);
    const int y = static_cast<int>((point.y() + 1.0) * 0.5 * modules.rows);
    return modules.at<std::uint8_t>(y, x) > 127;
  };
}

class Aruco : public Kind {
 public:
  Aruco() : dictionary_(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_100)) {
    parameters_ = cv::aruco::DetectorParameters::create();
    parameters_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
    parameters_->minMarkerPerimeterRate = 0.01;  // Its default sees no marker below 36 px here.
    parameters_->cornerRefinementWinSize = 2;    // Its default reaches over these markers' modules.
    parameters_->adaptiveThreshWinSizeStep = 4;
  }
  std::string Name() const override { return "aruco 4x4_100"; }
  int NumIds() const override { return 100; }
  Face FaceOf(int id) const override {
    cv::Mat modules;
    cv::aruco::drawMarker(dictionary_, id, 6, modules, 1);
    return ModuleFace(modules);
  }
  double HalfSide() const override { return 1.4; }
  std::vector<Found> Detect(const cv::Mat& gray) const override {
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(gray, dictionary_, corners, ids, parameters_);
    std::vector<Found> found;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      found.push_back({ids[i], DiagonalsMeet(corners[i])});
    }
    return found;
  }

 private:
  static Eigen::Vector2d DiagonalsMeet(const std::vector<cv::Point2f>& corners) {
    std::vector<Eigen::Vector3d> points;
    for (const cv::Point2f& corner : corners) points.emplace_back(corner.x, corner.y, 1.0);
    return points[0].cross(points[2]).cross(points[1].cross(points[3])).hnormalized();
  }

  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  cv::Ptr<cv::aruco::DetectorParameters> parameters_;
};

class Apriltag : public Kind {
 public:
  Apriltag() : family_(tag36h11_create()), detector_(apriltag_detector_create()) {
    apriltag_detector_add_family_bits(detector_, family_, 2);
    detector_->quad_decimate = 1.0F;  // Its default of 2 sees no small tag.
    detector_->nthreads = 2;
  }
  ~Apriltag() override {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }
  Apriltag(const Apriltag&) = delete;
  Apriltag& operator=(const Apriltag&) = delete;
  std::string Name() const override { return "apriltag 36h11"; }
  int NumIds() const override { return 100; }
  Face FaceOf(int id) const override {
    image_u8_t* image = apriltag_to_image(family_, static_cast<std::uint32_t>(id));
    cv::Mat modules(8, 8, CV_8U);  // Without the white border of one module.
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        modules.at<std::uint8_t>(y, x) = image->buf[(y + 1) * image->stride + x + 1];
      }
    }
    std::free(image->buf);
    std::free(image);  // Debian's library does not export image_u8_destroy.
    return ModuleFace(modules);
  }
  double HalfSide() const override { return 1.25; }
  std::vector<Found> Detect(const cv::Mat& gray) const override {
    image_u8_t image = {gray.cols, gray.rows, static_cast<int32_t>(gray.step), gray.data};
    zarray_t* detections = apriltag_detector_detect(detector_, &image);
    std::vector<Found> found;
    for (int i = 0; i < zarray_size(detections); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(detections, i, &detection);
      // Its pixel (0, 0) begins at the origin.
      found.push_back({detection->id, {detection->c[0] - 0.5, detection->c[1] - 0.5}});
    }
    apriltag_detections_destroy(detections);
    return found;
  }

 private:
  apriltag_family_t* family_;
  apriltag_detector_t* detector_;
};

struct Scene {
  std::string name;
  double diameter_px = 30.0;
  double min_diameter_px = 0.0;  // If not 0, diameters are drawn from here to diameter_px.
  double min_tilt_deg = 0.0;
  double max_tilt_deg = 0.0;
  PhotoConditions conditions;
};

struct Tally {
  int num_shown = 0;
  int num_found = 0;
  int num_wrong = 0;
  std::vector<double> errors_px;
  double cpu_s = 0.0;
  int num_photos = 0;
};

Camera MakeCamera() {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 1000.0;
  lens[kCx] = 639.5;
  lens[kCy] = 479.5;
  return Camera("bench", 1280, 960, DistortionModel::kPlumbBob, lens);
}

void MeasurePhoto(
    const Kind& kind, const Scene& scene, const Camera& camera, int seed, Tally* tally) {
  Random random(seed);
  std::vector<PlacedFace> faces;
  std::vector<Found> truth;
  const int spacing_px = scene.diameter_px > 50.0 ? 240 : 120;
  const int num_columns = camera.width_px() / spacing_px;
  const int num_rows = camera.height_px() / spacing_px;
  for (int i = 0; i < num_columns * num_rows; ++i) {
    const Eigen::Vector2d pixel(spacing_px * (i % num_columns + 0.5 + random.Uniform(0.0, 0.05)),
                                spacing_px * (i / num_columns + 0.5 + random.Uniform(0.0, 0.05)));
    const int id = random.Index(kind.NumIds());
    const double tilt_rad =
        random.Uniform(scene.min_tilt_deg, scene.max_tilt_deg + 1e-9) * M_PI / 180.0;
    const double diameter_px = scene.min_diameter_px > 0.0
                                   ? random.Uniform(scene.min_diameter_px, scene.diameter_px)
                                   : scene.diameter_px;
    const Rigid3 placed = PlaceMarker(
        camera, pixel, diameter_px, tilt_rad, random.Uniform(0.0, 6.28), random.Uniform(0.0, 6.28));
    faces.push_back({kind.FaceOf(id), placed, kind.HalfSide()});
    truth.push_back({id, pixel});
  }
  PhotoConditions conditions = scene.conditions;
  conditions.seed = static_cast<std::uint32_t>(seed);
  const cv::Mat gray = RenderPhoto(camera, faces, conditions);
  const double before_s = CpuSeconds();
  const std::vector<Found> found = kind.Detect(gray);
  tally->cpu_s += CpuSeconds() - before_s;
  ++tally->num_photos;
  tally->num_shown += static_cast<int>(truth.size());
  for (const Found& detection : found) {
    bool is_right = false;
    for (const Found& marker : truth) {
      const double error_px = (marker.center_px - detection.center_px).norm();
      if (marker.id != detection.id || error_px > 3.0) continue;
      is_right = true;
      tally->errors_px.push_back(error_px);
    }
    (is_right ? tally->num_found : tally->num_wrong) += 1;
  }
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
          {"shown", tally.num_shown},
          {"rate", static_cast<double>(tally.num_found) / tally.num_shown},
          {"wrong", tally.num_wrong},
          {"mean_error_px", sum / count},
          {"p95_error_px", quantile(0.95)},
          {"max_error_px", quantile(1.0)},
          {"cpu_s_per_megapixel", tally.cpu_s / tally.num_photos / 1.2288}};
}

std::vector<Scene> Scenes() {
  std::vector<Scene> scenes;
  for (const double diameter_px : {8.0, 10.0, 12.0, 14.0, 16.0, 20.0, 24.0, 30.0, 40.0, 80.0}) {
    Scene scene;
    scene.name = "frontal " + std::to_string(static_cast<int>(diameter_px)) + " px";
    scene.diameter_px = diameter_px;
    scenes.push_back(scene);
  }
  for (const double tilt_deg : {30.0, 45.0, 60.0}) {
    for (const double diameter_px : {30.0, 40.0, 80.0}) {
      Scene scene;
      scene.name = "tilt " + std::to_string(static_cast<int>(tilt_deg)) + " deg, " +
                   std::to_string(static_cast<int>(diameter_px)) + " px";
      scene.diameter_px = diameter_px;
      scene.min_tilt_deg = scene.max_tilt_deg = tilt_deg;
      scenes.push_back(scene);
    }
  }
  for (const double diameter_px : {16.0, 24.0, 30.0}) {
    Scene scene;
    scene.name = "blur 1.5 px, noise 5, contrast 80, " +
                 std::to_string(static_cast<int>(diameter_px)) + " px";
    scene.diameter_px = diameter_px;
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
        MeasurePhoto(*kind, scene, camera, photo + 1, &tally);
      }
      std::cout << Summary(*kind, scene, tally).dump() << std::endl;
    }
  }
}

// Conditions change from photo to photo.
void MeasureMixed(int num_markers, const Camera& camera) {
  const CodedRings kind(nullptr);
  Scene scene;
  scene.name = "mixed";
  scene.min_diameter_px = 8.0;
  scene.diameter_px = 50.0;
  scene.max_tilt_deg = 70.0;
  scene.conditions.samples_per_axis = 4;
  Tally tally;
  for (int photo = 0; tally.num_shown < num_markers; ++photo) {
    Random random(1000000 + photo);
    scene.conditions.blur_px = random.Uniform(0.4, 1.8);
    scene.conditions.noise = random.Uniform(0.5, 8.0);
    scene.conditions.black = random.Uniform(20.0, 90.0);
    scene.conditions.white = random.Uniform(scene.conditions.black + 40.0, 240.0);
    scene.conditions.background = random.Uniform(20.0, 240.0);
    MeasurePhoto(kind, scene, camera, photo + 1, &tally);
  }
  std::cout << Summary(kind, scene, tally).dump() << std::endl;
}

void MeasurePhotos(const std::string& folder) {
  std::vector<cv::String> paths;
  cv::glob(folder, paths, true);
  for (const double megapixels : {0.0, 16.0}) {
    int num_photos = 0;
    int num_found = 0;
    double cpu_s = 0.0;
    double wall_s = 0.0;
    for (const cv::String& path : paths) {
      cv::Mat gray = cv::imread(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
      if (gray.empty()) continue;
      if (megapixels > 0.0) {
        const double scale = std::sqrt(megapixels * 1e6 / static_cast<double>(gray.total()));
        cv::resize(gray, gray, {}, scale, scale, cv::INTER_CUBIC);
      }
      const double before_s = CpuSeconds();
      const Stopwatch stopwatch;
      num_found += static_cast<int>(DetectMarkers({}, gray).size());
      wall_s += stopwatch.Seconds();
      cpu_s += CpuSeconds() - before_s;
      ++num_photos;
    }
    const double count = std::max(1, num_photos);
    const Json result = {{"photos", num_photos},
                         {"megapixels", megapixels},
                         {"found", num_found},
                         {"cpu_s", cpu_s / count},
                         {"wall_s", wall_s / count}};
    std::cout << result.dump() << std::endl;
  }
}

}  // namespace
}  // namespace plumb::test

int main(int argc, char** argv) {
  using namespace plumb::test;
  const std::string what = argc == 3 ? argv[1] : "";
  const plumb::Camera camera = MakeCamera();
  if (what == "scenes") {
    MeasureScenes(std::stoi(argv[2]), camera);
  } else if (what == "mixed") {
    MeasureMixed(std::stoi(argv[2]), camera);
  } else if (what == "photos") {
    MeasurePhotos(argv[2]);
  } else {
    std::cerr << "usage: marker_benchmark scenes|mixed NUMBER, or photos FOLDER\n";
    return 2;
  }
  return 0;
}
