// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/quality/gaps.h"
#include "plumbline/quality/layer.h"
#include "plumbline/quality/quality_block.h"

namespace plumb::ros_adapter {

// The faces of a block as one TRIANGLE_LIST in the colours of a layer, a colour a face. RViz draws
// such a list without light, so the shading is in the colours: as if lit from where
// rviz/flight.rviz looks from. A block without faces deletes what has its id.
visualization_msgs::Marker DrawBlock(const QualityBlock& block,
                                     Layer layer,
                                     Palette palette,
                                     const Measure& measure,
                                     int id,
                                     const std_msgs::Header& header);

// Deletes whatever its topic has shown.
visualization_msgs::Marker DeleteAll(const std_msgs::Header& header);

// A ring around each gap with its name, "G1" the worst, on a disc; of the worst the frame of the
// photo to take and an arrow from the newest camera to there.
visualization_msgs::MarkerArray DrawGaps(const std::vector<Gap>& gaps,
                                         const std::map<PhotoId, Rigid3>& cam_from_map,
                                         const std_msgs::Header& header);

struct RefusedPhoto {
  std::string name;
  std::string reason;
};

// A red cross with name and reason of each photo that is refused, where it was probably taken:
// between the located photos before and after it.
visualization_msgs::MarkerArray DrawRefused(const std::map<PhotoId, RefusedPhoto>& photos,
                                            const std::map<PhotoId, Rigid3>& cam_from_map,
                                            const std_msgs::Header& header);

}  // namespace plumb::ros_adapter
