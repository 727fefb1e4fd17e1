// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How photos look to feature matching, to hold simulated ones against real ones:
//   realism_benchmark FOLDER [MAX_PHOTOS]
// FOLDER holds photos/, camera.yaml and ground_truth/poses.csv. Prints JSON, medians over photos or
// over pairs of neighbours (each photo with the two whose true centres are nearest):
//   features_per_mp  SIFT features at the default contrast, in all octaves, by megapixel
//   opencv_per_mp    the same by OpenCV's SIFT, in the middle 6 megapixels
//   features         what the pipeline takes of a photo
//   matches          of a pair, as the mapper matches
//   inlier_ratio     share of the matches within 2 px of the true epipolar line
//   repeatability    share of a photo's features whose best partner within 2 px of its true
//   epipolar
//                    line is mutual and distinct (ratio 0.8): no depth is needed, so that the
//                    definition is the same for real photos
//   parallax_deg     median angle between the two rays of an inlier
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "plumbline/camera/camera.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/evaluation/true_poses.h"
#include "plumbline/geometry/relative_pose.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/matching/descriptor_matcher.h"

namespace plumb {
namespace {

constexpr double kMaxEpipolarError_px = 2.0;
constexpr double kMaxGuidedRatio = 0.8;
constexpr double kDegPerRad = 180.0 / M_PI;

struct AnalysedPhoto {
  Rigid3 cam_from_world;
  Eigen::Vector3d center_in_world;
  FeatureSet features;
  std::vector<Eigen::Vector2d> xy;  // Of each feature's ray.
  double features_per_mp = 0.0;
  double opencv_per_mp = 0.0;
};

double CountAllFeatures(const std::vector<std::uint8_t>& bytes, const Camera& camera) {
  FeatureOptions options;
  options.max_features = 10'000'000;
  options.max_octave_megapixels = 1e4;
  options.max_blur = 1e3;
  const PhotoAnalysis analysis =
      AnalyzePhoto(options, bytes, camera.width_px(), camera.height_px());
  return static_cast<double>(analysis.features.size());
}

double OpenCvFeaturesPerMegapixel(const std::vector<std::uint8_t>& bytes) {
  const cv::Mat photo = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  const cv::Size size(std::min(photo.cols, 3072), std::min(photo.rows, 2048));
  const cv::Mat middle = photo(cv::Rect(
      (photo.cols - size.width) / 2, (photo.rows - size.height) / 2, size.width, size.height));
  // OpenCV divides its bound by the scales an octave.
  const double contrast = 3.0 * FeatureOptions().min_contrast;
  std::vector<cv::KeyPoint> keypoints;
  cv::SIFT::create(0, 3, contrast, 10.0, 1.6)->detect(middle, keypoints);
  return 1e6 * static_cast<double>(keypoints.size()) / middle.size().area();
}

AnalysedPhoto Analyse(const std::string& path, const Camera& camera, const TruePose& truth) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  const double megapixels = 1e-6 * camera.width_px() * camera.height_px();
  AnalysedPhoto photo;
  photo.center_in_world = truth.center_in_world_m;
  photo.cam_from_world = Rigid3(truth.cam_from_world_rotation,
                                -(truth.cam_from_world_rotation * truth.center_in_world_m));
  photo.features = AnalyzePhoto({}, bytes, camera.width_px(), camera.height_px()).features;
  for (const Feature& feature : photo.features.features) {
    // A pixel beyond the lens's field has no ray and agrees with nothing.
    photo.xy.push_back(camera.Unproject(feature.Pixel()).value_or(Eigen::Vector2d::Constant(NAN)));
  }
  photo.features_per_mp = CountAllFeatures(bytes, camera) / megapixels;
  photo.opencv_per_mp = OpenCvFeaturesPerMegapixel(bytes);
  return photo;
}

struct PairFigures {
  double matches = 0.0;
  double inlier_ratio = 0.0;
  double repeatability = 0.0;
  double parallax_deg = 0.0;
};

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// For each feature of photo 1 its best partner near the epipolar line; -1 if there is no distinct
// one.
std::vector<int> GuidedPartners(const AnalysedPhoto& photo1,
                                const AnalysedPhoto& photo2,
                                double max_error) {
  const Eigen::Matrix3d essential =
      EssentialFromPose(photo2.cam_from_world * photo1.cam_from_world.Inverse());
  std::vector<int> partners;
  for (std::size_t i = 0; i < photo1.features.size(); ++i) {
    int best_idx = -1;
    double best = INFINITY;
    double second = INFINITY;
    for (std::size_t k = 0; k < photo2.features.size(); ++k) {
      if (!(SampsonError(essential, photo1.xy[i], photo2.xy[k]) <= max_error)) continue;
      const double distance = std::sqrt(
          SquaredDistance(photo1.features.descriptors.row(static_cast<Eigen::Index>(i)).data(),
                          photo2.features.descriptors.row(static_cast<Eigen::Index>(k)).data()));
      second = std::min(second, std::max(distance, best));
      if (distance < best) best_idx = static_cast<int>(k);
      best = std::min(best, distance);
    }
    partners.push_back(best < kMaxGuidedRatio * second ? best_idx : -1);
  }
  return partners;
}

double Repeatability(const AnalysedPhoto& photo1, const AnalysedPhoto& photo2, double max_error) {
  const std::vector<int> partners12 = GuidedPartners(photo1, photo2, max_error);
  const std::vector<int> partners21 = GuidedPartners(photo2, photo1, max_error);
  int num_mutual = 0;
  for (std::size_t i = 0; i < partners12.size(); ++i) {
    const int partner = partners12[i];
    if (partner < 0) continue;
    if (partners21[static_cast<std::size_t>(partner)] == static_cast<int>(i)) ++num_mutual;
  }
  const auto num_features =
      static_cast<double>(std::min(photo1.features.size(), photo2.features.size()));
  return num_features > 0.0 ? num_mutual / num_features : 0.0;
}

PairFigures Compare(const AnalysedPhoto& photo1, const AnalysedPhoto& photo2, double max_error) {
  const Rigid3 cam2_from_cam1 = photo2.cam_from_world * photo1.cam_from_world.Inverse();
  const Eigen::Matrix3d essential = EssentialFromPose(cam2_from_cam1);
  const auto matches =
      MatchDescriptors({}, photo1.features.descriptors, photo2.features.descriptors);
  std::vector<double> parallaxes_deg;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector2d& xy1 = photo1.xy[match.idx1];
    const Eigen::Vector2d& xy2 = photo2.xy[match.idx2];
    if (!(SampsonError(essential, xy1, xy2) <= max_error)) continue;
    const Eigen::Vector3d ray1 = cam2_from_cam1.rotation * xy1.homogeneous().normalized();
    const Eigen::Vector3d ray2 = xy2.homogeneous().normalized();
    parallaxes_deg.push_back(kDegPerRad * std::atan2(ray1.cross(ray2).norm(), ray1.dot(ray2)));
  }
  PairFigures figures;
  figures.matches = static_cast<double>(matches.size());
  if (!matches.empty()) {
    figures.inlier_ratio = static_cast<double>(parallaxes_deg.size()) / figures.matches;
  }
  figures.repeatability = Repeatability(photo1, photo2, max_error);
  figures.parallax_deg = Median(parallaxes_deg);
  return figures;
}

// Each photo with the two nearest.
std::set<std::pair<std::size_t, std::size_t>> Neighbours(const std::vector<AnalysedPhoto>& photos) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t k = 0; k < photos.size(); ++k) {
      if (k == i) continue;
      others.emplace_back((photos[i].center_in_world - photos[k].center_in_world).norm(), k);
    }
    std::sort(others.begin(), others.end());
    for (std::size_t n = 0; n < std::min<std::size_t>(2, others.size()); ++n) {
      pairs.insert(std::minmax(i, others[n].second));
    }
  }
  return pairs;
}

template <typename Items, typename Field>
double MedianOf(const Items& items, Field field) {
  std::vector<double> values;
  for (const auto& item : items) values.push_back(field(item));
  return Median(values);
}

nlohmann::ordered_json Measure(const std::string& folder, std::size_t max_photos) {
  const Camera camera = ReadCameraYaml(folder + "/camera.yaml");
  std::vector<TruePose> truth = ReadTruePoses(folder + "/ground_truth/poses.csv");
  if (truth.size() > max_photos) truth.resize(max_photos);
  std::vector<AnalysedPhoto> photos;
  for (const TruePose& pose : truth) {
    photos.push_back(Analyse(folder + "/photos/" + pose.photo, camera, pose));
  }
  const double max_error = kMaxEpipolarError_px / camera.MeanFocalLength();
  std::vector<PairFigures> pairs;
  for (const auto& [first, second] : Neighbours(photos)) {
    pairs.push_back(Compare(photos[first], photos[second], max_error));
  }
  using Photo = AnalysedPhoto;
  using Pair = PairFigures;
  return {{"photos", photos.size()},
          {"megapixels", 1e-6 * camera.width_px() * camera.height_px()},
          {"features_per_mp", MedianOf(photos, [](const Photo& p) { return p.features_per_mp; })},
          {"opencv_per_mp", MedianOf(photos, [](const Photo& p) { return p.opencv_per_mp; })},
          {"features",
           MedianOf(photos, [](const Photo& p) { return static_cast<double>(p.features.size()); })},
          {"pairs", pairs.size()},
          {"matches", MedianOf(pairs, [](const Pair& p) { return p.matches; })},
          {"inlier_ratio", MedianOf(pairs, [](const Pair& p) { return p.inlier_ratio; })},
          {"repeatability", MedianOf(pairs, [](const Pair& p) { return p.repeatability; })},
          {"parallax_deg", MedianOf(pairs, [](const Pair& p) { return p.parallax_deg; })}};
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: realism_benchmark FOLDER [MAX_PHOTOS]\n";
    return EXIT_FAILURE;
  }
  try {
    const std::size_t max_photos = argc == 3 ? std::stoul(argv[2]) : 1000;
    std::cout << plumb::Measure(argv[1], max_photos).dump(1) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "realism_benchmark: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
