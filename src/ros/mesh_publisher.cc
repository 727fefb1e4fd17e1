// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/mesh_publisher.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <string>

#include "plumbline/quality/legend.h"

namespace plumb::ros_adapter {
namespace {

// None of them may be lost: a listener would show an old block for ever.
constexpr std::uint32_t kMarkerQueue = 1000;

}  // namespace

MeshPublisher::MeshPublisher(const ros::NodeHandle& handle, const std::string& map_frame_id)
    : map_frame_id_(map_frame_id) {
  ros::NodeHandle own(handle);
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    const std::string name = ToString(kLayers[i]);
    topics_[i].mesh = own.advertise<visualization_msgs::MarkerArray>(
        "mesh_" + name, kMarkerQueue, [this, i](const ros::SingleSubscriberPublisher&) {
          topics_[i].has_new_listener = true;
        });
    topics_[i].legend = own.advertise<sensor_msgs::Image>("legend_" + name, 1, /*latch=*/true);
  }
  gaps_publisher_ =
      own.advertise<visualization_msgs::MarkerArray>("gap_markers", 1, /*latch=*/true);
  refused_publisher_ =
      own.advertise<visualization_msgs::MarkerArray>("refused_photos", 1, /*latch=*/true);
}

std_msgs::Header MeshPublisher::HeaderNow() const {
  std_msgs::Header header;
  header.frame_id = map_frame_id_;
  header.stamp = ros::Time::now();
  return header;
}

bool MeshPublisher::HasNewListener() const {
  for (const LayerTopic& topic : topics_) {
    if (topic.has_new_listener) return true;
  }
  return false;
}

void MeshPublisher::PublishBlocks(const QualityMap& map,
                                  const QualityUpdate& update,
                                  const MeshLook& look) {
  for (const Layer layer : kLayers) {
    const bool is_all_new = layer == Layer::kAccuracy && update.is_noise_changed;
    PublishLayer(layer, map, is_all_new ? nullptr : &update.blocks, look);
  }
}

void MeshPublisher::Repaint(const QualityMap& map, const MeshLook& look) {
  for (const Layer layer : kLayers) PublishLayer(layer, map, nullptr, look);
}

// All blocks if `changed` is null.
void MeshPublisher::PublishLayer(Layer layer,
                                 const QualityMap& map,
                                 const std::vector<BlockId>* changed,
                                 const MeshLook& look) {
  LayerTopic& topic = topics_[static_cast<std::size_t>(layer)];
  if (topic.has_new_listener.exchange(false)) changed = nullptr;
  if (topic.mesh.getNumSubscribers() == 0) return;
  const std_msgs::Header header = HeaderNow();
  visualization_msgs::MarkerArray array;
  if (changed == nullptr) {
    array.markers.push_back(DeleteAll(header));
    for (const auto& [id, block] : map.blocks()) {
      array.markers.push_back(
          DrawBlock(block, layer, look.palette, look.measure, IdOf(id), header));
    }
  } else {
    for (const BlockId& id : *changed) {
      const auto found = map.blocks().find(id);
      const QualityBlock& block = found != map.blocks().end() ? found->second : QualityBlock();
      array.markers.push_back(
          DrawBlock(block, layer, look.palette, look.measure, IdOf(id), header));
    }
  }
  if (!array.markers.empty()) topic.mesh.publish(array);
}

int MeshPublisher::IdOf(const BlockId& block) {
  return id_of_block_.emplace(block, static_cast<int>(id_of_block_.size())).first->second;
}

void MeshPublisher::PublishLegends(const MeshLook& look) {
  for (const Layer layer : kLayers) {
    const cv_bridge::CvImage image(HeaderNow(),
                                   sensor_msgs::image_encodings::RGB8,
                                   DrawLegend(layer, look.palette, look.measure, look.gaps));
    topics_[static_cast<std::size_t>(layer)].legend.publish(image.toImageMsg());
  }
}

void MeshPublisher::PublishGaps(const std::vector<Gap>& gaps,
                                const std::map<PhotoId, Rigid3>& cam_from_map) {
  gaps_publisher_.publish(DrawGaps(gaps, cam_from_map, HeaderNow()));
}

void MeshPublisher::PublishRefused(const std::map<PhotoId, RefusedPhoto>& photos,
                                   const std::map<PhotoId, Rigid3>& cam_from_map) {
  refused_publisher_.publish(DrawRefused(photos, cam_from_map, HeaderNow()));
}

}  // namespace plumb::ros_adapter
