// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Renders photos of strewn coded markers into a folder: make_calibration_photos FOLDER COUNT. Each
// is there as PNG and as PGM, 101 and on. Prints the camera they are taken with.
#include <cstdlib>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "test/support/calibration_photos.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: make_calibration_photos FOLDER COUNT\n";
    return EXIT_FAILURE;
  }
  plumb::test::CalibrationSceneOptions options;
  options.camera = plumb::test::SmallCalibrationCamera();
  options.num_photos = std::atoi(argv[2]);
  int number = 0;
  for (const cv::Mat& photo : plumb::test::RenderCalibrationPhotos(options)) {
    const std::string path = std::string(argv[1]) + '/' + std::to_string(100 + ++number);
    if (!cv::imwrite(path + ".png", photo) || !cv::imwrite(path + ".pgm", photo)) {
      return EXIT_FAILURE;
    }
  }
  std::cout << plumb::ToCameraYaml(options.camera);
  return EXIT_SUCCESS;
}
