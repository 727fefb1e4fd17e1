// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/five_point.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "geometry/real_roots.h"

// Nister, An Efficient Solution to the Five-Point Relative Pose Problem, TPAMI 26(6), 2004,
// with his names of steps and order of monomials.
namespace plumb {
namespace {

// E = x X + y Y + z Z + W. Polynomials in (x, y, z) by coefficient; "variable" 3 is 1.
using Linear = Eigen::Vector4d;
using Quadratic = Eigen::Matrix<double, 10, 1>;
using Cubic = Eigen::Matrix<double, 20, 1>;

// Index of the monomial v_i v_j.
constexpr int kQuadraticIndex[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};

// Index of v_i times the quadratic monomial j, in the order of eq. (10): x3 y3 x2y xy2 x2z x2
// y2z y2 xyz xy | xz2 xz x yz2 yz y z3 z2 z 1.
constexpr int kCubicIndex[4][10] = {{0, 2, 4, 5, 3, 8, 9, 10, 11, 12},
                                    {2, 3, 8, 9, 1, 6, 7, 13, 14, 15},
                                    {4, 8, 10, 11, 6, 13, 14, 16, 17, 18},
                                    {5, 9, 11, 12, 7, 14, 15, 17, 18, 19}};

Quadratic Multiply(const Linear& a, const Linear& b) {
  Quadratic product = Quadratic::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) product[kQuadraticIndex[i][j]] += a[i] * b[j];
  }
  return product;
}

Cubic MultiplyToCubic(const Linear& a, const Quadratic& b) {
  Cubic product = Cubic::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 10; ++j) product[kCubicIndex[i][j]] += a[i] * b[j];
  }
  return product;
}

// Row-major entries of X, Y, Z, W as columns: the null space of the epipolar constraints.
using Basis = Eigen::Matrix<double, 9, 4>;

Basis EpipolarNullSpace(const std::array<Eigen::Vector2d, 5>& xy1,
                        const std::array<Eigen::Vector2d, 5>& xy2) {
  Eigen::Matrix<double, 9, 5> constraints;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d x1 = xy1[i].homogeneous();
    const Eigen::Vector3d x2 = xy2[i].homogeneous();
    for (int row = 0; row < 3; ++row) constraints.col(i).segment<3>(3 * row) = x2[row] * x1;
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 5>> qr(constraints);
  const Eigen::Matrix<double, 9, 9> q = qr.householderQ();
  return q.rightCols<4>();
}

// det E = 0 and E E^T E - trace(E E^T) E / 2 = 0: ten cubics, one a row.
Eigen::Matrix<double, 10, 20> CubicConstraints(const Basis& basis) {
  std::array<std::array<Linear, 3>, 3> e;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) e[i][j] = basis.row(3 * i + j).transpose();
  }
  Eigen::Matrix<double, 10, 20> constraints;
  Cubic determinant = Cubic::Zero();
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3;
    const int l = (j + 2) % 3;
    determinant +=
        MultiplyToCubic(e[0][j], Multiply(e[1][k], e[2][l]) - Multiply(e[1][l], e[2][k]));
  }
  constraints.row(0) = determinant.transpose();

  std::array<std::array<Quadratic, 3>, 3> lambda;  // E E^T - trace(E E^T) I / 2.
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      lambda[i][j] =
          Multiply(e[i][0], e[j][0]) + Multiply(e[i][1], e[j][1]) + Multiply(e[i][2], e[j][2]);
      lambda[j][i] = lambda[i][j];
    }
  }
  const Quadratic half_trace = 0.5 * (lambda[0][0] + lambda[1][1] + lambda[2][2]);
  for (int i = 0; i < 3; ++i) lambda[i][i] -= half_trace;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      constraints.row(1 + 3 * i + j) =
          (MultiplyToCubic(e[0][j], lambda[i][0]) + MultiplyToCubic(e[1][j], lambda[i][1]) +
           MultiplyToCubic(e[2][j], lambda[i][2]))
              .transpose();
    }
  }
  return constraints;
}

// Polynomials in z, lowest power first.
using InZ = std::array<double, kRootsDegree + 1>;

InZ Product(const InZ& a, int degree_a, const InZ& b, int degree_b) {
  InZ product = {};
  for (int i = 0; i <= degree_a; ++i) {
    for (int j = 0; j <= degree_b; ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

InZ Difference(const InZ& a, const InZ& b) {
  InZ difference;
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

// The matrix B of eqs. (20) to (22): B(z) (x, y, 1)^T = 0, degrees (3, 3, 4).
using MatrixInZ = std::array<std::array<InZ, 3>, 3>;

MatrixInZ EliminationMatrix(const Eigen::Matrix<double, 10, 10>& reduced) {
  MatrixInZ b = {};
  for (int row = 0; row < 3; ++row) {
    const auto upper = reduced.row(4 + 2 * row);  // e, g, i: x2z, y2z, xyz.
    const auto lower = reduced.row(5 + 2 * row);  // f, h, j: x2, y2, xy.
    const std::array<int, 3> first = {0, 3, 6};
    const std::array<int, 3> degree = {2, 2, 3};
    for (int col = 0; col < 3; ++col) {
      for (int power = 0; power <= degree[col]; ++power) {
        const int source = first[col] + degree[col] - power;
        b[row][col][power] += upper[source];
        b[row][col][power + 1] -= lower[source];
      }
    }
  }
  return b;
}

InZ Determinant(const MatrixInZ& b) {
  InZ determinant = {};
  for (int i = 0; i < 3; ++i) {
    const auto& next = b[(i + 1) % 3];
    const auto& last = b[(i + 2) % 3];
    const InZ minor = Difference(Product(next[0], 3, last[1], 3), Product(next[1], 3, last[0], 3));
    const InZ term = Product(minor, 6, b[i][2], 4);
    for (std::size_t k = 0; k < term.size(); ++k) determinant[k] += term[k];
  }
  return determinant;
}

// (x, y, 1) up to scale: the null vector of B(z), by its two most independent rows.
Eigen::Vector3d NullVector(const MatrixInZ& b, double z) {
  Eigen::Matrix3d at_z;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double value = 0.0;
      for (int power = 4; power >= 0; --power) value = value * z + b[i][j][power];
      at_z(i, j) = value;
    }
  }
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d cross = at_z.row(i).transpose().cross(at_z.row((i + 1) % 3).transpose());
    if (cross.squaredNorm() > best.squaredNorm()) best = cross;
  }
  return best;
}

}  // namespace

std::vector<Eigen::Matrix3d> SolveFivePoint(const std::array<Eigen::Vector2d, 5>& xy1,
                                            const std::array<Eigen::Vector2d, 5>& xy2) {
  const Basis basis = EpipolarNullSpace(xy1, xy2);
  const Eigen::Matrix<double, 10, 20> constraints = CubicConstraints(basis);
  const Eigen::Matrix<double, 10, 10> reduced =
      constraints.leftCols<10>().partialPivLu().solve(constraints.rightCols<10>());
  if (!reduced.allFinite()) return {};
  const MatrixInZ b = EliminationMatrix(reduced);
  std::vector<Eigen::Matrix3d> essentials;
  for (const double z : RealRoots(Determinant(b))) {
    const Eigen::Vector3d xy1_null = NullVector(b, z);
    Eigen::Vector4d coefficients;
    coefficients << xy1_null.head<2>(), z * xy1_null.z(), xy1_null.z();
    const double norm = coefficients.norm();
    if (!(norm > 0.0) || !std::isfinite(norm)) continue;
    const Eigen::Matrix<double, 9, 1> entries = basis * (coefficients / norm);
    essentials.push_back(
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(entries.data()));
  }
  return essentials;
}

}  // namespace plumb
