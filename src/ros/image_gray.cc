// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/image_gray.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <opencv2/core.hpp>
#include <string>

namespace plumb::ros_adapter {
namespace {

namespace encodings = sensor_msgs::image_encodings;

// Bayer and colour of 16 bits become mono16 first, so that nothing dark is rounded away.
cv::Mat To16Bit(const sensor_msgs::ImageConstPtr& msg) {
  return cv_bridge::toCvCopy(msg, encodings::MONO16)->image;
}

cv::Mat ScaleTo8Bit(const cv::Mat& image) {
  double largest = 0.0;
  cv::minMaxLoc(image, nullptr, &largest);
  double full = 255.0;
  while (full < largest) full = 2.0 * full + 1.0;
  cv::Mat gray;
  image.convertTo(gray, CV_8U, 255.0 / full);
  return gray;
}

}  // namespace

GrayPhoto ToGrayPhoto(const sensor_msgs::ImageConstPtr& msg) {
  GrayPhoto photo;
  if (msg->width == 0 || msg->height == 0 || msg->data.empty()) {
    photo.problem = "the image is empty";
    return photo;
  }
  try {
    photo.gray = encodings::bitDepth(msg->encoding) == 16
                     ? ScaleTo8Bit(To16Bit(msg))
                     : cv_bridge::toCvCopy(msg, encodings::MONO8)->image;
  } catch (const std::exception& error) {  // cv_bridge's, OpenCV's and image_encodings' own.
    photo.gray.release();
    photo.problem = "an image of encoding \"" + msg->encoding + "\" is not read: " + error.what();
  }
  return photo;
}

}  // namespace plumb::ros_adapter
