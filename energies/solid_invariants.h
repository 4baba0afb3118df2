// Isotropic densities of volumes from a formula of three invariants of J: the sum n of the squares
// of its entries, the sum q of the squares of its cofactors, and its determinant d. By the singular
// values s:
//
//     n = sum s_i^2,   q = sum_{i<j} s_i^2 s_j^2,   d = s_1 s_2 s_3;   |J^-1|^2 = q / d^2.
//
//   auto mine = solid_invariants("mine", [](const auto& n, const auto& q, const auto& d) {
//     return n + q / (d * d);
//   });
//   builder.add(make_energy(space, rest, mine), 1.0 / rest.measure.sum());
//
// The formula is called point by point, with doubles and Dual2<double, 3>. Everything else is done
// for eight points at a time. Eigenvalues and eigenvectors of the Hessian are known except for one
// block of 3 by 3, so its projection takes a tenth of the time of density()'s. With k the third of
// i and j, and A = U^T dJ V, they are
//
//     (A_ij - A_ji)^2 / 2   times   2 f_n + 2 f_q (s_k^2 + s_i s_j) + f_d s_k,
//     (A_ij + A_ji)^2 / 2   times   2 f_n + 2 f_q (s_k^2 - s_i s_j) - f_d s_k,
//
// and, in A_11, A_22, A_33, the second derivatives by the singular values.
//
// Not for formulas with other functions of the singular values (stretches.h), nor for anisotropic
// ones (density(), make_energy.h), nor for data of elements.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/energies/detail/solid_invariant_function.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/dual2.h"

namespace majorant {

// f and its derivatives by n, q and d.
using SolidJet = Dual2<double, 3>;

template <class Formula>
class SolidInvariantDensity {
 public:
  static constexpr int rows = 3, dims = 3;
  static constexpr bool kSolidInvariants = true;
  const Traits traits;

  SolidInvariantDensity(std::string name, Formula formula, const Traits& t)
      : traits(t), formula_(std::move(formula)), name_(std::move(name)) {}
  std::string_view name() const { return name_; }
  bool supports(Curvature c) const { return c == Curvature::Projected || c == Curvature::Exact; }

  double value_at(double n, double q, double d) const {
    return inside_domain(formula_(n, q, d), d);
  }
  SolidJet jet_at(double n, double q, double d) const {
    SolidJet jet =
        formula_(SolidJet::variable(n, 0), SolidJet::variable(q, 1), SolidJet::variable(d, 2));
    jet.v = inside_domain(jet.v, d);
    return jet;
  }

 private:
  double inside_domain(double f, double d) const {
    const bool inside = f == f && (traits.domain == Domain::Everywhere || d > 0);
    return inside ? f : std::numeric_limits<double>::infinity();
  }
  Formula formula_;
  std::string name_;
};

// A density of the invariants of volumes.
template <class Density>
concept OfSolidInvariants = requires(const Density& density) {
  Density::kSolidInvariants;
  density.jet_at(1.0, 1.0, 1.0);
};

namespace detail {

template <class Density>
struct SolidInvariantPoints {
  static constexpr int kLanes = PointBatch::kMost;

  static void values(const void* formula, const PointBatch& batch, const double* invariants,
                     double* f) {
    for (int p = 0; p < batch.count; ++p)
      f[p] = static_cast<const Density*>(formula)->value_at(invariants[p], invariants[kLanes + p],
                                                            invariants[2 * kLanes + p]);
  }
  static void jets(const void* formula, const PointBatch& batch, const double* invariants,
                   double* jets) {
    for (int p = 0; p < batch.count; ++p) {
      const SolidJet jet = static_cast<const Density*>(formula)->jet_at(
          invariants[p], invariants[kLanes + p], invariants[2 * kLanes + p]);
      double* out = jets + p;
      *out = jet.v;
      for (const double entry : jet.d) *(out += kLanes) = entry;
      for (const double entry : jet.h) *(out += kLanes) = entry;
    }
  }
};

// A density and the function that refers to it, neither of which moves.
template <class Density>
struct CalledBySolidPoint {
  explicit CalledBySolidPoint(Density d)
      : density(std::move(d)),
        function{&density, &SolidInvariantPoints<Density>::values,
                 &SolidInvariantPoints<Density>::jets} {}
  CalledBySolidPoint(const CalledBySolidPoint&) = delete;
  CalledBySolidPoint& operator=(const CalledBySolidPoint&) = delete;
  const Density density;
  const SolidInvariantFunction function;
};

}  // namespace detail

// Returns the energy of a density of invariants; make_energy() uses it, too.
template <OfSolidInvariants Density>
EnergyFactory energy_factory(const Density& density) {
  using Object = detail::CalledBySolidPoint<Density>;
  return detail::make_factory(
      std::make_shared<const Object>(density), solid_invariant_kernels(),
      [](const std::shared_ptr<const Object>& object) {
        return std::shared_ptr<const void>(object, &object->function);
      },
      [](const Density& other) { return energy_factory(other); });
}

template <class Formula>
SolidInvariantDensity<Formula> solid_invariants(std::string name, Formula formula,
                                                const Traits& traits = {}) {
  return {std::move(name), std::move(formula), traits};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
