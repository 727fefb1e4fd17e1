// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops without branches, which the compiler makes into vector code for each kind of processor.
// Nothing is contracted to fused operations (cmake/core.cmake), so that all give the same bits.
#include "quality/sight_kernel.h"

#include <cmath>
#include <limits>

#include "plumbline/common/check.h"

namespace plumb::internal {
namespace {

// Of one face, in the camera's frame.
struct FaceInCam {
  double x, y, z;     // Of its centre: x / z, y / z, z.
  double nx, ny, nz;  // Its normal.
};

// Where a point is in the photo, and J in the camera's frame, row by row.
struct Projection {
  double x_px, y_px;
  double a, b, c;
  double d, e, f;
};

PLUMB_SIMD_INLINE double Rotated(const SightNumbers& s, int row, double x, double y, double z) {
  const double* r = &s.rotation[static_cast<std::size_t>(3 * row)];
  return r[0] * x + r[1] * y + r[2] * z;
}

PLUMB_SIMD_INLINE FaceInCam CenterInCam(const SightNumbers& s,
                                        double center_x,
                                        double center_y,
                                        double center_z) {
  FaceInCam face{};
  face.z = Rotated(s, 2, center_x, center_y, center_z) + s.translation[2];
  const double inverse_z = 1.0 / face.z;
  face.x = (Rotated(s, 0, center_x, center_y, center_z) + s.translation[0]) * inverse_z;
  face.y = (Rotated(s, 1, center_x, center_y, center_z) + s.translation[1]) * inverse_z;
  return face;
}

// Distort and ProjectToPixel (camera/projection.h) and their derivative, written again because a
// loop that calls a function is no vector code.
PLUMB_SIMD_INLINE Projection Project(const LensParameters<double>& lens, const FaceInCam& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  const double numerator = 1.0 + r2 * (lens[kK1] + r2 * (lens[kK2] + r2 * lens[kK3]));
  const double denominator = 1.0 + r2 * (lens[kK4] + r2 * (lens[kK5] + r2 * lens[kK6]));
  const double radial = numerator / denominator;
  const double numerator_by_r2 = lens[kK1] + r2 * (2.0 * lens[kK2] + 3.0 * r2 * lens[kK3]);
  const double denominator_by_r2 = lens[kK4] + r2 * (2.0 * lens[kK5] + 3.0 * r2 * lens[kK6]);
  const double radial_by_r2 = (numerator_by_r2 - radial * denominator_by_r2) / denominator;
  const double mixed = 2.0 * (p.x * p.y * radial_by_r2 + lens[kP1] * p.x + lens[kP2] * p.y);
  const double x_by_x =
      radial + 2.0 * p.x * p.x * radial_by_r2 + 2.0 * lens[kP1] * p.y + 6.0 * lens[kP2] * p.x;
  const double y_by_y =
      radial + 2.0 * p.y * p.y * radial_by_r2 + 6.0 * lens[kP1] * p.y + 2.0 * lens[kP2] * p.x;
  const double x = radial * p.x + 2.0 * lens[kP1] * p.x * p.y + lens[kP2] * (r2 + 2.0 * p.x * p.x);
  const double y = radial * p.y + lens[kP1] * (r2 + 2.0 * p.y * p.y) + 2.0 * lens[kP2] * p.x * p.y;
  const double fx = lens[kFx] / p.z;
  const double fy = lens[kFy] / p.z;
  return {lens[kFx] * x + lens[kCx],
          lens[kFy] * y + lens[kCy],
          fx * x_by_x,
          fx * mixed,
          -fx * (x_by_x * p.x + mixed * p.y),
          fy * mixed,
          fy * y_by_y,
          -fy * (mixed * p.x + y_by_y * p.y)};
}

// As Camera::Project and Camera::IsInImage tell it. No && and no ||: they would be branches.
PLUMB_SIMD_INLINE int IsInPhoto(const SightNumbers& s, const FaceInCam& p, const Projection& j) {
  int is_so = static_cast<int>(p.z > 0.0);
  is_so &= static_cast<int>(p.x * p.x + p.y * p.y <= s.max_radius2);
  is_so &= static_cast<int>(j.x_px >= -0.5);
  is_so &= static_cast<int>(j.y_px >= -0.5);
  is_so &= static_cast<int>(j.x_px < s.width_px - 0.5);
  is_so &= static_cast<int>(j.y_px < s.height_px - 0.5);
  return is_so;
}

// Of the 2 x 2 matrix of what the pixel does along two perpendicular directions on the plane (Duff
// et al., Building an orthonormal basis, revisited, JCGT 6(1), 2017): least singular value =
// |determinant| / largest one.
PLUMB_SIMD_INLINE double StretchOn(const Projection& j, const FaceInCam& p) {
  const double sign = std::copysign(1.0, p.nz);
  const double scale = -1.0 / (sign + p.nz);
  const double product = p.nx * p.ny * scale;
  const double ux = 1.0 + sign * p.nx * p.nx * scale;
  const double uy = sign * product;
  const double uz = -sign * p.nx;
  const double vx = product;
  const double vy = sign + p.ny * p.ny * scale;
  const double vz = -p.ny;
  const double x_by_u = j.a * ux + j.b * uy + j.c * uz;
  const double y_by_u = j.d * ux + j.e * uy + j.f * uz;
  const double x_by_v = j.a * vx + j.b * vy + j.c * vz;
  const double y_by_v = j.d * vx + j.e * vy + j.f * vz;
  const double determinant = x_by_u * y_by_v - y_by_u * x_by_v;
  const double u2 = x_by_u * x_by_u + y_by_u * y_by_u;
  const double v2 = x_by_v * x_by_v + y_by_v * y_by_v;
  const double uv = x_by_u * x_by_v + y_by_u * y_by_v;
  const double half_difference = 0.5 * (u2 - v2);
  const double largest2 = 0.5 * (u2 + v2) + std::sqrt(half_difference * half_difference + uv * uv);
  return std::sqrt(largest2) / std::abs(determinant);
}

PLUMB_SIMD_INLINE void FindStretchesBody(const SightNumbers& sight,
                                         const FaceArrays& faces,
                                         float* stretches) {
  const SightNumbers s = sight;  // `stretches` may not be thought to be part of it.
  const std::size_t num_faces = faces.size();
  const double* cx = faces.center[0].data();
  const double* cy = faces.center[1].data();
  const double* cz = faces.center[2].data();
  const double* nx = faces.normal[0].data();
  const double* ny = faces.normal[1].data();
  const double* nz = faces.normal[2].data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < num_faces; ++i) {
    FaceInCam face = CenterInCam(s, cx[i], cy[i], cz[i]);
    face.nx = Rotated(s, 0, nx[i], ny[i], nz[i]);
    face.ny = Rotated(s, 1, nx[i], ny[i], nz[i]);
    face.nz = Rotated(s, 2, nx[i], ny[i], nz[i]);
    const double towards_eye =
        nx[i] * (s.eye[0] - cx[i]) + ny[i] * (s.eye[1] - cy[i]) + nz[i] * (s.eye[2] - cz[i]);
    const Projection projection = Project(s.lens, face);
    const auto stretch = static_cast<float>(StretchOn(projection, face));
    int is_shown = IsInPhoto(s, face, projection);
    is_shown &= static_cast<int>(towards_eye > 0.0);
    is_shown &= static_cast<int>(stretch > 0.0F);
    stretches[i] = is_shown != 0 ? stretch : 0.0F;
  }
}

PLUMB_SIMD_INLINE void AddInformationBody(const SightNumbers& sight,
                                          const FaceArrays& faces,
                                          const float* stretches,
                                          SightSums* sums) {
  const SightNumbers s = sight;
  const std::size_t num_faces = faces.size();
  const double* cx = faces.center[0].data();
  const double* cy = faces.center[1].data();
  const double* cz = faces.center[2].data();
  double* xx = sums->information[0].data();
  double* xy = sums->information[1].data();
  double* xz = sums->information[2].data();
  double* yy = sums->information[3].data();
  double* yz = sums->information[4].data();
  double* zz = sums->information[5].data();
  const auto& r = s.rotation;
#pragma GCC ivdep
  for (std::size_t i = 0; i < num_faces; ++i) {
    const Projection j = Project(s.lens, CenterInCam(s, cx[i], cy[i], cz[i]));
    const double ux = j.a * r[0] + j.b * r[3] + j.c * r[6];
    const double uy = j.a * r[1] + j.b * r[4] + j.c * r[7];
    const double uz = j.a * r[2] + j.b * r[5] + j.c * r[8];
    const double vx = j.d * r[0] + j.e * r[3] + j.f * r[6];
    const double vy = j.d * r[1] + j.e * r[4] + j.f * r[7];
    const double vz = j.d * r[2] + j.e * r[5] + j.f * r[8];
    const bool is_seen = stretches[i] > 0.0F;
    xx[i] += is_seen ? ux * ux + vx * vx : 0.0;
    xy[i] += is_seen ? ux * uy + vx * vy : 0.0;
    xz[i] += is_seen ? ux * uz + vx * vz : 0.0;
    yy[i] += is_seen ? uy * uy + vy * vy : 0.0;
    yz[i] += is_seen ? uy * uz + vy * vz : 0.0;
    zz[i] += is_seen ? uz * uz + vz * vz : 0.0;
  }
}

PLUMB_SIMD_INLINE void AddStretchesBody(const float* stretches, SightSums* sums) {
  const std::size_t num_faces = sums->num_seen.size();
  float* least = sums->least_stretch.data();
  std::uint16_t* num_seen = sums->num_seen.data();
  std::uint16_t* num_hidden = sums->num_hidden.data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < num_faces; ++i) {
    const float stretch = stretches[i];
    least[i] = (stretch > 0.0F) & (stretch < least[i]) ? stretch : least[i];
    num_seen[i] = static_cast<std::uint16_t>(num_seen[i] + (stretch > 0.0F ? 1 : 0));
    num_hidden[i] = static_cast<std::uint16_t>(num_hidden[i] + (stretch < 0.0F ? 1 : 0));
  }
}

PLUMB_SIMD_INLINE void AddSightBody(const SightNumbers& s,
                                    const FaceArrays& faces,
                                    const float* stretches,
                                    SightSums* sums) {
  AddStretchesBody(stretches, sums);
  AddInformationBody(s, faces, stretches, sums);
}

#if defined(__x86_64__)
PLUMB_TARGET_AVX2 void FindStretchesAvx2(const SightNumbers& s,
                                         const FaceArrays& faces,
                                         float* stretches) {
  FindStretchesBody(s, faces, stretches);
}

PLUMB_TARGET_AVX512 void FindStretchesAvx512(const SightNumbers& s,
                                             const FaceArrays& faces,
                                             float* stretches) {
  FindStretchesBody(s, faces, stretches);
}

PLUMB_TARGET_AVX2 void AddSightAvx2(const SightNumbers& s,
                                    const FaceArrays& faces,
                                    const float* stretches,
                                    SightSums* sums) {
  AddSightBody(s, faces, stretches, sums);
}

PLUMB_TARGET_AVX512 void AddSightAvx512(const SightNumbers& s,
                                        const FaceArrays& faces,
                                        const float* stretches,
                                        SightSums* sums) {
  AddSightBody(s, faces, stretches, sums);
}
#endif

}  // namespace

FaceArrays::FaceArrays(const std::vector<FaceShape>& shapes) {
  for (std::size_t k = 0; k < 3; ++k) {
    center[k].reserve(shapes.size());
    normal[k].reserve(shapes.size());
    for (const FaceShape& shape : shapes) {
      center[k].push_back(shape.center_in_map[static_cast<Eigen::Index>(k)]);
      normal[k].push_back(shape.normal_in_map[static_cast<Eigen::Index>(k)]);
    }
  }
}

SightSums::SightSums(std::size_t num_faces)
    : least_stretch(num_faces, std::numeric_limits<float>::infinity()),
      num_seen(num_faces, 0),
      num_hidden(num_faces, 0) {
  for (std::vector<double>& entry : information) entry.resize(num_faces, 0.0);
}

void FindStretches(const SightNumbers& sight,
                   const FaceArrays& faces,
                   float* stretches,
                   SimdLevel level) {
  PLUMB_CHECK(level <= DetectSimdLevel());
#if defined(__x86_64__)
  if (level == SimdLevel::kAvx512) return FindStretchesAvx512(sight, faces, stretches);
  if (level == SimdLevel::kAvx2) return FindStretchesAvx2(sight, faces, stretches);
#endif
  FindStretchesBody(sight, faces, stretches);
}

void AddSight(const SightNumbers& sight,
              const FaceArrays& faces,
              const float* stretches,
              SightSums* sums,
              SimdLevel level) {
  PLUMB_CHECK(level <= DetectSimdLevel());
#if defined(__x86_64__)
  if (level == SimdLevel::kAvx512) return AddSightAvx512(sight, faces, stretches, sums);
  if (level == SimdLevel::kAvx2) return AddSightAvx2(sight, faces, stretches, sums);
#endif
  AddSightBody(sight, faces, stretches, sums);
}

}  // namespace plumb::internal
