// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/quality_map.h"

#include "quality/quality_map_impl.h"

namespace plumb {

QualityMap::QualityMap(const QualityOptions& options) : impl_(std::make_unique<Impl>(options)) {}
QualityMap::~QualityMap() = default;

QualityUpdate QualityMap::SetCamera(const Camera& camera) { return impl_->SetCamera(camera); }

QualityUpdate QualityMap::Apply(const MapDelta& map_delta, const MeshDelta& mesh_delta) {
  return impl_->Apply(map_delta, mesh_delta);
}

const std::map<BlockId, QualityBlock>& QualityMap::blocks() const { return impl_->blocks(); }
const std::map<PhotoId, Rigid3>& QualityMap::views() const { return impl_->views(); }
const std::optional<Camera>& QualityMap::camera() const { return impl_->camera(); }
double QualityMap::noise_px() const { return impl_->noise_px(); }

}  // namespace plumb
