// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <array>
#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "plumbline/quality/gaps.h"
#include "plumbline/quality/layer.h"
#include "plumbline/quality/quality_map.h"
#include "ros/mesh_drawing.h"

namespace plumb::ros_adapter {

// How the mesh is shown.
struct MeshLook {
  Palette palette = Palette::kPaper;
  Measure measure;
  GapOptions gaps;
};

// Tells the eye of the mesh: `mesh_<layer>` and `legend_<layer>` of each layer, `gap_markers` and
// `refused_photos`. A layer costs nothing while nobody listens to it; who begins to listen
// gets all of it. One call at a time.
class MeshPublisher {
 public:
  MeshPublisher(const ros::NodeHandle& handle, const std::string& map_frame_id);

  // Sends the blocks that changed, to all listeners, and the whole to new ones.
  void PublishBlocks(const QualityMap& map, const QualityUpdate& update, const MeshLook& look);

  // Sends everything anew: the colours mean something else now.
  void Repaint(const QualityMap& map, const MeshLook& look);

  // True if a layer has a listener that got nothing yet.
  bool HasNewListener() const;

  void PublishLegends(const MeshLook& look);
  void PublishGaps(const std::vector<Gap>& gaps, const std::map<PhotoId, Rigid3>& cam_from_map);
  void PublishRefused(const std::map<PhotoId, RefusedPhoto>& photos,
                      const std::map<PhotoId, Rigid3>& cam_from_map);

  std_msgs::Header HeaderNow() const;

 private:
  struct LayerTopic {
    ros::Publisher mesh;
    ros::Publisher legend;
    std::atomic<bool> has_new_listener{false};
  };

  void PublishLayer(Layer layer,
                    const QualityMap& map,
                    const std::vector<BlockId>* changed,
                    const MeshLook& look);
  int IdOf(const BlockId& block);

  std::string map_frame_id_;
  std::array<LayerTopic, kLayers.size()> topics_;
  ros::Publisher gaps_publisher_;
  ros::Publisher refused_publisher_;
  std::map<BlockId, int> id_of_block_;
};

}  // namespace plumb::ros_adapter
