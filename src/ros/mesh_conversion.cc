// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mesh_conversion.h"

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

plumbline::Gaps ToGapsMsg(const std::vector<Gap>& gaps,
                          const GapOptions& options,
                          const Measure& measure,
                          const std::optional<Rigid3>& newest_cam_from_map) {
  plumbline::Gaps msg;
  const bool is_metric = measure.metres_per_map_unit.has_value();
  msg.is_metric = static_cast<std::uint8_t>(is_metric);
  msg.wanted_gsd = WantedGsd(options, measure);
  msg.min_views = static_cast<std::uint32_t>(options.min_views);
  for (const Gap& gap : gaps) {
    msg.gaps.push_back(ToGapMsg(gap, options, measure, newest_cam_from_map));
  }
  return msg;
}

}  // namespace plumb::ros_adapter
