// Makes the functions of few points that the kernels of the library call (point_functions.h) from a
// density. Only this is compiled in the file of a user's formula.
#pragma once

#include <algorithm>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include "majorant/energies/detail/isotropic.h"
#include "majorant/energies/detail/point_functions.h"

namespace majorant::detail {

// Calls call(p, data...) for each point. data: of its element, if the density has any.
template <class Density, class Call>
void for_points(const Density& density, const PointBatch& batch, const Call& call) {
  for (int p = 0; p < batch.count; ++p) {
    if constexpr (requires { density.element_count(); }) {
      call(p, density.data_of(batch.elements[std::min(p, batch.element_count - 1)]));
    } else {
      call(p);
    }
  }
}

template <class Density>
struct JacobianPoints {
  static constexpr int kSize = Density::size, kLanes = PointBatch::kMost;

  static void load(const double* J, int p, double (&z)[kSize]) {
    for (int r = 0; r < kSize; ++r) z[r] = J[r * kLanes + p];
  }
  static void store(const PointModel<double, kSize>& m, int p, double* f, double* g) {
    f[p] = m.f;
    for (int r = 0; r < kSize; ++r) g[r * kLanes + p] = m.g[r];
  }
  static void values(const void* formula, const PointBatch& batch, const double* J, double* f) {
    const auto& density = *static_cast<const Density*>(formula);
    for_points(density, batch, [&](int p, const auto&... data) {
      double z[kSize];
      load(J, p, z);
      f[p] = density.value(z, data...);
    });
  }
  static void slopes(const void* formula, const PointBatch& batch, const double* J, double* f,
                     double* g) {
    const auto& density = *static_cast<const Density*>(formula);
    for_points(density, batch, [&](int p, const auto&... data) {
      double z[kSize];
      PointModel<double, kSize> m;
      load(J, p, z);
      density.slope(z, m, data...);
      store(m, p, f, g);
    });
  }
  static void models(const void* formula, const PointBatch& batch, const double* J, double* f,
                     double* g, double* k) {
    const auto& density = *static_cast<const Density*>(formula);
    for_points(density, batch, [&](int p, const auto&... data) {
      double z[kSize];
      PointModel<double, kSize> m;
      load(J, p, z);
      density.model(z, m, data...);
      store(m, p, f, g);
      for (int r = 0; r < kSize * (kSize + 1) / 2; ++r) k[r * kLanes + p] = m.k[r];
    });
  }
};

template <class Density>
struct InvariantPoints {
  static void values(const void* formula, const PointBatch& batch, const double* x, const double* y,
                     double* f) {
    const auto& density = *static_cast<const Density*>(formula);
    for_points(density, batch,
               [&](int p, const auto&... data) { f[p] = density.value_at(x[p], y[p], data...); });
  }
  static void jets(const void* formula, const PointBatch& batch, const double* x, const double* y,
                   double* jets) {
    const auto& density = *static_cast<const Density*>(formula);
    for_points(density, batch, [&](int p, const auto&... data) {
      const IsotropicJet<double> j = density.jet_at(x[p], y[p], data...);
      const double numbers[] = {j.f, j.ga, j.gb, j.caa, j.cab, j.cbb};
      for (int r = 0; r < 6; ++r) jets[r * PointBatch::kMost + p] = numbers[r];
    });
  }
  static void majorants(const void* formula, const PointBatch& batch, const double* x,
                        const double* y, double* m) {
    const auto& density = *static_cast<const Density*>(formula);
    for (int p = 0; p < batch.count; ++p) m[p] = density.majorant()(x[p], y[p]);
  }
};

// The function U of a solid: volume_at(theta) is a Dual2<double, 1>.
template <class Density>
struct VolumePoints {
  static void jets(const void* solid, const PointBatch& batch, const double* theta, double* jets) {
    for (int p = 0; p < batch.count; ++p) {
      const auto jet = static_cast<const Density*>(solid)->volume_at(theta[p]);
      jets[p] = jet.v;
      jets[PointBatch::kMost + p] = jet.d[0];
      jets[2 * PointBatch::kMost + p] = jet.h[0];
    }
  }
};

// A solid whose dilatation is projected inside each element.
template <class Density>
concept ProjectsDilatation = requires(const Density& density) {
  density.dilatation_degree();
};

// A density of invariants instead of J itself.
template <class Density>
concept Isotropic = requires(const Density& density) {
  density.majorant();
};

template <class Density>
auto point_function(const Density& density) {
  if constexpr (Isotropic<Density>) {
    using Points = InvariantPoints<Density>;
    InvariantFunction function{&density, density.traits, &Points::values, &Points::jets, nullptr};
    if constexpr (requires { density.majorant()(1.0, 1.0); })
      function.majorants = &Points::majorants;
    return function;
  } else if constexpr (ProjectsDilatation<Density>) {
    return SolidFunction{point_function(density.shape()), &density, &VolumePoints<Density>::jets};
  } else {
    using Points = JacobianPoints<Density>;
    return JacobianFunction{&density, &Points::values, &Points::slopes, &Points::models};
  }
}

template <class Density>
DensityKernels point_kernels() {
  DensityKernels kernels;
  if constexpr (Isotropic<Density>)
    kernels = invariant_kernels();
  else if constexpr (ProjectsDilatation<Density>)
    kernels = solid_kernels(Density::dims);
  else
    kernels = jacobian_kernels(Density::rows, Density::dims);
  // Stars do not belong to elements.
  if constexpr (requires(const Density& density) { density.element_count(); })
    kernels.star = nullptr;
  return kernels;
}

// The singular values at which a formula is tested in both orders: generic ones, well inside the
// domain of energies of maps.
inline constexpr double kTriedS = 1.25, kTriedLess = 0.75;
// Relative differences of the two values above this are not rounding.
inline constexpr double kAsymmetry = 1e-9;

// Throws InvalidArgument if h(a, b) is not h(b, a). name: of the density.
void refuse_asymmetric(std::string_view name, double ab, double ba);

// Tests a formula for symmetry. T: double or a batch, of which the first number counts. Data of a
// formula are those of element 0.
template <class T, class Density>
void require_symmetric(const Density& density) {
  const auto compare = [&density](const auto&... data) {
    if constexpr (requires(T(&values)[2]) { density.in_both_orders(values, data...); }) {
      T values[2]{T(kTriedS), T(kTriedLess)};
      density.in_both_orders(values, data...);
      if constexpr (std::is_same_v<T, double>)
        refuse_asymmetric(density.name(), values[0], values[1]);
      else
        refuse_asymmetric(density.name(), values[0].get(0), values[1].get(0));
    }
  };
  if constexpr (requires { density.element_count(); }) {
    if (density.element_count() > 0) compare(density.data_of(0));
  } else {
    compare();
  }
}

// A density and the function that refers to it, neither of which moves.
template <class Density>
struct CalledByPoint {
  explicit CalledByPoint(Density d) : density(std::move(d)), function(point_function(density)) {}
  CalledByPoint(const CalledByPoint&) = delete;
  CalledByPoint& operator=(const CalledByPoint&) = delete;
  const Density density;
  const decltype(point_function(std::declval<const Density&>())) function;
};

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
