// Declared properties of energies: correct for the built-in ones, default or given for those of
// callers, derived from summands for sums.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "majorant/energies/untangling.h"

namespace majorant {
namespace {

struct Declared {
  const char* name;
  Barrier barrier;
  FreeScale free_scale;
};
constexpr Declared kDeclared[] = {
    {"symmetric-dirichlet", Barrier::Strong, FreeScale::Determined},
    {"asap", Barrier::None, FreeScale::Collapses},
    {"mips", Barrier::Weak, FreeScale::Arbitrary},
    {"arap", Barrier::None, FreeScale::Determined},
    {"symmetric-arap", Barrier::Weak, FreeScale::Determined},
    {"log-isometric", Barrier::Weak, FreeScale::Determined},
    {"authalic", Barrier::Weak, FreeScale::Determined},
    {"amips-exponential", Barrier::Weak, FreeScale::Determined},
};

EnergySum sum_of(const std::vector<const char*>& names) {
  EnergySum sum;
  for (const char* name : names) sum.push_back({find_energy(name)->make, 0.1});
  return sum;
}

// Returns densities at diag(Sigma, sigma).
std::vector<double> values_at(const EnergyFactory& make, const std::vector<Vector2>& stretches) {
  const test::Triangles t(stretches.size());
  std::vector<Eigen::Matrix2d> jacobians;
  for (const Vector2& s : stretches) jacobians.push_back(s.asDiagonal());
  std::vector<double> f = test::element_models(*make(t.space, t.rest, {lattice_rule(1)}),
                                               test::corners_of(jacobians), Curvature::Projected)
                              .values;
  for (double& v : f) v *= 2;  // area 1/2
  return f;
}

TEST(EnergyTraits, AreDeclaredForBuiltInEnergies) {
  ASSERT_EQ(named_energies().size(), std::size(kDeclared));
  for (const Declared& d : kDeclared) {
    SCOPED_TRACE(d.name);
    const EnergyFactory& make = find_energy(d.name)->make;
    EXPECT_EQ(make.traits().name, d.name);
    EXPECT_EQ(make.traits().barrier, d.barrier);
    EXPECT_EQ(make.traits().free_scale, d.free_scale);
    // The term has the traits of its factory.
    const test::Triangles t(1);
    const auto term = make(t.space, t.rest, {lattice_rule(1)});
    EXPECT_EQ(term->traits().name, d.name);
    EXPECT_EQ(term->traits().barrier, d.barrier);
    EXPECT_EQ(term->traits().free_scale, d.free_scale);
    EXPECT_EQ(term->traits().curvatures, make.traits().curvatures);
  }
  EXPECT_EQ(symmetric_dirichlet().traits().name, "symmetric-dirichlet");
  EXPECT_EQ(mips().traits().name, "mips");
}

TEST(EnergyTraits, BarriersAreTrue) {
  for (const NamedEnergy& e : named_energies()) {
    SCOPED_TRACE(e.name);
    const auto f = values_at(e.make, {{1, 0.5}, {1, 1e-1}, {1, 1e-2}, {1, 1e-4}});
    if (e.make.traits().barrier == Barrier::None) {
      for (const double v : f) EXPECT_LE(v, 1);
      continue;
    }
    for (std::size_t k = 1; k < f.size(); ++k) EXPECT_GT(f[k], 2 * f[k - 1]) << k;
    EXPECT_GE(f.back(), e.make.traits().barrier == Barrier::Strong ? 1e8 : 0);  // 1 / sigma^2
  }
}

TEST(EnergyTraits, FreeScalesAreTrue) {
  for (const NamedEnergy& e : named_energies()) {
    SCOPED_TRACE(e.name);
    const Vector2 s(1.2, 0.9);
    const auto f = values_at(e.make, {s, 0.1 * s, 10 * s});
    switch (e.make.traits().free_scale) {
      case FreeScale::Determined:
        EXPECT_GT(f[1], f[0]);
        EXPECT_GT(f[2], f[0]);
        break;
      case FreeScale::Arbitrary:
        for (const double v : f) EXPECT_NEAR(v, f[0], 1e-14 * f[0]);
        break;
      case FreeScale::Collapses:
        EXPECT_NEAR(f[1], 0.01 * f[0], 1e-14 * f[0]);
        break;
    }
  }
}

TEST(EnergyTraits, AreDerivedForSums) {
  EXPECT_EQ(barrier_of({}), Barrier::None);
  EXPECT_EQ(barrier_of(sum_of({"asap", "arap"})), Barrier::None);
  EXPECT_EQ(barrier_of(sum_of({"asap", "mips", "arap"})), Barrier::Weak);
  EXPECT_EQ(barrier_of(sum_of({"mips", "symmetric-dirichlet", "asap"})), Barrier::Strong);

  EXPECT_EQ(free_scale_of({}), FreeScale::Arbitrary);
  EXPECT_EQ(free_scale_of(sum_of({"mips", "mips"})), FreeScale::Arbitrary);
  EXPECT_EQ(free_scale_of(sum_of({"asap"})), FreeScale::Collapses);
  EXPECT_EQ(free_scale_of(sum_of({"mips", "asap"})), FreeScale::Collapses);
  EXPECT_EQ(free_scale_of(sum_of({"asap", "mips", "arap"})), FreeScale::Determined);
}

template <class Density>
void expect_traits(const Density& density, Barrier barrier, FreeScale free_scale) {
  const DensityTraits traits = energy_factory(density).traits();
  EXPECT_EQ(traits.name, density.name());
  EXPECT_EQ(traits.barrier, barrier) << traits.name;
  EXPECT_EQ(traits.free_scale, free_scale) << traits.name;
}

TEST(EnergyTraits, HaveDefaultsForUserDensities) {
  using enum FreeScale;
  const auto h = [](auto S, auto s) { return S / s + s / S; };
  const auto k = [](const auto& x, const auto& y) { return 2.0 * (x + y); };
  const auto of_jacobian = [](const auto& J) { return J.squaredNorm(); };
  // Undeclared.
  expect_traits(spectral("spectral", h), Barrier::Weak, Determined);
  expect_traits(invariant("invariant", k, {Domain::Everywhere}), Barrier::None, Determined);
  expect_traits(density<2, 2>("general", of_jacobian), Barrier::Weak, Determined);
  expect_traits(density<2, 2>("general, everywhere", of_jacobian, {Domain::Everywhere}),
                Barrier::None, Determined);
  expect_traits(UntanglingDensity(0.1), Barrier::None, Determined);
  // Declared.
  expect_traits(spectral("steep", h, {.barrier = Barrier::Strong, .free_scale = Arbitrary}),
                Barrier::Strong, Arbitrary);
  expect_traits(density<2, 2>("shrinking", of_jacobian,
                              {.domain = Domain::Everywhere, .free_scale = Collapses}),
                Barrier::None, Collapses);
  // The name has no effect.
  expect_traits(spectral("symmetric-dirichlet", h), Barrier::Weak, Determined);
  expect_traits(spectral("asap", h), Barrier::Weak, Determined);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
