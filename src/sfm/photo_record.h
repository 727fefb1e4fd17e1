// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/ids.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/image/features.h"
#include "plumbline/matching/feature_grid.h"

namespace plumb {

// What mapping needs of a photo, located or not.
struct PhotoRecord {
  PhotoId id;
  std::string name;
  Timestamp exposure_time;
  std::shared_ptr<const FeatureSet> features;
  std::vector<Eigen::Vector2d> normalized;  // (X/Z, Y/Z) of each feature's ray, undistorted.

  // SIFT gives one spot a feature for each of its dominant orientations. All of them can be
  // matched, but they measure one point: the first stands for them in tracks.
  std::vector<std::uint32_t> first_at_spot;
  std::shared_ptr<const FeatureGrid> grid;
};

using PhotoRecords = std::map<PhotoId, PhotoRecord>;

// Features whose pixel has no ray under `camera` are left out: the record's features may
// be fewer than `features`.
PhotoRecord MakePhotoRecord(const Camera& camera,
                            PhotoId id,
                            const std::string& name,
                            Timestamp exposure_time,
                            FeatureSet features);

// The rays again, after the lens was refined. A feature without a ray keeps its old one.
void UpdateRays(const Camera& camera, PhotoRecord* record);

}  // namespace plumb
