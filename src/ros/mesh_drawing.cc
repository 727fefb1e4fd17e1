// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mesh_drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "ros/geometry_conversion.h"

namespace plumb::ros_adapter {
namespace {

// Towards the eye of the view that follows the map: yaw 255 degrees, pitch 20 degrees.
const Eigen::Vector3d kTowardsLight(-0.243, -0.908, 0.342);

// What is turned straight away still shows its colour.
constexpr double kAmbient = 0.45;

// Dark magenta: on neither palette, and strong on a light background.
constexpr std::array<float, 3> kGapInk = {0.6F, 0.0F, 0.5F};
constexpr std::array<float, 3> kRefusedInk = {0.8F, 0.0F, 0.0F};
constexpr std::array<float, 3> kWhite = {1.0F, 1.0F, 1.0F};

constexpr int kRingSides = 32;

// Letters are legible where the whole flight is in view: one in so many of its extent.
constexpr double kTextPerExtent = 0.027;

// Of the disc behind a gap's name, and how far the name is before it, in heights of a letter: it is
// before the disc even where that is seen from 25 degrees aside.
constexpr double kDiscDiameter = 2.4;
constexpr double kTextAhead = 0.35;

// How far the disc is before its ring, in heights of a letter: before the plates of targets.
constexpr double kDiscAhead = 2.4;

std_msgs::ColorRGBA Ink(const std::array<float, 3>& rgb) {
  std_msgs::ColorRGBA color;
  color.r = rgb[0];
  color.g = rgb[1];
  color.b = rgb[2];
  color.a = 1.0F;
  return color;
}

visualization_msgs::Marker MakeMarker(int type,
                                      const std::string& name,
                                      int id,
                                      const std_msgs::Header& header) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color.a = 1.0F;
  return marker;
}

std_msgs::ColorRGBA Shaded(const Rgb& color, const Eigen::Vector3d& normal) {
  const double lit = 0.5 * (1.0 + normal.dot(kTowardsLight));
  const auto shade = static_cast<float>((kAmbient + (1.0 - kAmbient) * lit) / 255.0);
  return Ink({shade * static_cast<float>(color[0]),
              shade * static_cast<float>(color[1]),
              shade * static_cast<float>(color[2])});
}

// Two directions on the plane across the normal; the second is up where that can be.
std::array<Eigen::Vector3d, 2> AxesOf(const Eigen::Vector3d& normal) {
  Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(normal);
  if (right.norm() < 1e-3) right = Eigen::Vector3d::UnitX();
  right.normalize();
  return {right, normal.cross(right).normalized()};
}

visualization_msgs::Marker Text(const std::string& text,
                                const Eigen::Vector3d& position,
                                double height,
                                const std::string& name,
                                int id,
                                const std_msgs::Header& header) {
  auto marker = MakeMarker(visualization_msgs::Marker::TEXT_VIEW_FACING, name, id, header);
  marker.text = text;
  marker.pose.position = ToPointMsg(position);
  marker.scale.z = height;
  marker.color = Ink({0.0F, 0.0F, 0.0F});
  return marker;
}

// Where all of the flight and its gaps lie: the length of the box's diagonal.
double ExtentOf(const std::vector<Gap>& gaps, const std::map<PhotoId, Rigid3>& cam_from_map) {
  Eigen::AlignedBox3d box;
  for (const Gap& gap : gaps) box.extend(gap.center_in_map).extend(gap.camera_in_map);
  for (const auto& [photo, pose] : cam_from_map) box.extend(pose.TargetOriginInSource());
  return box.diagonal().norm();
}

// Signs stand upright, but those of gaps that lie flat.
Eigen::Vector3d Upright(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d level(normal.x(), normal.y(), 0.0);
  return level.norm() < 0.5 ? normal : level.normalized();
}

// A gap's ring, and at the top of it the name on a disc; a target's plate is white and square.
class GapSign {
 public:
  GapSign(const Gap& gap, int id, double text_height, const std_msgs::Header& header)
      : gap_(gap),
        id_(id),
        text_height_(text_height),
        facing_(Upright(gap.normal_in_map)),
        radius_(std::max(std::sqrt(gap.area / M_PI), 0.5 * kDiscDiameter * text_height)),
        header_(header) {}

  visualization_msgs::Marker Ring() const {
    auto ring = MakeMarker(visualization_msgs::Marker::LINE_STRIP, "gap", id_, header_);
    ring.scale.x = (id_ == 0 ? 0.4 : 0.2) * text_height_;
    ring.color = Ink(kGapInk);
    for (int step = 0; step <= kRingSides; ++step) {
      ring.points.push_back(ToPointMsg(OnRing(2.0 * M_PI * step / kRingSides)));
    }
    return ring;
  }

  visualization_msgs::Marker Disc() const {
    auto disc = MakeMarker(visualization_msgs::Marker::CYLINDER, "gap_disc", id_, header_);
    disc.pose.position = ToPointMsg(Top());
    const auto turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), facing_);
    disc.pose.orientation.x = turn.x();
    disc.pose.orientation.y = turn.y();
    disc.pose.orientation.z = turn.z();
    disc.pose.orientation.w = turn.w();
    disc.scale.x = disc.scale.y = kDiscDiameter * text_height_;
    disc.scale.z = 0.05 * text_height_;
    disc.color = Ink(kGapInk);
    return disc;
  }

  visualization_msgs::Marker Name() const {
    const Eigen::Vector3d place = Top() + kTextAhead * text_height_ * facing_;
    auto name = Text("G" + std::to_string(id_ + 1), place, text_height_, "gap_name", id_, header_);
    name.color = Ink(kWhite);
    return name;
  }

 private:
  Eigen::Vector3d OnRing(double angle) const {
    const auto [right, up] = AxesOf(gap_.normal_in_map);
    return gap_.center_in_map + 0.3 * radius_ * gap_.normal_in_map +
           radius_ * (std::cos(angle) * right + std::sin(angle) * up);
  }

  Eigen::Vector3d Top() const { return OnRing(0.5 * M_PI) + kDiscAhead * text_height_ * facing_; }

  const Gap& gap_;
  int id_;
  double text_height_;
  Eigen::Vector3d facing_;  // Of the disc.
  double radius_;
  const std_msgs::Header& header_;
};

// The frame of a photo from the place advised, and the line of sight.
visualization_msgs::Marker PhotoFrame(const Gap& gap, int id, const std_msgs::Header& header) {
  const auto [right, up] = AxesOf(gap.normal_in_map);
  const Eigen::Vector3d& eye = gap.camera_in_map;
  const double depth = 0.25 * (eye - gap.center_in_map).norm();
  auto frame = MakeMarker(visualization_msgs::Marker::LINE_LIST, "gap_photo", id, header);
  frame.scale.x = 0.04 * depth;
  frame.color = Ink(kGapInk);
  std::array<geometry_msgs::Point, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = i == 0 || i == 3 ? -0.6 : 0.6;
    const double y = i < 2 ? -0.4 : 0.4;
    corners[i] = ToPointMsg(eye + depth * (x * right + y * up - gap.normal_in_map));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    frame.points.insert(frame.points.end(),
                        {ToPointMsg(eye), corners[i], corners[i], corners[(i + 1) % 4]});
  }
  frame.points.insert(frame.points.end(), {ToPointMsg(eye), ToPointMsg(gap.center_in_map)});
  return frame;
}

visualization_msgs::Marker WayTo(const Gap& gap,
                                 const Rigid3& newest_cam_from_map,
                                 const std_msgs::Header& header) {
  const Eigen::Vector3d from = newest_cam_from_map.TargetOriginInSource();
  const double length = (gap.camera_in_map - from).norm();
  auto arrow = MakeMarker(visualization_msgs::Marker::ARROW, "way", 0, header);
  arrow.points = {ToPointMsg(from), ToPointMsg(gap.camera_in_map)};
  const double distance = (gap.camera_in_map - gap.center_in_map).norm();
  arrow.scale.x = 0.03 * distance;  // Shaft, head, length of the head.
  arrow.scale.y = 0.09 * distance;
  arrow.scale.z = std::min(0.5 * length, 0.15 * distance);
  arrow.color = Ink(kGapInk);
  if (!(length > 0.0)) arrow.action = visualization_msgs::Marker::DELETE;
  return arrow;
}

Eigen::Vector3d ProbablePlace(PhotoId photo, const std::map<PhotoId, Rigid3>& cam_from_map) {
  const auto after = cam_from_map.upper_bound(photo);
  if (after == cam_from_map.begin()) return after->second.TargetOriginInSource();
  const auto before = std::prev(after);
  const Eigen::Vector3d last = before->second.TargetOriginInSource();
  if (after == cam_from_map.end()) return last;
  const double share = static_cast<double>(photo.value - before->first.value) /
                       static_cast<double>(after->first.value - before->first.value);
  return last + share * (after->second.TargetOriginInSource() - last);
}

// Typical distance between photos that follow each other, for the size of what is drawn.
double StepOf(const std::map<PhotoId, Rigid3>& cam_from_map) {
  if (cam_from_map.size() < 2) return 1.0;
  double sum = 0.0;
  for (auto it = cam_from_map.begin(); std::next(it) != cam_from_map.end(); ++it) {
    sum +=
        (it->second.TargetOriginInSource() - std::next(it)->second.TargetOriginInSource()).norm();
  }
  return sum / static_cast<double>(cam_from_map.size() - 1);
}

}  // namespace

visualization_msgs::Marker DrawBlock(const QualityBlock& block,
                                     Layer layer,
                                     Palette palette,
                                     const Measure& measure,
                                     int id,
                                     const std_msgs::Header& header) {
  auto marker = MakeMarker(visualization_msgs::Marker::TRIANGLE_LIST, ToString(layer), id, header);
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  const std::size_t num_faces = block.mesh.faces.size();
  if (num_faces == 0) {
    marker.action = visualization_msgs::Marker::DELETE;
    return marker;
  }
  marker.points.reserve(3 * num_faces);
  marker.colors.reserve(num_faces);
  for (std::size_t i = 0; i < num_faces; ++i) {
    for (const std::uint32_t corner : block.mesh.faces[i]) {
      marker.points.push_back(ToPointMsg(block.mesh.vertices[corner].position_in_map));
    }
    const FaceQuality quality = i < block.qualities.size() ? block.qualities[i] : FaceQuality();
    marker.colors.push_back(
        Shaded(ColorOf(layer, palette, measure, quality), block.shapes[i].normal_in_map));
  }
  return marker;
}

visualization_msgs::Marker DeleteAll(const std_msgs::Header& header) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.action = visualization_msgs::Marker::DELETEALL;
  return marker;
}

visualization_msgs::MarkerArray DrawGaps(const std::vector<Gap>& gaps,
                                         const std::map<PhotoId, Rigid3>& cam_from_map,
                                         const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  array.markers.push_back(DeleteAll(header));
  if (gaps.empty()) return array;
  const double text_height = kTextPerExtent * ExtentOf(gaps, cam_from_map);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const GapSign sign(gaps[i], static_cast<int>(i), text_height, header);
    for (const auto& marker : {sign.Ring(), sign.Disc(), sign.Name()}) {
      array.markers.push_back(marker);
    }
  }
  array.markers.push_back(PhotoFrame(gaps[0], 0, header));
  if (!cam_from_map.empty()) {
    array.markers.push_back(WayTo(gaps[0], cam_from_map.rbegin()->second, header));
  }
  return array;
}

visualization_msgs::MarkerArray DrawRefused(const std::map<PhotoId, RefusedPhoto>& photos,
                                            const std::map<PhotoId, Rigid3>& cam_from_map,
                                            const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  array.markers.push_back(DeleteAll(header));
  if (cam_from_map.empty()) return array;
  const double size = 0.3 * StepOf(cam_from_map);
  auto crosses = MakeMarker(visualization_msgs::Marker::LINE_LIST, "refused", 0, header);
  crosses.scale.x = 0.2 * size;
  crosses.color = Ink(kRefusedInk);
  auto next_view = cam_from_map.begin();
  int line = -1;  // Names of photos that were refused in a row stand below each other.
  for (const auto& [photo, refused] : photos) {
    const Eigen::Vector3d place = ProbablePlace(photo, cam_from_map);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d arm = size * Eigen::Vector3d::Unit(axis);
      crosses.points.push_back(ToPointMsg(place - arm));
      crosses.points.push_back(ToPointMsg(place + arm));
    }
    std::string reason = refused.reason;
    std::replace(reason.begin(), reason.end(), '_', ' ');
    const auto after = cam_from_map.upper_bound(photo);
    line = after == next_view ? line + 1 : 0;
    next_view = after;
    const Eigen::Vector3d below = place - (1.5 + 0.6 * line) * size * Eigen::Vector3d::UnitZ();
    array.markers.push_back(Text(refused.name + ": " + reason,
                                 below,
                                 0.5 * size,
                                 "refused_name",
                                 static_cast<int>(photo.value),
                                 header));
    array.markers.back().color = Ink(kRefusedInk);
  }
  if (!crosses.points.empty()) array.markers.push_back(crosses);
  return array;
}

}  // namespace plumb::ros_adapter
