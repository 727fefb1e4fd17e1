// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/ambient_map.h"

#include <algorithm>

namespace plumb::internal {

AmbientMap::Value AmbientMap::At(float u, float v) const {
  const float x = std::clamp((u - u0_) * cells_per_m_u_, 0.0F, static_cast<float>(columns_ - 1));
  const float y = std::clamp((v - v0_) * cells_per_m_v_, 0.0F, static_cast<float>(rows_ - 1));
  const int column = std::max(0, std::min(static_cast<int>(x), columns_ - 2));
  const int row = std::max(0, std::min(static_cast<int>(y), rows_ - 2));
  const float fx = x - static_cast<float>(column);
  const float fy = y - static_cast<float>(row);
  const Value* corner = &values_[static_cast<std::size_t>(row) * columns_ + column];
  const int right = columns_ > 1 ? 1 : 0;
  const int below = rows_ > 1 ? columns_ : 0;
  const auto blend = [&](float Value::*field) {
    const float low = corner->*field + fx * (corner[right].*field - corner->*field);
    const float high =
        corner[below].*field + fx * (corner[below + right].*field - corner[below].*field);
    return low + fy * (high - low);
  };
  return {blend(&Value::seen), blend(&Value::run_off)};
}

std::vector<AmbientMap> BakeAmbientMaps(const PatchWorld& /*world*/,
                                        const RayScene& /*scene*/,
                                        int num_facets,
                                        int /*num_threads*/) {
  return std::vector<AmbientMap>(num_facets);
}

}  // namespace plumb::internal
