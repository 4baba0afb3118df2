// Isotropic densities of volumes from one line: the sum of a function of each singular value of J,
// the last of which has the sign of det J.
//
//     auto arap = solid_spectral("arap", [](const auto& s) { return (s - 1.0) * (s - 1.0); });
//
// With J = U diag(s) V^T, U and V rotations, and A = U^T dJ V the derivatives of f = sum p(s_i) are
//     df  = sum_i p'(s_i) A_ii,
//     d2f = sum_i p''(s_i) A_ii^2 + sum_{i<j} [ a_ij (A_ij + A_ji)^2 + b_ij (A_ij - A_ji)^2 ] / 2,
//     a_ij = (p'(s_i) - p'(s_j)) / (s_i - s_j),   b_ij = (p'(s_i) + p'(s_j)) / (s_i + s_j)
// [SGK19]; a_ij at equal values is p''.
#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/dual2.h"

namespace majorant {

template <class Formula>
class SolidSpectralDensity {
 public:
  static constexpr int rows = 3, dims = 3, size = 9;
  const Traits traits;

  SolidSpectralDensity(std::string name, Formula p, const Traits& t)
      : traits(t), p_(std::move(p)), name_(std::move(name)) {}
  std::string_view name() const { return name_; }
  bool supports(Curvature c) const { return c == Curvature::Projected || c == Curvature::Exact; }

  double value(const double (&z)[size]) const {
    const Factors factors(z);
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += p_(factors.s[i]);
    return inside_domain(sum, factors);
  }
  void slope(const double (&z)[size], PointModel<double, size>& m) const {
    const Factors factors(z);
    write_slope(factors, jets_at(factors), m);
  }
  void model(const double (&z)[size], PointModel<double, size>& m) const {
    const Factors factors(z);
    const Jets jets = jets_at(factors);
    write_slope(factors, jets, m);
    write_curvature(factors, jets, m);
  }

 private:
  using Matrix = Eigen::Matrix3d;
  struct Factors {
    Matrix U, V;
    Eigen::Vector3d s;
    explicit Factors(const double (&z)[size]) {
      const Matrix J = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(z);
      const Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
      U = svd.matrixU();
      V = svd.matrixV();
      s = svd.singularValues();
      if (U.determinant() < 0) turn(U);
      if (V.determinant() < 0) turn(V);
    }

   private:
    void turn(Matrix& rotation) {
      rotation.col(2) = -rotation.col(2);
      s[2] = -s[2];
    }
  };
  using Jet = Dual2<double, 1>;
  using Jets = std::array<Jet, 3>;

  Jets jets_at(const Factors& factors) const {
    Jets jets;
    for (int i = 0; i < 3; ++i)
      jets[static_cast<std::size_t>(i)] = p_(Jet::variable(factors.s[i], 0));
    return jets;
  }
  double inside_domain(double f, const Factors& factors) const {
    const bool inside = f == f && (traits.domain == Domain::Everywhere || factors.s[2] > 0);
    return inside ? f : std::numeric_limits<double>::infinity();
  }

  void write_slope(const Factors& factors, const Jets& jets, PointModel<double, size>& m) const {
    m.f = inside_domain(jets[0].v + jets[1].v + jets[2].v, factors);
    const Eigen::Vector3d by_value(jets[0].d[0], jets[1].d[0], jets[2].d[0]);
    const Matrix G = factors.U * by_value.asDiagonal() * factors.V.transpose();
    for (int r = 0; r < size; ++r) m.g[r] = G(r / 3, r % 3);
  }

  void write_curvature(const Factors& factors, const Jets& jets,
                       PointModel<double, size>& m) const {
    for (double& entry : m.k) entry = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      add(jets[i].h[0], factors.U.col(row) * factors.V.col(row).transpose(), m);
      for (std::size_t j = 0; j < i; ++j) {
        const auto column = static_cast<Eigen::Index>(j);
        const double si = factors.s[row], sj = factors.s[column], di = jets[i].d[0],
                     dj = jets[j].d[0];
        const double difference = si - sj, sum = si + sj;
        // Closer values are equal: their quotient would have lost half of its digits.
        constexpr double kEqual = 1e-6;
        double scale = std::abs(si) + std::abs(sj);
        const bool are_equal = std::abs(difference) <= kEqual * scale;
        const double a = are_equal ? (jets[i].h[0] + jets[j].h[0]) / 2 : (di - dj) / difference;
        // Where values cancel, at reflections and at 0, f has no second derivative. The sum is not
        // negative, as s_2 is the least in magnitude; with a positive determinant it is `scale`.
        if (traits.domain == Domain::Everywhere) scale = std::max(scale, 1.0);
        const double b = (di + dj) / std::max(sum, kEqual * scale);
        const Matrix P = factors.U.col(row) * factors.V.col(column).transpose(),
                     Q = factors.U.col(column) * factors.V.col(row).transpose();
        add(a / 2, P + Q, m);
        add(b / 2, P - Q, m);
      }
    }
  }
  static void add(double factor, const Matrix& A, PointModel<double, size>& m) {
    for (int r = 0, p = 0; r < size; ++r)
      for (int q = 0; q <= r; ++q, ++p) m.k[p] += factor * A(r / 3, r % 3) * A(q / 3, q % 3);
  }

  Formula p_;
  std::string name_;
};

template <class Formula>
SolidSpectralDensity<Formula> solid_spectral(std::string name, Formula p,
                                             const Traits& traits = {}) {
  return {std::move(name), std::move(p), traits};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
