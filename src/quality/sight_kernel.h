// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/simd.h"
#include "plumbline/camera/projection.h"
#include "plumbline/quality/quality_block.h"

namespace plumb::internal {

// Centres and unit normals of faces [map], an array for each coordinate.
struct FaceArrays {
  FaceArrays() = default;
  explicit FaceArrays(const std::vector<FaceShape>& shapes);

  std::size_t size() const { return center[0].size(); }

  std::array<std::vector<double>, 3> center;
  std::array<std::vector<double>, 3> normal;
};

// A camera where it was, as plain numbers.
struct SightNumbers {
  std::array<double, 9> rotation;     // cam_from_map, row by row.
  std::array<double, 3> translation;  // Of the same.
  std::array<double, 3> eye;          // [map]
  LensParameters<double> lens;
  double max_radius2 = 0.0;  // Of normalised coordinates; beyond it, nothing is projected.
  double width_px = 0.0;
  double height_px = 0.0;
};

// For each face the longest stretch on its plane that one pixel takes in [map units per px]: the
// inverse of the least singular value of J on the plane, J being the derivative of the pixel with
// the point, 2 x 3, distortion included. 0 if the face's centre is outside of the
// photo or the face is turned away. `stretches` has room for all faces.
// `level`, here and below, must be one that this processor has; all give the same bits.
void FindStretches(const SightNumbers& sight,
                   const FaceArrays& faces,
                   float* stretches,
                   SimdLevel level = DetectSimdLevel());

// Sums over the photos that show a face.
struct SightSums {
  explicit SightSums(std::size_t num_faces);

  std::vector<float> least_stretch;  // Infinite where no photo shows the face.
  std::vector<std::uint16_t> num_seen;
  std::vector<std::uint16_t> num_hidden;
  // Upper triangle of the sum of J^T J, row by row.
  std::array<std::vector<double>, 6> information;
};

// Adds what one photo shows: the stretch of each face, negative where it is hidden, 0 where it is
// not in the photo.
void AddSight(const SightNumbers& sight,
              const FaceArrays& faces,
              const float* stretches,
              SightSums* sums,
              SimdLevel level = DetectSimdLevel());

}  // namespace plumb::internal
