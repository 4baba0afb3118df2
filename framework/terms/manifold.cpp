#include "majorant/framework/terms/manifold.h"

#include <Eigen/SVD>
#include <array>
#include <cmath>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

class UnitSphere final : public Manifold {
 public:
  explicit UnitSphere(int size) : size_(size) {
    if (size < 2)
      throw InvalidArgument("unit_sphere: points of " + std::to_string(size) +
                            " numbers, 2 or more are needed");
  }
  std::string_view name() const override { return "sphere"; }
  int size() const override { return size_; }
  int dimension() const override { return size_ - 1; }

  // With v = p + B t and x = v / |v|:
  //     dx/da = (B_a - x (x.B_a)) / |v|
  //     d2x/dadb = (3 x (x.B_a) (x.B_b) - B_a (x.B_b) - B_b (x.B_a) - x (B_a.B_b)) / |v|^2
  void retract(const double* base, const double* t, double* x, double* slopes,
               double* bends) const override {
    const int n = size_, d = n - 1;
    // The columns of B are those of the reflection that takes p to the axis k, without the k-th
    // column, which is p. The sign of p_k keeps p + sign e_k away from 0.
    int k = 0;
    for (int i = 1; i < n; ++i)
      if (std::abs(base[i]) > std::abs(base[k])) k = i;
    const double sign = base[k] < 0 ? -1 : 1, factor = 1 / (1 + std::abs(base[k]));
    const auto reflector = [&](int i) { return base[i] + (i == k ? sign : 0.0); };
    const auto axis = [&](int a) { return a < k ? a : a + 1; };
    const auto basis = [&](int i, int a) {
      return (i == axis(a) ? 1.0 : 0.0) - factor * reflector(i) * reflector(axis(a));
    };
    double square = 0;
    for (int i = 0; i < n; ++i) {
      x[i] = base[i];
      for (int a = 0; a < d; ++a) x[i] += basis(i, a) * t[a];
      square += x[i] * x[i];
    }
    const double length = std::sqrt(square);
    for (int i = 0; i < n; ++i) x[i] /= length;
    if (!slopes && !bends) return;
    Vec along = Vec::Zero(d);  // x.B_a
    for (int a = 0; a < d; ++a)
      for (int i = 0; i < n; ++i) along[a] += x[i] * basis(i, a);
    for (int i = 0; i < n; ++i) {
      for (int a = 0; slopes && a < d; ++a)
        slopes[i * d + a] = (basis(i, a) - x[i] * along[a]) / length;
      for (int a = 0, h = i * d * (d + 1) / 2; bends && a < d; ++a)
        for (int b = 0; b <= a; ++b, ++h)
          bends[h] = (3 * x[i] * along[a] * along[b] - basis(i, a) * along[b] -
                      basis(i, b) * along[a] - (a == b ? x[i] : 0.0)) /
                     square;
    }
  }

  bool project(double* x) const override {
    Eigen::Map<Vec> point(x, size_);
    const double largest = point.lpNorm<Eigen::Infinity>();
    if (!(largest > 0) || !std::isfinite(largest)) return false;
    point /= largest;
    point /= point.norm();
    return true;
  }

 private:
  int size_;
};

class RotationMatrices final : public Manifold {
 public:
  std::string_view name() const override { return "rotation"; }
  int size() const override { return 9; }
  int dimension() const override { return 3; }

  void retract(const double* base, const double* t, double* x, double* slopes,
               double* bends) const override {
    using Variable = Dual2<double, 3>;
    const Variable p = Variable::variable(t[0], 0) * 0.5, q = Variable::variable(t[1], 1) * 0.5,
                   r = Variable::variable(t[2], 2) * 0.5;
    const Variable inverse = 1.0 / (1.0 + p * p + q * q + r * r);
    // The rotation of the quaternion (1, p, q, r), times the squared length of the quaternion.
    const std::array<Variable, 9> c{
        1.0 + p * p - q * q - r * r, 2.0 * (p * q - r),           2.0 * (p * r + q),
        2.0 * (p * q + r),           1.0 - p * p + q * q - r * r, 2.0 * (q * r - p),
        2.0 * (p * r - q),           2.0 * (q * r + p),           1.0 - p * p - q * q + r * r};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        Variable sum(0.0);
        for (int k = 0; k < 3; ++k) sum = sum + base[3 * row + k] * c[to_size(3 * k + column)];
        sum = sum * inverse;
        const int i = 3 * row + column;
        x[i] = sum.v;
        for (int a = 0; slopes && a < 3; ++a) slopes[3 * i + a] = sum.d[to_size(a)];
        for (int h = 0; bends && h < 6; ++h) bends[6 * i + h] = sum.h[to_size(h)];
      }
  }

  bool project(double* x) const override {
    // Works by columns and by rows: the nearest rotation to a transpose is the transposed nearest
    // one.
    Eigen::Map<Eigen::Matrix3d> matrix(x);
    if (!matrix.allFinite()) return false;
    const Eigen::BDCSVD<Eigen::Matrix3d> parts(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d &U = parts.matrixU(), &V = parts.matrixV();
    const double sign = U.determinant() * V.determinant() < 0 ? -1.0 : 1.0;
    const Eigen::Vector3d singular = parts.singularValues();
    // A second rotation is as near if the two smallest values cancel.
    if (!(singular[1] + sign * singular[2] > 0)) return false;
    matrix = (U * Eigen::Vector3d(1, 1, sign).asDiagonal() * V.transpose()).eval();
    return true;
  }
};

}  // namespace

std::shared_ptr<const Manifold> unit_sphere(int size) {
  return std::make_shared<const UnitSphere>(size);
}

std::shared_ptr<const Manifold> rotation_matrices() {
  return std::make_shared<const RotationMatrices>();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
