// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/target_drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "ros/geometry_conversion.h"
#include "ros/target_name.h"

namespace plumb::ros_adapter {
namespace {

using plumbline::TargetResidual;
using visualization_msgs::Marker;

// Letters are legible where all targets are in view: one in so many of their extent.
constexpr double kTextPerExtent = 0.045;

// Of RViz's letters, in their height.
constexpr double kLetterWidth = 0.54;
constexpr double kPlateHeight = 1.7;

// Plates face the eye of rviz/flight.rviz, which looks from 15 degrees to the left of where the
// map's first camera looked.
constexpr double kPlateTurn_rad = -15.0 * M_PI / 180.0;

// What is drawn larger than a marker is, in extents of all targets: to be seen at all.
constexpr double kLeastSizePerExtent = 0.012;

std_msgs::ColorRGBA Color(int red, int green, int blue) {
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(red) / 255.0F;
  color.g = static_cast<float>(green) / 255.0F;
  color.b = static_cast<float>(blue) / 255.0F;
  color.a = 1.0F;
  return color;
}

std_msgs::ColorRGBA Black() { return Color(0, 0, 0); }

std_msgs::ColorRGBA ColorOf(const TargetResidual& target) {
  if (target.state == TargetResidual::WRONG) return Color(213, 94, 0);          // Vermilion.
  if (target.state == TargetResidual::WAITING) return Color(240, 228, 66);      // Yellow.
  if (target.state == TargetResidual::UNSURVEYED) return Color(204, 121, 167);  // Purple.
  if (target.state != TargetResidual::GOOD) return Color(140, 140, 140);
  return target.role == TargetResidual::CHECK ? Color(0, 158, 115)   // Bluish green.
                                              : Color(0, 114, 178);  // Blue.
}

template <typename Array>
Eigen::Vector3d ToVector(const Array& array) {
  return {array[0], array[1], array[2]};
}

// NaN if it has no place.
Eigen::Vector3d PlaceOf(const TargetResidual& target) {
  const Eigen::Vector3d surveyed = ToVector(target.survey_in_map);
  return surveyed.allFinite() ? surveyed : ToVector(target.point_in_map);
}

class Drawer {
 public:
  Drawer(const TargetDrawingOptions& options, const plumbline::Georeference& georeference)
      : options_(options), georeference_(georeference) {
    for (const TargetResidual& target : georeference.targets) {
      const Eigen::Vector3d place = PlaceOf(target);
      if (place.allFinite()) box_.extend(place);
    }
    if (box_.isEmpty()) return;
    const double extent = box_.diagonal().norm();
    size_ = kLeastSizePerExtent * extent;
    if (georeference.metres_per_map_unit > 0.0) {
      size_ = std::max(size_, options.marker_diameter_m / georeference.metres_per_map_unit);
    }
    text_size_ = std::max(kTextPerExtent * extent, 0.5 * size_);
  }

  visualization_msgs::MarkerArray Draw() {
    if (box_.isEmpty()) return {};
    for (const TargetResidual& target : georeference_.targets) {
      if (!PlaceOf(target).allFinite()) continue;
      DrawSymbol(target);
      DrawArrow(target);
      DrawLabel(target);
    }
    return std::move(drawing_);
  }

 private:
  Marker Begin(const char* name, int id, int type) const {
    Marker marker;
    marker.header.frame_id = options_.map_frame_id;
    marker.ns = name;
    marker.id = id;
    marker.type = type;
    marker.pose.orientation.w = 1.0;
    return marker;
  }

  void DrawSymbol(const TargetResidual& target) {
    const bool is_check = target.role == TargetResidual::CHECK;
    Marker marker = Begin("targets", target.id, is_check ? Marker::CUBE : Marker::SPHERE);
    marker.pose.position = ToPointMsg(PlaceOf(target));
    marker.scale.x = marker.scale.y = marker.scale.z = size_;
    marker.color = ColorOf(target);
    drawing_.markers.push_back(marker);
    if (target.state == TargetResidual::WRONG) DrawCross(target);
  }

  // Before the wall, where the map's first camera stood.
  void DrawCross(const TargetResidual& target) {
    Marker marker = Begin("wrong_targets", target.id, Marker::LINE_LIST);
    marker.scale.x = 0.2 * size_;
    marker.color = Black();
    for (const auto& [x, z] : {std::pair(-1.0, -1.0), {1.0, 1.0}, {-1.0, 1.0}, {1.0, -1.0}}) {
      const Eigen::Vector3d corner(0.9 * x * size_, -0.6 * size_, 0.9 * z * size_);
      marker.points.push_back(ToPointMsg(PlaceOf(target) + corner));
    }
    drawing_.markers.push_back(marker);
  }

  void DrawArrow(const TargetResidual& target) {
    const Eigen::Vector3d surveyed = ToVector(target.survey_in_map);
    const Eigen::Vector3d seen = ToVector(target.point_in_map);
    if (!surveyed.allFinite() || !seen.allFinite()) return;
    const bool is_wrong = target.state == TargetResidual::WRONG;
    const Eigen::Vector3d way = (is_wrong ? 1.0 : options_.magnification) * (seen - surveyed);
    if (!(way.norm() > 0.0)) return;
    Marker marker = Begin("target_residuals", target.id, Marker::ARROW);
    const double width = std::min(0.25 * size_, 0.2 * way.norm());
    marker.scale.x = width;
    marker.scale.y = 2.0 * width;
    marker.scale.z = std::min(3.0 * width, 0.5 * way.norm());
    marker.color = is_wrong ? ColorOf(target) : Black();
    // Out of the ball, towards the first camera.
    const Eigen::Vector3d begin = surveyed - Eigen::Vector3d(0.0, 0.6 * size_, 0.0);
    marker.points = {ToPointMsg(begin), ToPointMsg(begin + way)};
    drawing_.markers.push_back(marker);
  }

  // On a plate, for dark letters before the points of a facade are not legible. Above the symbol.
  void DrawLabel(const TargetResidual& target) {
    const std::string text = LabelOf(target);
    Marker plate = Begin("plates_of_targets", target.id, Marker::CUBE);
    plate.scale.x = text_size_ * (kLetterWidth * static_cast<double>(text.size()) + 0.8);
    plate.scale.y = 0.02 * text_size_;
    plate.scale.z = kPlateHeight * text_size_;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(kPlateTurn_rad, Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d towards_eye = turn * -Eigen::Vector3d::UnitY();
    const Eigen::Vector3d middle = PlaceOf(target) + size_ * towards_eye +
                                   Eigen::Vector3d(0.0, 0.0, 0.7 * size_ + 0.5 * plate.scale.z);
    plate.pose.position = ToPointMsg(middle);
    plate.pose.orientation.w = turn.w();
    plate.pose.orientation.z = turn.z();
    plate.color = Color(255, 255, 255);
    drawing_.markers.push_back(plate);
    // Before it even when it is seen from somewhat aside: the text turns, the plate does not.
    const double ahead = 0.3 * text_size_ + 0.1 * plate.scale.x;
    Marker marker = Begin("target_labels", target.id, Marker::TEXT_VIEW_FACING);
    marker.pose.position = ToPointMsg(middle + ahead * towards_eye);
    marker.scale.z = text_size_;
    marker.color = ColorOfText(target);
    marker.text = text;
    drawing_.markers.push_back(marker);
  }

  static std_msgs::ColorRGBA ColorOfText(const TargetResidual& target) {
    return target.state == TargetResidual::WRONG ? Color(170, 60, 0) : Black();
  }

  static std::string LabelOf(const TargetResidual& target) {
    std::ostringstream label;
    label << TargetName(target) << std::fixed << std::setprecision(1);
    if (target.state == TargetResidual::GOOD) {
      label << ": " << target.error_mm << " mm";
    } else if (target.state == TargetResidual::WRONG) {
      label << ": WRONG " << std::setprecision(0) << target.error_mm << " mm";
    } else if (target.state == TargetResidual::UNSEEN) {
      label << ": not seen";
    } else {
      label << ": " << target.state;
    }
    return label.str();
  }

  TargetDrawingOptions options_;
  const plumbline::Georeference& georeference_;
  Eigen::AlignedBox3d box_;  // Of all targets.
  double size_ = 0.0;        // Of a symbol [map units].
  double text_size_ = 0.0;
  visualization_msgs::MarkerArray drawing_;
};

}  // namespace

visualization_msgs::MarkerArray DrawTargets(const TargetDrawingOptions& options,
                                            const plumbline::Georeference& georeference) {
  return Drawer(options, georeference).Draw();
}

}  // namespace plumb::ros_adapter
