// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/local_lens.h"

namespace plumb {

std::optional<LocalLens> LocalLens::At(const Camera* camera, const Eigen::Vector2d& origin_px) {
  LocalLens lens(camera);
  const std::optional<Eigen::Vector2d> origin = lens.FlatFromRaw(origin_px);
  if (!origin) return std::nullopt;
  lens.flat_origin_px_ = *origin;
  for (int i = 0; i < 2; ++i) {  // Central differences over two pixels; distortion is smooth.
    const Eigen::Vector2d step = Eigen::Vector2d::Unit(i);
    const std::optional<Eigen::Vector2d> ahead = lens.FlatFromRaw(origin_px + step);
    const std::optional<Eigen::Vector2d> behind = lens.FlatFromRaw(origin_px - step);
    if (!ahead || !behind) return std::nullopt;
    lens.flat_by_raw_.col(i) = 0.5 * (*ahead - *behind);
  }
  return lens;
}

std::optional<Eigen::Vector2d> LocalLens::FlatFromRaw(const Eigen::Vector2d& raw_px) const {
  if (camera_ == nullptr) return raw_px;
  const std::optional<Eigen::Vector2d> ray = camera_->Unproject(raw_px);
  if (!ray) return std::nullopt;
  const LensParameters<double>& lens = camera_->lens();
  return Eigen::Vector2d(lens[kFx] * ray->x() + lens[kCx], lens[kFy] * ray->y() + lens[kCy]);
}

std::optional<Eigen::Vector2d> LocalLens::RawFromFlat(const Eigen::Vector2d& flat_px) const {
  if (camera_ == nullptr) return flat_px;
  const LensParameters<double>& lens = camera_->lens();
  return camera_->Project(
      {(flat_px.x() - lens[kCx]) / lens[kFx], (flat_px.y() - lens[kCy]) / lens[kFy], 1.0});
}

}  // namespace plumb
