// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/photo_record.h"

#include <tuple>
#include <utility>

namespace plumb {
namespace {

std::vector<std::uint32_t> FirstAtSpot(const std::vector<Feature>& features) {
  std::map<std::tuple<float, float, float>, std::uint32_t> first;
  std::vector<std::uint32_t> first_at_spot;
  for (const Feature& feature : features) {
    const auto idx = static_cast<std::uint32_t>(first_at_spot.size());
    const auto spot = std::make_tuple(feature.x_px, feature.y_px, feature.scale_px);
    first_at_spot.push_back(first.try_emplace(spot, idx).first->second);
  }
  return first_at_spot;
}

}  // namespace

PhotoRecord MakePhotoRecord(const Camera& camera,
                            PhotoId id,
                            const std::string& name,
                            Timestamp exposure_time,
                            FeatureSet features) {
  PhotoRecord record;
  record.id = id;
  record.name = name;
  record.exposure_time = exposure_time;
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
  record.first_at_spot = FirstAtSpot(features.features);
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
