// Densities on single triangles with prescribed Jacobians, and reference values in long double.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/energies/internal/instruction_sets.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/internal/symmetric_eigen.h"
#include "support.h"

namespace majorant::test {

// Twice the relative rounding error of one operation.
inline constexpr double kUnit = std::numeric_limits<double>::epsilon();

// Returns a random unit vector.
inline Vector2 direction(Random& random) {
  const double t = random.uniform(0, 2 * std::numbers::pi);
  return {std::cos(t), std::sin(t)};
}

using Matrix4 = Eigen::Matrix4d;
using Vector4 = Eigen::Vector4d;

// Value, gradient and Hessian in (a, b, c, d), J = [[a, b], [c, d]].
struct PointResult {
  double value = 0;
  Vector4 gradient = Vector4::Zero();
  Matrix4 hessian = Matrix4::Zero();
};

// One triangle per Jacobian on a common rest shape, the unit right triangle. The columns of J are
// corners 0 and 1, and corner 2 is the origin, so that the local system is the model in J.
struct Triangles {
  explicit Triangles(std::size_t count) {
    Cells faces(static_cast<Index>(count), 3);
    Points3 positions(3 * faces.rows(), 3);
    for (Index f = 0; f < faces.rows(); ++f) {
      faces.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
      positions.middleRows<3>(3 * f) << 1, 0, 0, 0, 1, 0, 0, 0, 0;
    }
    space = std::make_shared<const BezierTriangleSpace>(faces, 3 * faces.rows(), 1);
    rest = flat_triangles(positions, faces);
  }
  std::shared_ptr<const BezierTriangleSpace> space;
  RestShapes rest;
};

inline Vec corners_of(const std::vector<Eigen::Matrix2d>& jacobians) {
  Vec x = Vec::Zero(6 * static_cast<Index>(jacobians.size()));
  for (std::size_t e = 0; e < jacobians.size(); ++e) {
    x.segment<2>(6 * static_cast<Index>(e)) = jacobians[e].col(0);
    x.segment<2>(6 * static_cast<Index>(e) + 2) = jacobians[e].col(1);
  }
  return x;
}

// Elements 0..count-1 of a term, 128 at a time; Hessians unpacked.
struct ElementModels {
  std::vector<double> values;  // from values()
  std::vector<double> f;       // from local()
  std::vector<Vec> gradients;
  std::vector<Eigen::MatrixXd> hessians;
};

inline ElementModels element_models(const EnergyTerm& term, VecIn x, BlendedCurvature curvature) {
  ElementModels out;
  const Index count = term.element_dofs().element_count();
  const int n = term.element_dofs().local_size();
  std::vector<Index> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  Workspace workspace, local_workspace;
  constexpr std::size_t stride = LocalSystem::stride;
  for (Index first = 0; first < count; first += ElementBatch::kMaxSize) {
    const auto size =
        static_cast<std::size_t>(std::min<Index>(ElementBatch::kMaxSize, count - first));
    const ElementBatch batch{0, std::span<const Index>(all.data() + first, size)};
    std::vector<double> f(size);
    term.values(x, batch, {}, workspace, f);
    LocalSystem local;
    const auto unknowns = static_cast<std::size_t>(n);
    local.value = local_workspace.reserve((1 + unknowns + unknowns * (unknowns + 1) / 2) * stride);
    local.gradient = local.value + stride;
    local.hessian = local.gradient + unknowns * stride;
    term.local(x, batch, curvature, {}, workspace, local);
    for (std::size_t p = 0; p < size; ++p) {
      out.values.push_back(f[p]);
      out.f.push_back(local.value[p]);
      Vec g(n);
      Eigen::MatrixXd h(n, n);
      for (int i = 0, k = 0; i < n; ++i) {
        g[i] = local.gradient[static_cast<std::size_t>(i) * stride + p];
        for (int j = 0; j <= i; ++j, ++k)
          h(i, j) = h(j, i) = local.hessian[static_cast<std::size_t>(k) * stride + p];
      }
      out.gradients.push_back(g);
      out.hessians.push_back(h);
    }
  }
  return out;
}

// Returns a built-in energy with kernels of the baseline instruction set.
inline EnergyFactory baseline(const std::string& name) {
  for (const NamedEnergy& e : named_energies(InstructionSet::Baseline))
    if (e.name == name) return e.make;
  throw std::invalid_argument(name);
}

// Returns models in J; `term` is on Triangles.
inline std::vector<PointResult> point_models(const EnergyTerm& term,
                                             const std::vector<Eigen::Matrix2d>& jacobians,
                                             BlendedCurvature curvature) {
  const ElementModels models = element_models(term, corners_of(jacobians), curvature);
  std::vector<PointResult> out(jacobians.size());
  const int local[4] = {0, 2, 1, 3};  // a = u of corner 0, b = u of corner 1, ...
  for (std::size_t e = 0; e < jacobians.size(); ++e) {
    out[e].value = 2 * models.values[e];  // area 1/2
    for (int i = 0; i < 4; ++i) {
      out[e].gradient[i] = 2 * models.gradients[e][local[i]];
      for (int j = 0; j < 4; ++j) out[e].hessian(i, j) = 2 * models.hessians[e](local[i], local[j]);
    }
  }
  return out;
}

using Long = long double;
using Jet = Dual2<Long, 4>;

// Differentiates f(a, b, c, d) in long double, which has 11 bits more than double.
template <class F>
PointResult oracle(const F& f, const Eigen::Matrix2d& j) {
  const double x[4] = {j(0, 0), j(0, 1), j(1, 0), j(1, 1)};
  Jet v[4];
  for (int i = 0; i < 4; ++i) v[i] = Jet::variable(Long(x[i]), i);
  const Jet r = f(v[0], v[1], v[2], v[3]);
  PointResult m;
  m.value = static_cast<double>(r.v);
  for (int i = 0; i < 4; ++i) {
    m.gradient[i] = static_cast<double>(r.d[static_cast<std::size_t>(i)]);
    for (int k = 0; k < 4; ++k) m.hessian(i, k) = static_cast<double>(r.hess(i, k));
  }
  return m;
}

// The densities by their textbook formulas in the entries of J.
inline Jet direct_symmetric_dirichlet(const Jet& a, const Jet& b, const Jet& c, const Jet& d) {
  const Jet det = a * d - b * c, norm = a * a + b * b + c * c + d * d;
  return norm + norm / (det * det);
}
inline Jet direct_mips(const Jet& a, const Jet& b, const Jet& c, const Jet& d) {
  return (a * a + b * b + c * c + d * d) / (a * d - b * c);
}
// (S - 1)^2 + (s - 1)^2 = |J|^2 - 2 (S + s) + 2, S + s = 2 |alpha|.
inline Jet direct_arap(const Jet& a, const Jet& b, const Jet& c, const Jet& d) {
  const Jet p = a + d, q = c - b;
  return a * a + b * b + c * c + d * d - 2.0 * sqrt(p * p + q * q) + 2.0;
}

inline auto spectral_symmetric_dirichlet() {
  return spectral("sd",
                  [](auto S, auto s) { return S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s); },
                  {Domain::PositiveDeterminant, Convexity::Convex});
}
inline auto mips() {
  return invariant("mips", [](const auto& x, const auto& y) { return 2.0 * (x + y) / (x - y); },
                   {Domain::PositiveDeterminant, Convexity::Unknown});
}
inline auto spectral_mips() {
  return spectral("mips", [](auto S, auto s) { return S / s + s / S; },
                  {Domain::PositiveDeterminant, Convexity::Unknown});
}
inline auto arap() {
  return spectral("arap",
                  [](auto S, auto s) { return (S - 1.0) * (S - 1.0) + (s - 1.0) * (s - 1.0); },
                  {Domain::Everywhere, Convexity::Convex});
}

inline Eigen::Matrix2d from_parts(const Vector2& alpha, const Vector2& beta) {
  Eigen::Matrix2d j;
  j << alpha[0] + beta[0], beta[1] - alpha[1], alpha[1] + beta[1], alpha[0] - beta[0];
  return j;
}

inline double norm_alpha(const Eigen::Matrix2d& j) {
  return 0.5 * std::hypot(j(0, 0) + j(1, 1), j(1, 0) - j(0, 1));
}
inline double norm_beta(const Eigen::Matrix2d& j) {
  return 0.5 * std::hypot(j(0, 0) - j(1, 1), j(1, 0) + j(0, 1));
}
inline std::string describe(const Eigen::Matrix2d& j) {
  return "A = " + std::to_string(norm_alpha(j)) + ", B = " + std::to_string(norm_beta(j));
}
// Returns the factor by which det J = A^2 - B^2 amplifies rounding.
inline double cancellation(const Eigen::Matrix2d& j) {
  return j.squaredNorm() / std::abs(j.determinant());
}

// Returns Jacobians with positive determinants: random, similarities (beta = 0 exactly), nearly
// similar, nearly singular, very small and very large.
inline std::vector<Eigen::Matrix2d> injective_jacobians() {
  Random random(42);
  std::vector<Eigen::Matrix2d> out;
  const auto direction = [&] {
    const double t = random.uniform(0, 2 * std::numbers::pi);
    return Vector2(std::cos(t), std::sin(t));
  };
  for (int k = 0; k < 150; ++k) {
    const double scale = k < 90 ? random.uniform(0.3, 3) : std::pow(10, random.uniform(-6, 6));
    out.push_back(from_parts(scale * direction(), scale * random.uniform(0, 0.95) * direction()));
  }
  for (const double scale : {1e-6, 0.1, 1.0, 1.5, 1e6})
    for (int k = 0; k < 4; ++k) {
      const double angle = 0.5 * k;
      const Vector2 alpha(scale * std::cos(angle), scale * std::sin(angle));
      out.push_back(from_parts(alpha, Vector2(0, 0)));
    }
  for (const double ratio : {1e-16, 1e-12, 1e-9, 3e-8, 1e-7, 1e-6, 0.9e-5, 1.1e-5, 1e-4, 1e-3})
    for (const double scale : {0.4, 1.0, 2.0})
      out.push_back(from_parts(scale * direction(), scale * ratio * direction()));
  for (const double det : {1e-2, 1e-4, 1e-6})
    for (int k = 0; k < 4; ++k)  // A^2 - B^2 = det
      out.push_back(from_parts(direction(), std::sqrt(1 - det) * direction()));
  return out;
}

// Returns Jacobians with positive and negative determinants, some with A much smaller than B.
inline std::vector<Eigen::Matrix2d> all_jacobians() {
  std::vector<Eigen::Matrix2d> out = injective_jacobians();
  Random random(43);
  for (const double ratio : {0.5, 0.1, 1e-3, 1e-6, 1e-9})
    for (int k = 0; k < 4; ++k)
      out.push_back(from_parts(ratio * random.vector(2), random.vector(2)));
  return out;
}

inline double smallest_eigenvalue(const Eigen::MatrixXd& m) { return symmetric_eigen(m).values[0]; }

inline Matrix4 clamp_eigenvalues(const Matrix4& m) {
  const SymmetricEigen s = symmetric_eigen(m);
  return s.vectors * s.values.cwiseMax(0).asDiagonal() * s.vectors.transpose();
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
