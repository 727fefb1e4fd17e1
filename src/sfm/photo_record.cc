// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/photo_record.h"

#include <utility>

namespace plumb {

PhotoRecord MakePhotoRecord(const Camera& camera,
                            PhotoId id,
                            const std::string& name,
                            Timestamp exposure_time,
                            FeatureSet features) {
  PhotoRecord record{id, name, exposure_time, nullptr, {}, nullptr};
  std::size_t num_kept = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto xy = camera.Unproject(features.features[i].Pixel());
    if (!xy) continue;
    const auto from = static_cast<Eigen::Index>(i);
    const auto to = static_cast<Eigen::Index>(num_kept);
    features.features[num_kept] = features.features[i];
    features.colors[num_kept] = features.colors[i];
    if (from != to) features.descriptors.row(to) = features.descriptors.row(from);
    record.normalized.push_back(*xy);
    ++num_kept;
  }
  features.features.resize(num_kept);
  features.colors.resize(num_kept);
  features.descriptors.conservativeResize(static_cast<Eigen::Index>(num_kept), Eigen::NoChange);
  record.grid =
      std::make_shared<FeatureGrid>(features.features, camera.width_px(), camera.height_px());
  record.features = std::make_shared<const FeatureSet>(std::move(features));
  return record;
}

void UpdateRays(const Camera& camera, PhotoRecord* record) {
  for (std::size_t i = 0; i < record->normalized.size(); ++i) {
    const auto xy = camera.Unproject(record->features->features[i].Pixel());
    if (xy) record->normalized[i] = *xy;
  }
}

}  // namespace plumb
