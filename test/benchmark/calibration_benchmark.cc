// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Calibration against truth, as JSON on standard output:
//   calibration_benchmark photos DIR TRUTH.yaml [a4|a3|-] [HIDDEN_SHARE]   rendered photos
//   calibration_benchmark sets NUM sound|troubled         beside cv::calibrateCamera, and where
//                                                         the error functions have their minima
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "calibration/lens_accuracy.h"
#include "plumbline/calibration/calibrator.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/image/gray_photo.h"
#include "plumbline/marker/marker_sheet.h"
#include "test/support/calibration_scene.h"

namespace {

using namespace plumb;
using Json = nlohmann::ordered_json;

constexpr double kSheetDiameter_m = 0.032;  // Of the fixed A4 grid.

Json ErrorsOf(const LensParameters<double>& lens, const Camera& truth) {
  const LensParameters<double>& t = truth.lens();
  return {{"focal_percent", 100.0 * std::abs(lens[kFx] / t[kFx] - 1.0)},
          {"principal_px", std::hypot(lens[kCx] - t[kCx], lens[kCy] - t[kCy])},
          {"distortion_px", DistortionDifference(truth.width_px(), truth.height_px(), t, lens)}};
}

Json ErrorsOf(const CalibrationResult& result, const Camera& truth) {
  Json json = result.estimate ? ErrorsOf(result.estimate->camera.lens(), truth) : Json::object();
  json["verdict"] = ToString(result.verdict);
  json["advice"] = result.advice;
  if (result.estimate) {
    json["focal_sigma_percent"] = result.estimate->focal_sigma_percent;
    json["principal_sigma_px"] = result.estimate->principal_sigma_px;
    json["distortion_sigma_px"] = result.estimate->distortion_sigma_px;
  }
  json["rms_px"] = result.rms_px;
  json["noise_factor"] = result.noise_factor;
  json["findings"] = Json::array();
  for (const CalibrationFinding& finding : result.findings) {
    json["findings"].push_back({{"kind", ToString(finding.kind)}, {"text", finding.text}});
  }
  return json;
}

// ---- Rendered photos ----

struct Occlusion {
  std::string photo;
  cv::Rect where;
};

// Over a share of the markers something grey lies: over all of it or a part.
std::vector<Occlusion> Occlude(const std::vector<CalibrationPhoto>& photos,
                               double share,
                               test::Random* random) {
  std::vector<Occlusion> occlusions;
  for (const CalibrationPhoto& photo : photos) {
    for (const MarkerDetection& marker : photo.markers) {
      if (random->Uniform(0.0, 1.0) >= share) continue;
      const double reach = marker.ellipse.semi_major_px;
      const double from = random->Uniform(-1.3, 0.7) * reach;
      occlusions.push_back({photo.name,
                            {static_cast<int>(marker.center_px.x() + from),
                             static_cast<int>(marker.center_px.y() - 1.4 * reach),
                             static_cast<int>(2.8 * reach),
                             static_cast<int>(2.8 * reach)}});
    }
  }
  return occlusions;
}

std::vector<CalibrationPhoto> Detect(const std::string& folder,
                                     const std::vector<Occlusion>& occlusions,
                                     const Camera* camera) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<CalibrationPhoto> photos;
  for (const std::filesystem::path& path : paths) {
    GrayPhoto decoded = DecodeGrayPhoto(ReadFileBytes(path));
    if (!decoded.problem.empty()) throw std::runtime_error(path.string() + ": " + decoded.problem);
    for (const Occlusion& occlusion : occlusions) {
      if (occlusion.photo == path.filename()) {
        cv::rectangle(decoded.gray, occlusion.where, cv::Scalar(120), cv::FILLED);
      }
    }
    photos.push_back({path.filename(),
                      decoded.gray.cols,
                      decoded.gray.rows,
                      DetectMarkers({}, decoded.gray, camera),
                      camera != nullptr});
  }
  return photos;
}

Json CalibratePhotos(const std::string& folder,
                     const Camera& truth,
                     const CalibrationOptions& options,
                     double hidden_share) {
  test::Random random(1);
  std::vector<Occlusion> occlusions;
  if (hidden_share > 0.0) occlusions = Occlude(Detect(folder, {}, nullptr), hidden_share, &random);
  const std::vector<CalibrationPhoto> photos = Detect(folder, occlusions, nullptr);
  std::size_t num_markers = 0;
  for (const CalibrationPhoto& photo : photos) num_markers += photo.markers.size();
  const Stopwatch stopwatch;
  const CalibrationResult once = CalibrateCamera(options, photos);
  Json json = {{"photos", photos.size()},
               {"markers", num_markers},
               {"hidden", occlusions.size()},
               {"wall_s", stopwatch.Seconds()},
               {"once", ErrorsOf(once, truth)}};
  if (once.estimate) {
    json["twice"] = ErrorsOf(
        CalibrateCamera(options, Detect(folder, occlusions, &once.estimate->camera)), truth);
  }
  return json;
}

// ---- Random sets ----

// A camera of 54 to 100 degrees of view and a plausible lens.
Camera RandomCamera(test::Random* random) {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = random->Uniform(0.55, 1.2) * 2000.0;
  lens[kCx] = 999.5 + random->Normal(8.0);
  lens[kCy] = 666.0 + random->Normal(8.0);
  // At most so much at the corner, whatever the field.
  const double radius2 = std::pow(1200.0 / lens[kFx], 2);
  lens[kK1] = random->Uniform(-0.12, 0.04) / radius2;
  lens[kK2] = random->Uniform(-0.01, 0.03) / (radius2 * radius2);
  lens[kP1] = random->Normal(0.0004);
  lens[kP2] = random->Normal(0.0004);
  return test::CalibrationCamera(lens);
}

struct GridSet {
  Camera camera;
  std::vector<CalibrationPhoto> photos;
};

// Photos of the fixed A4 grid. Troubled: printed 0.1 % too long, bent by up to 3 mm, a tenth of the
// markers hidden, one in fifty seen half a pixel off.
GridSet MakeGridSet(int seed, bool is_troubled) {
  test::Random random(5000 + seed);
  GridSet set{RandomCamera(&random), {}};
  const double bend = is_troubled ? random.Uniform(0.0, 0.003) / kSheetDiameter_m : 0.0;
  const MarkerSheet sheet = LayOutGrid(Paper::kA4, Arrangement::kFixed, 0);
  std::vector<test::ScenePlate> plates;
  for (const PrintedMarker& marker : sheet.markers) {
    const Eigen::Vector2d center = (marker.center_mm - 0.5 * sheet.page_mm) / sheet.diameter_mm;
    const double height = bend * (1.0 - std::pow(center.x() / 2.7, 2));
    plates.push_back(
        {marker.id, {center.x(), (is_troubled ? -1.001 : -1.0) * center.y(), height}, 0.0});
  }
  test::CalibrationSceneOptions scene;
  scene.camera = set.camera;
  scene.num_photos = 8 + random.Index(7);
  scene.max_tilt_deg = random.Uniform(30.0, 50.0);
  scene.hidden_share = is_troubled ? 0.1 : 0.0;
  scene.random_seed = seed;
  set.photos = test::PhotographPlates(scene, plates);
  for (CalibrationPhoto& photo : set.photos) {
    for (MarkerDetection& marker : photo.markers) {
      if (is_troubled && random.Uniform(0.0, 1.0) < 0.02) marker.center_px += random.Normal2(0.5);
    }
  }
  return set;
}

// The same model, square pixels, from its own start.
LensParameters<double> CalibrateWithOpenCv(const GridSet& set) {
  const MarkerSheet sheet = LayOutGrid(Paper::kA4, Arrangement::kFixed, 0);
  std::vector<std::vector<cv::Point3f>> objects;
  std::vector<std::vector<cv::Point2f>> images;
  for (const CalibrationPhoto& photo : set.photos) {
    if (photo.markers.size() < 4) continue;
    objects.emplace_back();
    images.emplace_back();
    for (const MarkerDetection& marker : photo.markers) {
      const Eigen::Vector2d& at_mm = sheet.markers[static_cast<std::size_t>(marker.id)].center_mm;
      objects.back().emplace_back(at_mm.x(), -at_mm.y(), 0.0);
      images.back().emplace_back(marker.center_px.x(), marker.center_px.y());
    }
  }
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);  // CALIB_FIX_ASPECT_RATIO takes fx / fy from it.
  cv::Mat distortion;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::calibrateCamera(objects,
                      images,
                      {set.camera.width_px(), set.camera.height_px()},
                      matrix,
                      distortion,
                      rotations,
                      translations,
                      cv::CALIB_FIX_ASPECT_RATIO);
  LensParameters<double> lens{};
  lens[kFx] = matrix.at<double>(0, 0);
  lens[kFy] = matrix.at<double>(1, 1);
  lens[kCx] = matrix.at<double>(0, 2);
  lens[kCy] = matrix.at<double>(1, 2);
  for (int i = 0; i < 5; ++i) lens[static_cast<std::size_t>(kK1 + i)] = distortion.at<double>(i);
  return lens;
}

// ---- Error functions ----

// Zhang's constraints on the homographies from the known grid: columns orthogonal and of one
// length.
double OrthonormalityError(const GridSet& set, double focal_px) {
  const MarkerSheet sheet = LayOutGrid(Paper::kA4, Arrangement::kFixed, 0);
  double sum = 0.0;
  for (const CalibrationPhoto& photo : set.photos) {
    if (photo.markers.size() < 4) continue;
    std::vector<cv::Point2d> from;
    std::vector<cv::Point2d> to;
    for (const MarkerDetection& marker : photo.markers) {
      const Eigen::Vector2d& at_mm = sheet.markers[static_cast<std::size_t>(marker.id)].center_mm;
      from.emplace_back(at_mm.x(), -at_mm.y());
      to.emplace_back((marker.center_px.x() - 999.5) / focal_px,
                      (marker.center_px.y() - 666.0) / focal_px);
    }
    const cv::Matx33d h = cv::findHomography(from, to);
    const cv::Vec3d a(h(0, 0), h(1, 0), h(2, 0));
    const cv::Vec3d b(h(0, 1), h(1, 1), h(2, 1));
    const double aa = a.dot(a);
    const double bb = b.dot(b);
    sum += std::pow(a.dot(b), 2) / (aa * bb) + std::pow((aa - bb) / (aa + bb), 2);
  }
  return sum;
}

double BestOf(const CalibrationOptions& options, const std::function<double(double)>& error) {
  double best_px = 0.0;
  double least = std::numeric_limits<double>::infinity();
  const double range = options.max_focal_per_width / options.min_focal_per_width;
  for (int i = 0; i < options.num_focal_steps; ++i) {
    const double focal_px =
        2000.0 * options.min_focal_per_width * std::pow(range, i / (options.num_focal_steps - 1.0));
    const double value = error(focal_px);
    if (value >= least) continue;
    least = value;
    best_px = focal_px;
  }
  return best_px;
}

// Where the minima of the error functions lie, off the truth in percent.
Json CompareSearches(const GridSet& set,
                     const CalibrationResult& fixed,
                     const CalibrationResult& strewn) {
  const double truth_px = set.camera.lens()[kFx];
  const auto off = [truth_px](double px) { return 100.0 * std::abs(px / truth_px - 1.0); };
  const double orthonormal_px =
      BestOf({}, [&](double focal_px) { return OrthonormalityError(set, focal_px); });
  return {{"orthonormality", off(orthonormal_px)},
          {"reprojection_fixed", off(fixed.focal_search.best_focal_px)},
          {"reprojection_strewn", off(strewn.focal_search.best_focal_px)}};
}

Json CompareSets(int num_sets, bool is_troubled) {
  Json sets = Json::array();
  for (int seed = 1; seed <= num_sets; ++seed) {
    const GridSet set = MakeGridSet(seed, is_troubled);
    CalibrationOptions options;
    const CalibrationResult strewn = CalibrateCamera(options, set.photos);
    options.fixed_grid = "a4";
    const CalibrationResult fixed = CalibrateCamera(options, set.photos);
    sets.push_back({{"opencv", ErrorsOf(CalibrateWithOpenCv(set), set.camera)},
                    {"fixed", ErrorsOf(fixed, set.camera)},
                    {"strewn", ErrorsOf(strewn, set.camera)},
                    {"search", CompareSearches(set, fixed, strewn)}});
  }
  return sets;
}

Json Run(const std::vector<std::string>& arguments) {
  const std::string mode = arguments.empty() ? "" : arguments[0];
  if (mode == "photos" && arguments.size() >= 3) {
    CalibrationOptions options;
    if (arguments.size() > 3 && arguments[3] != "-") options.fixed_grid = arguments[3];
    return CalibratePhotos(arguments[1],
                           ReadCameraYaml(arguments[2]),
                           options,
                           arguments.size() > 4 ? std::stod(arguments[4]) : 0.0);
  }
  if (mode == "sets" && arguments.size() == 3) {
    return CompareSets(std::stoi(arguments[1]), arguments[2] == "troubled");
  }
  throw std::runtime_error(
      "usage: calibration_benchmark photos DIR TRUTH.yaml [a4|a3|-] [HIDDEN_SHARE] | sets NUM "
      "sound|troubled");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::cout << Run({argv + 1, argv + argc}).dump(1) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "calibration_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
