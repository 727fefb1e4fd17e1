// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <Eigen/Dense>
#include <cstdlib>
#include <opencv2/aruco.hpp>
#include <string>
#include <vector>

#include "plumbline/marker/marker_detector.h"
#include "test/support/marker_scene.h"

namespace plumb::test {

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

}  // namespace plumb::test
