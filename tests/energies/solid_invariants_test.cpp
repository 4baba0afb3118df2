// Densities of the invariants of volumes against the same formulas in the entries of J, and
// projected Hessians against clamped eigenvalues, on any number of threads.
#include "majorant/energies/solid_invariants.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/solid_energies.h"
#include "majorant/energies/untangling.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;

// A tetrahedron for each Jacobian with a fixed first corner: nine unknowns each.
struct HeldTetrahedra {
  explicit HeldTetrahedra(const std::vector<Eigen::Matrix3d>& jacobians)
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
  // Returns the Hessian of element e in the entries of J, column by column.
  Eigen::MatrixXd hessian(const EnergyFactory& energy, BlendedCurvature curvature, Index e) const {
    const Problem problem =
        ProblemBuilder(static_cast<Index>(x.size())).add(energy(space, rest), 1).build();
    Evaluator evaluator(problem);
    const Eigen::SparseMatrix<double> all = evaluator.hessian(problem.reduce(x), curvature);
    return Eigen::MatrixXd(all).block(12 * e + 3, 12 * e + 3, 9, 9);
  }
  std::shared_ptr<const BezierTetrahedronSpace> space;
  RestShapes rest;
  Vec x;
};

// Returns general Jacobians, some with equal singular values, reflections, and some of rank two,
// one and zero.
std::vector<Eigen::Matrix3d> solid_jacobians() {
  Random random(5);
  std::vector<Eigen::Matrix3d> out{Eigen::Matrix3d::Identity(),
                                   -Eigen::Matrix3d::Identity(),
                                   Eigen::Vector3d(2, 0.5, 0.5).asDiagonal().toDenseMatrix(),
                                   Eigen::Vector3d(1, 2, 1e-6).asDiagonal().toDenseMatrix(),
                                   Eigen::Vector3d(1, -2, 0).asDiagonal().toDenseMatrix(),
                                   Eigen::Vector3d(0, 3, 0).asDiagonal().toDenseMatrix(),
                                   Eigen::Matrix3d::Zero()};
  while (out.size() < 20) {
    Eigen::Matrix3d J;
    for (double& entry : J.reshaped()) entry = random.uniform(-1, 1);
    out.push_back(J);
  }
  return out;
}

std::vector<EnergyFactory> energies_everywhere() {
  const Traits everywhere{Domain::Everywhere, Convexity::Unknown, Reweighting::Refused};
  return {energy_factory(SolidUntanglingDensity(0.5)), energy_factory(SolidUntanglingDensity(0.01)),
          energy_factory(solid_invariants(
              "mixed",
              [](const auto& n, const auto& q, const auto& d) {
                return 0.3 * n * n - n * d + q * d + 0.5 * q - 2.0 * d * d;
              },
              everywhere))};
}

TEST(SolidInvariants, ExactHessiansAgreeWithEntries) {
  const HeldTetrahedra t(solid_jacobians());
  const Traits everywhere{Domain::Everywhere, Convexity::Unknown, Reweighting::Refused};
  const EnergyFactory by_entries = energy_factory(density<3, 3>(
      "entries",
      [](const auto& J) {
        const auto n = J.squaredNorm(), d = J.determinant();
        auto q = 0.0 * n;
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            const int i = (r + 1) % 3, k = (r + 2) % 3, j = (c + 1) % 3, l = (c + 2) % 3;
            const auto cofactor = J(i, j) * J(k, l) - J(i, l) * J(k, j);
            q += cofactor * cofactor;
          }
        return 0.3 * n * n - n * d + q * d + 0.5 * q - 2.0 * d * d;
      },
      everywhere));
  const EnergyFactory by_invariants = energies_everywhere().back();
  for (Index e = 0; e < t.space->element_count(); ++e) {
    const Eigen::MatrixXd h = t.hessian(by_entries, Curvature::Exact, e);
    const double difference = (t.hessian(by_invariants, Curvature::Exact, e) - h).norm();
    EXPECT_LE(difference, 1e-13 * (1 + h.norm())) << e;
  }
}

TEST(SolidInvariants, ProjectionRemovesOnlyNegativeEigenvalues) {
  const HeldTetrahedra t(solid_jacobians());
  for (const EnergyFactory& energy : energies_everywhere())
    for (Index e = 0; e < t.space->element_count(); ++e)
      for (const double weight : {0.4, 1.0, 2.0}) {
        const Eigen::MatrixXd exact = t.hessian(energy, Curvature::Exact, e);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(exact);
        const Eigen::VectorXd negative = of.eigenvalues().cwiseMin(0.0);
        const Eigen::MatrixXd clamped = exact - weight * of.eigenvectors() * negative.asDiagonal() *
                                                    of.eigenvectors().transpose();
        const Eigen::MatrixXd h = t.hessian(energy, BlendedCurvature::projected(weight), e);
        EXPECT_LE((h - clamped).norm(), 1e-12 * exact.norm()) << e << " " << weight;
      }
}

// A small number of batches of large elements is computed and added in parts, with the bits of one
// thread.
TEST(SolidInvariants, SameBitsOnAnyNumberOfThreads) {
  Random random(11);
  constexpr Index kCount = 6;  // cells on a side, 6 tetrahedra each
  const auto vertex = [](Index i, Index j, Index k) {
    return i + (kCount + 1) * (j + (kCount + 1) * k);
  };
  Cells cells(6 * kCount * kCount * kCount, 4);
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  Index e = 0;
  for (Index k = 0; k < kCount; ++k)
    for (Index j = 0; j < kCount; ++j)
      for (Index i = 0; i < kCount; ++i)
        for (int t = 0; t < 6; ++t, ++e) {
          Index at[3] = {i, j, k};
          cells(e, 0) = vertex(i, j, k);
          for (Index c = 1; c < 4; ++c) {
            ++at[kOrders[t][c - 1]];
            cells(e, c) = vertex(at[0], at[1], at[2]);
          }
          if (t >= 3) std::swap(cells(e, 1), cells(e, 2));
        }
  const Index vertices = (kCount + 1) * (kCount + 1) * (kCount + 1);
  RowMatrix positions(vertices, 3);
  for (Index k = 0; k <= kCount; ++k)
    for (Index j = 0; j <= kCount; ++j)
      for (Index i = 0; i <= kCount; ++i) positions.row(vertex(i, j, k)) << i, j, k;
  for (const int degree : {1, 2}) {
    const auto space = std::make_shared<const BezierTetrahedronSpace>(cells, vertices, degree);
    RowMatrix at = space->node_positions(positions);
    for (double& entry : at.reshaped()) entry += random.uniform(-0.1, 0.1);
    const Vec x = Eigen::Map<const Vec>(at.data(), at.size());
    const Problem problem = ProblemBuilder(static_cast<Index>(x.size()))
                                .add(energy_factory(SolidUntanglingDensity(0.1))(
                                         space, flat_simplices(positions, cells)),
                                     1)
                                .build();
    double energy = 0, value = 0;
    Vec gradient, hessian;
    for (const int threads : {1, 2, 3, 5}) {
      const ThreadCount count(threads);
      Evaluator evaluator(problem);
      Vec g, h;
      const double f = evaluator.linearize(problem.reduce(x), Curvature::Projected, g, h);
      const double v = evaluator.value(problem.reduce(x));
      if (threads == 1) energy = f, value = v, gradient = g, hessian = h;
      EXPECT_EQ(f, energy) << threads;
      EXPECT_EQ(g, gradient) << threads;
      EXPECT_EQ(h, hessian) << threads;
      EXPECT_EQ(v, value) << threads;
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
