// Energies of volumes: derivatives, values at isometries, and formulas in singular values against
// those in the entries of J.
#include "majorant/energies/solid_energies.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/stretches.h"
#include "majorant/energies/untangling.h"
#include "majorant/framework/problem.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;

// One tetrahedron for each Jacobian, on the unit rest shape, with its first corner at the origin.
struct FreeTetrahedra {
  explicit FreeTetrahedra(const std::vector<Eigen::Matrix3d>& jacobians)
      : x(Vec::Zero(12 * static_cast<Index>(jacobians.size()))) {
    const auto count = static_cast<Index>(jacobians.size());
    Cells cells(count, 4);
    RowMatrix positions = RowMatrix::Zero(4 * count, 3);
    for (Index e = 0; e < count; ++e)
      for (Index k = 0; k < 4; ++k) {
        cells(e, k) = 4 * e + k;
        if (k == 0) continue;
        positions(4 * e + k, k - 1) = 1;
        x.segment<3>(3 * (4 * e + k)) = jacobians[to_size(e)].col(k - 1);
      }
    space = std::make_shared<const BezierTetrahedronSpace>(cells, 4 * count, 1);
    rest = flat_simplices(positions, cells);
  }
  std::shared_ptr<const BezierTetrahedronSpace> space;
  RestShapes rest;
  Vec x;
};

std::vector<Eigen::Matrix3d> jacobians(bool positive_only) {
  Random random(3);
  std::vector<Eigen::Matrix3d> out{Eigen::Vector3d(1, 2, 3).asDiagonal().toDenseMatrix(),
                                   Eigen::Vector3d(2, 0.5, 0.5).asDiagonal().toDenseMatrix()};
  while (out.size() < 40) {
    Eigen::Matrix3d J;
    for (double& entry : J.reshaped()) entry = random.uniform(-1, 1);
    if (std::abs(J.determinant()) < 0.05 || (positive_only && J.determinant() < 0)) continue;
    out.push_back(J);
  }
  return out;
}

Vec values(const EnergyTerm& term, const Vec& x) {
  ProblemBuilder builder(static_cast<Index>(x.size()));
  const TermId id = builder.add(std::shared_ptr<const EnergyTerm>(&term, [](auto*) {}), 1);
  return element_values(builder.build(), id, x);
}

TEST(SolidEnergies, Derivatives) {
  const FreeTetrahedra t(jacobians(true));
  for (const NamedEnergy& energy : solid_energies()) {
    const DerivativeReport report = check_derivatives(*energy.make(t.space, t.rest), t.x);
    EXPECT_TRUE(report.ok()) << energy.name << "\n" << report.message();
  }
}

TEST(SolidEnergies, ValuesAtIsometriesAndOutside) {
  const std::map<std::string, double> least{
      {"symmetric-dirichlet", 6}, {"mips", 3}, {"authalic", 2},
      {"amips-exponential", 1},   {"arap", 0}, {"symmetric-arap", 0},
      {"log-isometric", 0}};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Eigen::Matrix3d mirrored = turn;
  mirrored.col(0) *= -1;
  const FreeTetrahedra t({turn, 2 * turn, mirrored});
  EXPECT_EQ(solid_energies().size(), least.size());
  for (const NamedEnergy& energy : solid_energies()) {
    const Vec f = 6 * values(*energy.make(t.space, t.rest), t.x);
    EXPECT_NEAR(f[0], least.at(energy.name), 1e-12) << energy.name;
    if (energy.name == "mips")
      EXPECT_NEAR(f[1], 3, 1e-12);
    else
      EXPECT_GT(f[1], f[0] + 0.1) << energy.name;
    EXPECT_EQ(std::isinf(f[2]), energy.name != "arap") << energy.name;
  }
}

// Singular values of either sign that cancel, and zeros.
TEST(SolidEnergies, ArapHasFiniteModelsEverywhere) {
  const FreeTetrahedra t(
      {Eigen::Vector3d(1, 1, -1).asDiagonal().toDenseMatrix(), Eigen::Matrix3d::Zero()});
  const auto arap = std::find_if(solid_energies().begin(), solid_energies().end(),
                                 [](const NamedEnergy& e) { return e.name == "arap"; });
  const auto problem =
      ProblemBuilder(static_cast<Index>(t.x.size())).add(arap->make(t.space, t.rest), 1).build();
  for (const Curvature curvature : {Curvature::Projected, Curvature::Exact}) {
    Vec g, h;
    Evaluator(problem).linearize(problem.reduce(t.x), curvature, g, h);
    EXPECT_TRUE(g.allFinite() && h.allFinite()) << curvature_name(curvature);
  }
}

TEST(SolidEnergies, SingularValuesAgreeWithEntries) {
  const FreeTetrahedra t(jacobians(true));
  const auto by_entries = make_energy(t.space, t.rest, density<3, 3>("a", [](const auto& J) {
                                        return J.squaredNorm() + J.inverse().squaredNorm();
                                      }));
  const auto by_values = make_energy(
      t.space, t.rest, stretches<3>("b", [](const auto& s) { return s * s + 1.0 / (s * s); }));
  const auto model = [&](const EnergyTerm& term) {
    Problem problem = ProblemBuilder(static_cast<Index>(t.x.size()))
                          .add(std::shared_ptr<const EnergyTerm>(&term, [](auto*) {}), 1)
                          .build();
    Vec g, h;
    const double f = Evaluator(problem).linearize(problem.reduce(t.x), Curvature::Exact, g, h);
    return std::tuple(f, g, h);
  };
  const auto [f, g, h] = model(*by_entries);
  const auto [p, q, r] = model(*by_values);
  EXPECT_NEAR(f, p, 1e-12 * f);
  EXPECT_LE((g - q).norm(), 1e-10 * g.norm());
  EXPECT_LE((h - r).norm(), 1e-9 * h.norm());
}

TEST(SolidEnergies, UntanglingIsFiniteForInvertedElements) {
  const FreeTetrahedra t(jacobians(false));
  for (const double eps : {1.0, 0.1, 1e-3}) {
    const auto term = make_energy(t.space, t.rest, SolidUntanglingDensity(eps));
    const DerivativeReport report = check_derivatives(*term, t.x);
    EXPECT_TRUE(report.ok()) << eps << "\n" << report.message();
  }
  // (|J|^2 chi^(-2/3) + (D^2 + 1) / chi), chi(eps, 1) at an isometry.
  const FreeTetrahedra one({Eigen::Matrix3d::Identity()});
  const auto term = make_energy(one.space, one.rest, SolidUntanglingDensity(0.75));
  const double chi = (1 + 1.25) / 2;
  EXPECT_NEAR(6 * values(*term, one.x)[0], 3 / std::cbrt(chi * chi) + 2 / chi, 1e-13);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
