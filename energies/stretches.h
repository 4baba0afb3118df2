// Isotropic densities of planar maps and of volumes from a formula of the singular values of J, the
// principal stretches of mechanics. The last of them has the sign of det J.
//
//   auto arap = stretches<3>("arap", [](const auto& s) { return (s - 1.0) * (s - 1.0); });
//   auto mine = stretches<2>("mine", [](const auto& a, const auto& b) { return a * a * b * b; });
//
// A formula of one value is summed over all values. A formula of as many values as dimensions must
// be symmetric in them.
//
// With J = U diag(s) V^T, U and V rotations, and A = U^T dJ V the derivatives of f(s) are
//     df  = sum_i f_i A_ii,
//     d2f = sum_ij f_ij A_ii A_jj + sum_{i<j} [ a_ij (A_ij + A_ji)^2 + b_ij (A_ij - A_ji)^2 ] / 2,
//     a_ij = (f_i - f_j) / (s_i - s_j),   b_ij = (f_i + f_j) / (s_i + s_j)
// [SGK19]; a_ij at equal values is f_ii - f_ij.
//
// For planar maps in parametrize(), spectral() (spectral.h) is faster and supports more models of
// curvature.
#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/dual2.h"

namespace majorant {

template <int D, class Formula>
class StretchDensity {
  static_assert(D == 2 || D == 3);

 public:
  static constexpr int rows = D, dims = D, size = D * D;
  // True if the formula takes one value and is summed over all.
  static constexpr bool is_sum = D == 2
                                     ? !std::is_invocable_v<const Formula&, double, double>
                                     : !std::is_invocable_v<const Formula&, double, double, double>;
  const Traits traits;

  StretchDensity(std::string name, Formula formula, const Traits& t)
      : traits(t), formula_(std::move(formula)), name_(std::move(name)) {}
  std::string_view name() const { return name_; }
  bool supports(Curvature c) const { return c == Curvature::Projected || c == Curvature::Exact; }

  double value(const double (&z)[size]) const {
    const Factors factors(z);
    double sum = 0;
    if constexpr (is_sum)
      for (int i = 0; i < D; ++i) sum += formula_(factors.s[i]);
    else
      sum = joint([&factors](int i) { return factors.s[i]; });
    return inside_domain(sum, factors);
  }
  void slope(const double (&z)[size], PointModel<double, size>& m) const {
    const Factors factors(z);
    write_slope(factors, derivatives_at(factors), m);
  }
  void model(const double (&z)[size], PointModel<double, size>& m) const {
    const Factors factors(z);
    const Derivatives derivatives = derivatives_at(factors);
    write_slope(factors, derivatives, m);
    write_curvature(factors, derivatives, m);
  }

 private:
  using Matrix = Eigen::Matrix<double, D, D>;
  struct Factors {
    Matrix U, V;
    Eigen::Matrix<double, D, 1> s;
    explicit Factors(const double (&z)[size]) {
      const Matrix J = Eigen::Map<const Eigen::Matrix<double, D, D, Eigen::RowMajor>>(z);
      const Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
      U = svd.matrixU();
      V = svd.matrixV();
      s = svd.singularValues();
      if (U.determinant() < 0) turn(U);
      if (V.determinant() < 0) turn(V);
    }

   private:
    void turn(Matrix& rotation) {
      rotation.col(D - 1) = -rotation.col(D - 1);
      s[D - 1] = -s[D - 1];
    }
  };
  // Derivatives by the singular values.
  struct Derivatives {
    double f = 0;
    std::array<double, D> slope = {};
    std::array<std::array<double, D>, D> curvature = {};
  };

  template <class Value>
  auto joint(const Value& value) const {
    if constexpr (D == 2)
      return formula_(value(0), value(1));
    else
      return formula_(value(0), value(1), value(2));
  }

  Derivatives derivatives_at(const Factors& factors) const {
    Derivatives out;
    if constexpr (is_sum) {
      for (std::size_t i = 0; i < D; ++i) {
        const auto p =
            formula_(Dual2<double, 1>::variable(factors.s[static_cast<Eigen::Index>(i)], 0));
        out.f = i == 0 ? p.v : out.f + p.v;
        out.slope[i] = p.d[0];
        out.curvature[i][i] = p.h[0];
      }
    } else {
      const auto f =
          joint([&factors](int i) { return Dual2<double, D>::variable(factors.s[i], i); });
      out.f = f.v;
      for (std::size_t i = 0; i < D; ++i) {
        out.slope[i] = f.d[i];
        for (std::size_t j = 0; j < D; ++j)
          out.curvature[i][j] = f.hess(static_cast<int>(i), static_cast<int>(j));
      }
    }
    return out;
  }
  double inside_domain(double f, const Factors& factors) const {
    const bool inside = f == f && (traits.domain == Domain::Everywhere || factors.s[D - 1] > 0);
    return inside ? f : std::numeric_limits<double>::infinity();
  }

  void write_slope(const Factors& factors, const Derivatives& by_value,
                   PointModel<double, size>& m) const {
    m.f = inside_domain(by_value.f, factors);
    const auto slopes = Eigen::Map<const Eigen::Matrix<double, D, 1>>(by_value.slope.data());
    const Matrix G = factors.U * slopes.asDiagonal() * factors.V.transpose();
    for (int r = 0; r < size; ++r) m.g[r] = G(r / D, r % D);
  }

  void write_curvature(const Factors& factors, const Derivatives& by_value,
                       PointModel<double, size>& m) const {
    for (double& entry : m.k) entry = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Matrix along = factors.U.col(row) * factors.V.col(row).transpose();
      add(by_value.curvature[i][i], along, m);
      for (std::size_t j = 0; j < i; ++j) {
        const auto column = static_cast<Eigen::Index>(j);
        const double si = factors.s[row], sj = factors.s[column], di = by_value.slope[i],
                     dj = by_value.slope[j];
        const double difference = si - sj, sum = si + sj;
        // Closer values count as equal, since their quotient would lose half of its digits.
        constexpr double kEqual = 1e-6;
        double scale = std::abs(si) + std::abs(sj);
        const bool are_equal = std::abs(difference) <= kEqual * scale;
        double a = are_equal ? (by_value.curvature[i][i] + by_value.curvature[j][j]) / 2
                             : (di - dj) / difference;
        if constexpr (!is_sum)
          if (are_equal) a -= by_value.curvature[i][j];
        // Where values cancel, at reflections and at 0, f has no second derivative. The sum is not
        // negative, since the last value has the least magnitude; with a positive determinant it is
        // `scale`.
        if (traits.domain == Domain::Everywhere) scale = std::max(scale, 1.0);
        const double b = (di + dj) / std::max(sum, kEqual * scale);
        const Matrix P = factors.U.col(row) * factors.V.col(column).transpose(),
                     Q = factors.U.col(column) * factors.V.col(row).transpose();
        add(a / 2, P + Q, m);
        add(b / 2, P - Q, m);
        if constexpr (!is_sum) {
          const Matrix across = factors.U.col(column) * factors.V.col(column).transpose();
          add(by_value.curvature[i][j] / 2, along + across, m);
          add(-by_value.curvature[i][j] / 2, along - across, m);
        }
      }
    }
  }
  static void add(double factor, const Matrix& A, PointModel<double, size>& m) {
    for (int r = 0, p = 0; r < size; ++r)
      for (int q = 0; q <= r; ++q, ++p) m.k[p] += factor * A(r / D, r % D) * A(q / D, q % D);
  }

  Formula formula_;
  std::string name_;
};

template <int D, class Formula>
StretchDensity<D, Formula> stretches(std::string name, Formula formula, const Traits& traits = {}) {
  return {std::move(name), std::move(formula), traits};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
