// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mesh_conversion.h"

#include <algorithm>
#include <cmath>

#include "ros/geometry_conversion.h"

namespace plumb::ros_adapter {
namespace {

void AppendVertices(const MeshBlock& block, plumbline::MeshBlock* msg) {
  for (const MeshVertex& vertex : block.vertices) {
    msg->landmarks.push_back(vertex.landmark.value);
    const double* position = vertex.position_in_map.data();
    msg->positions_in_map.insert(msg->positions_in_map.end(), position, position + 3);
    msg->colors_rgb.insert(msg->colors_rgb.end(), vertex.color.begin(), vertex.color.end());
  }
}

bool IsSound(const plumbline::MeshBlock& msg) {
  const std::size_t num_vertices = msg.landmarks.size();
  const std::size_t num_faces = msg.faces.size() / 3;
  if (msg.positions_in_map.size() != 3 * num_vertices) return false;
  if (msg.colors_rgb.size() != 3 * num_vertices || msg.faces.size() != 3 * num_faces) return false;
  if (msg.gsd.size() != num_faces || msg.sigma_per_px.size() != num_faces) return false;
  if (msg.num_views.size() != num_faces) return false;
  return std::all_of(msg.positions_in_map.begin(),
                     msg.positions_in_map.end(),
                     [](double value) { return std::isfinite(value); }) &&
         std::all_of(msg.faces.begin(), msg.faces.end(), [&](std::uint32_t vertex) {
           return vertex < num_vertices;
         });
}

plumbline::Gap ToGapMsg(const Gap& gap,
                        const GapOptions& options,
                        const Measure& measure,
                        const std::optional<Rigid3>& newest_cam_from_map) {
  const double scale = measure.metres_per_map_unit.value_or(1.0);
  plumbline::Gap msg;
  msg.center_in_map = ToPointMsg(gap.center_in_map);
  msg.normal_in_map.x = gap.normal_in_map.x();
  msg.normal_in_map.y = gap.normal_in_map.y();
  msg.normal_in_map.z = gap.normal_in_map.z();
  msg.area_m2 = scale * scale * gap.area;
  msg.is_unsure = static_cast<std::uint8_t>(gap.share_unsure >= 0.5);
  msg.num_views = static_cast<std::uint32_t>(gap.num_views);
  msg.gsd = gap.gsd;
  msg.problem = Problem(gap, options, measure);
  msg.camera_in_map = ToPointMsg(gap.camera_in_map);
  if (!newest_cam_from_map) return msg;
  const Move move = MoveTo(gap, *newest_cam_from_map);
  msg.right_m = scale * move.right;
  msg.up_m = scale * move.up;
  msg.forward_m = scale * move.forward;
  msg.way = Way(gap, measure, *newest_cam_from_map);
  msg.advice = Advice(gap, options, measure, *newest_cam_from_map);
  return msg;
}

}  // namespace

plumbline::MeshBlock ToMeshBlockMsg(const QualityBlock& block) {
  plumbline::MeshBlock msg;
  msg.x = block.mesh.id.x;
  msg.y = block.mesh.id.y;
  msg.z = block.mesh.id.z;
  AppendVertices(block.mesh, &msg);
  for (std::size_t i = 0; i < block.mesh.faces.size(); ++i) {
    const auto& face = block.mesh.faces[i];
    msg.faces.insert(msg.faces.end(), face.begin(), face.end());
    const FaceQuality quality = i < block.qualities.size() ? block.qualities[i] : FaceQuality();
    msg.gsd.push_back(quality.gsd);
    msg.sigma_per_px.push_back(quality.sigma_per_px);
    msg.num_views.push_back(quality.num_views);
  }
  return msg;
}

std::optional<QualityBlock> FromMeshBlockMsg(const plumbline::MeshBlock& msg) {
  if (!IsSound(msg)) return std::nullopt;
  QualityBlock block;
  block.mesh.id = {msg.x, msg.y, msg.z};
  for (std::size_t i = 0; i < msg.landmarks.size(); ++i) {
    const double* position = &msg.positions_in_map[3 * i];
    const std::uint8_t* color = &msg.colors_rgb[3 * i];
    block.mesh.vertices.push_back({LandmarkId{msg.landmarks[i]},
                                   {position[0], position[1], position[2]},
                                   {color[0], color[1], color[2]}});
  }
  for (std::size_t i = 0; i < msg.num_views.size(); ++i) {
    block.mesh.faces.push_back({msg.faces[3 * i], msg.faces[3 * i + 1], msg.faces[3 * i + 2]});
    FaceQuality quality;
    quality.gsd = msg.gsd[i];
    quality.sigma_per_px = msg.sigma_per_px[i];
    quality.num_views = msg.num_views[i];
    block.qualities.push_back(quality);
  }
  block.shapes = ShapesOf(block.mesh);
  return block;
}

plumbline::Gaps ToGapsMsg(const std::vector<Gap>& gaps,
                          const GapOptions& options,
                          const Measure& measure,
                          const std::optional<Rigid3>& newest_cam_from_map) {
  plumbline::Gaps msg;
  const bool is_metric = measure.metres_per_map_unit.has_value();
  msg.is_metric = static_cast<std::uint8_t>(is_metric);
  msg.wanted_gsd = is_metric ? options.wanted_gsd_mm : options.wanted_relative_gsd;
  msg.min_views = static_cast<std::uint32_t>(options.min_views);
  for (const Gap& gap : gaps) {
    msg.gaps.push_back(ToGapMsg(gap, options, measure, newest_cam_from_map));
  }
  return msg;
}

}  // namespace plumb::ros_adapter
