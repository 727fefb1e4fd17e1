// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "plumbline/camera/camera.h"

namespace plumb {

// Undoes a lens's distortion about a pixel. Flat pixels are those of a pinhole camera with the same
// focal lengths and principal point; without a camera they are the raw ones.
class LocalLens {
 public:
  // Nothing if the lens does not show `origin_px`. `camera` may be null, or must outlive this.
  static std::optional<LocalLens> At(const Camera* camera, const Eigen::Vector2d& origin_px);

  const Eigen::Vector2d& flat_origin_px() const { return flat_origin_px_; }

  // Derivative of flat pixels by raw ones, at the origin.
  const Eigen::Matrix2d& flat_by_raw() const { return flat_by_raw_; }

  std::optional<Eigen::Vector2d> FlatFromRaw(const Eigen::Vector2d& raw_px) const;
  std::optional<Eigen::Vector2d> RawFromFlat(const Eigen::Vector2d& flat_px) const;

 private:
  explicit LocalLens(const Camera* camera) : camera_(camera) {}

  const Camera* camera_;
  Eigen::Vector2d flat_origin_px_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d flat_by_raw_ = Eigen::Matrix2d::Identity();
};

}  // namespace plumb
