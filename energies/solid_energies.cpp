#include "majorant/energies/solid_energies.h"

#include <cmath>
#include <utility>
#include <vector>

#include "majorant/energies/make_energy.h"
#include "majorant/energies/solid_invariants.h"
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

// Returns d^(-2/3) for positive d.
double shape_scale(double d) {
  const double root = std::cbrt(d);
  return 1 / (root * root);
}
SolidJet shape_scale(const SolidJet& d) {
  const double f = shape_scale(d.v), slope = -2.0 / 3 * f / d.v;
  return d.chain(f, slope, -5.0 / 3 * slope / d.v);
}

// Returns |J|^2 / det^(2/3), which is 3 for similarities.
template <class T>
T shape_of(const T& n, const T& d) {
  return n * shape_scale(d);
}
template <class T>
T size_of(const T& d) {
  return d + 1.0 / d;
}

std::vector<NamedEnergy> all_energies() {
  const Traits everywhere{Domain::Everywhere, Convexity::Unknown, Reweighting::Refused};
  return {
      named("|J|^2 + |J^-1|^2; isometry 6",
            solid_invariants(
                "symmetric-dirichlet",
                [](const auto& n, const auto& q, const auto& d) { return n + q / (d * d); },
                barrier(Barrier::Strong))),
      named("|J|^2 / det^(2/3), shapes; similarity 3",
            solid_invariants(
                "mips", [](const auto& n, const auto&, const auto& d) { return shape_of(n, d); },
                barrier(Barrier::Weak, FreeScale::Arbitrary))),
      named("det J + 1 / det J, volumes; equal volumes 2",
            solid_invariants(
                "authalic", [](const auto&, const auto&, const auto& d) { return size_of(d); },
                barrier(Barrier::Weak))),
      named("exp(5 ((mips / 3 + authalic / 2) / 2 - 1)); isometry 1",
            solid_invariants(
                "amips-exponential",
                [](const auto& n, const auto&, const auto& d) {
                  using std::exp;
                  return exp(5.0 * (shape_of(n, d) / 6.0 + size_of(d) / 4.0 - 1.0));
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
