#include "majorant/energies/solid_energies.h"

#include <cmath>
#include <utility>
#include <vector>

#include "majorant/energies/make_energy.h"
#include "majorant/energies/stretches.h"

namespace majorant {
namespace {

template <class Density>
NamedEnergy named(const char* summary, Density density) {
  std::string name(density.name());
  return {std::move(name), summary, energy_factory(density)};
}

Traits barrier(Barrier strength, FreeScale scale = FreeScale::Determined) {
  Traits traits;
  traits.barrier = strength;
  traits.free_scale = scale;
  return traits;
}

// Returns |J|^2 / det^(2/3), which is 3 for similarities.
template <class Matrix>
auto shape_of(const Matrix& J) {
  using std::pow;
  return J.squaredNorm() * pow(J.determinant(), -2.0 / 3);
}
template <class Matrix>
auto size_of(const Matrix& J) {
  const auto det = J.determinant();
  return det + 1.0 / det;
}

std::vector<NamedEnergy> all_energies() {
  const Traits everywhere{Domain::Everywhere, Convexity::Unknown, Reweighting::Refused};
  return {
      named("|J|^2 + |J^-1|^2; isometry 6",
            density<3, 3>(
                "symmetric-dirichlet",
                [](const auto& J) { return J.squaredNorm() + J.inverse().squaredNorm(); },
                barrier(Barrier::Strong))),
      named("|J|^2 / det^(2/3), shapes; similarity 3",
            density<3, 3>(
                "mips", [](const auto& J) { return shape_of(J); },
                barrier(Barrier::Weak, FreeScale::Arbitrary))),
      named("det J + 1 / det J, volumes; equal volumes 2",
            density<3, 3>(
                "authalic", [](const auto& J) { return size_of(J); }, barrier(Barrier::Weak))),
      named("exp(5 ((mips / 3 + authalic / 2) / 2 - 1)); isometry 1",
            density<3, 3>(
                "amips-exponential",
                [](const auto& J) {
                  using std::exp;
                  return exp(5.0 * (shape_of(J) / 6.0 + size_of(J) / 4.0 - 1.0));
                },
                barrier(Barrier::Weak))),
      named("|J - R|^2; isometry 0",
            stretches<3>(
                "arap", [](const auto& s) { return (s - 1.0) * (s - 1.0); }, everywhere)),
      named("|J - R|^2 + |J^-1 - R^-1|^2; isometry 0",
            stretches<3>(
                "symmetric-arap",
                [](const auto& s) {
                  const auto inverse = 1.0 / s;
                  return (s - 1.0) * (s - 1.0) + (inverse - 1.0) * (inverse - 1.0);
                },
                barrier(Barrier::Weak))),
      named("sum of log^2 of the singular values; isometry 0", stretches<3>(
                                                                   "log-isometric",
                                                                   [](const auto& s) {
                                                                     using std::log;
                                                                     return log(s) * log(s);
                                                                   },
                                                                   barrier(Barrier::Weak))),
  };
}

}  // namespace

std::span<const NamedEnergy> solid_energies() {
  static const std::vector<NamedEnergy> all = all_energies();
  return all;
}

const NamedEnergy* find_solid_energy(std::string_view name) {
  for (const NamedEnergy& e : solid_energies())
    if (e.name == name) return &e;
  return nullptr;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
