// PETSc's methods and their fallback on matrices of different kinds. Runs on any number of ranks:
// ranks_test.py starts this program on two.
#include "apps/mpi/petsc_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/mpi/strip_matrix.h"

namespace majorant {
namespace {

using test::StripMatrix;

constexpr std::array kPetscMethods{PetscMethod::Amg, PetscMethod::Gamg, PetscMethod::Icc,
                                   PetscMethod::Mumps};
constexpr Index kWidth = 24;

double even(Index, Index, bool) { return 1; }

double wavy(Index i, Index j) { return std::sin(1.7 * i + 0.3) + std::cos(2.9 * j) + 0.1; }

struct Solver {
  std::shared_ptr<FallbackRecord> record = std::make_shared<FallbackRecord>();
  std::shared_ptr<LinearSolver> solver;

  Solver(PetscMethod first, const StripMatrix& m) : solver(petsc_solver({first, 0}, record)()) {
    analyze_shared(*solver, m.pattern, *m.partition);
  }
  const FallbackRecord::Use& use(PetscMethod method) const {
    return record->methods[static_cast<std::size_t>(method)];
  }
};

std::string_view name(PetscMethod method) {
  return kPetscMethodNames[static_cast<std::size_t>(method)];
}

TEST(PetscSolver, EveryMethodSolves) {
  const StripMatrix m(kWidth, even, 0.01);
  for (const PetscMethod method : kPetscMethods) {
    SCOPED_TRACE(name(method));
    Solver s(method, m);
    ASSERT_EQ(s.solver->factorize(m.values, 0.5), FactorStatus::Ok);
    const Vec r = m.sampled(wavy);
    Vec p;
    const Solution solution = s.solver->solve(r, p, 1e-10);
    EXPECT_EQ(solution.status, SolveStatus::Solved);
    Vec shifted = m.times(p);
    for (Index i = 0; i < p.size(); ++i)
      if (m.partition->owns(i)) shifted[i] += 0.5 * p[i];
    EXPECT_LE(m.partition->norm(shifted - r), 2e-10 * m.partition->norm(r));
    EXPECT_EQ(solution.iterations == 0, method == PetscMethod::Mumps);
    EXPECT_EQ(s.use(method).falls, 0);
  }
}

// Every method reports a matrix that is not positive definite and returns no ascent direction, for
// right-hand sides along a negative eigenvector, and nearly orthogonal to it.
TEST(PetscSolver, EveryMethodSeesAnIndefiniteMatrix) {
  // The smoothest functions make the matrix indefinite, for the last mass only slightly.
  for (const double mass : {-0.5, -0.05, -1e-3}) {
    const StripMatrix m(kWidth, even, mass);
    for (const PetscMethod method : kPetscMethods)
      for (const auto& f : {+[](Index, Index) { return 1.0; }, +wavy}) {
        SCOPED_TRACE(testing::Message() << name(method) << ", mass " << mass);
        Solver s(method, m);
        const FactorStatus factors = s.solver->factorize(m.values, 0);
        if (method == PetscMethod::Mumps) {
          EXPECT_EQ(factors, FactorStatus::NotPositiveDefinite);
        }
        if (factors == FactorStatus::Ok) {
          Vec p;
          const Solution solution = s.solver->solve(m.sampled(f), p, 1e-8);
          EXPECT_EQ(solution.status, SolveStatus::Indefinite);
        }
        EXPECT_GT(s.record->indefinite, 0);
        // With a sufficient shift the same solver solves.
        EXPECT_EQ(s.solver->factorize(m.values, 1), FactorStatus::Ok);
        Vec p;
        EXPECT_EQ(s.solver->solve(m.sampled(f), p, 1e-8).status, SolveStatus::Solved);
      }
  }
}

// Negative curvature that two conjugate gradient solves report is a result; no factorization is
// needed.
TEST(PetscSolver, NegativeCurvatureIsAnAnswer) {
  const StripMatrix m(kWidth, even, -0.5);
  Solver s(PetscMethod::Amg, m);
  ASSERT_EQ(s.solver->factorize(m.values, 0), FactorStatus::Ok);
  Vec p;
  EXPECT_EQ(s.solver->solve(m.sampled(wavy), p, 1e-8).status, SolveStatus::Indefinite);
  EXPECT_EQ(s.use(PetscMethod::Amg).falls, 1);
  EXPECT_EQ(s.use(PetscMethod::Icc).solves, 1);
  EXPECT_EQ(s.record->indefinite, 1);
  // With the blocks of several ranks the factors may not detect it.
  if (test::ranks()->count() == 1) {
    EXPECT_EQ(s.use(PetscMethod::Mumps).set_ups, 0);
  }
}

// Multigrid must be set up for this matrix, not for the one before, whose stiff direction differs.
TEST(PetscSolver, MultigridIsMadeFromTheSolvedMatrix) {
  const auto rows = [](Index, Index, bool up) { return up ? 1e-2 : 1.0; };
  const auto columns = [](Index, Index, bool up) { return up ? 1.0 : 1e-2; };
  const StripMatrix a(kWidth, rows, 1e-4), b(kWidth, columns, 1e-4);
  for (const PetscMethod method : {PetscMethod::Gamg, PetscMethod::Amg}) {
    SCOPED_TRACE(name(method));
    const Vec r = b.sampled(wavy);
    Vec p;
    Solver fresh(method, b), used(method, a);
    ASSERT_EQ(fresh.solver->factorize(b.values, 0), FactorStatus::Ok);
    const int once = fresh.solver->solve(r, p, 1e-8).iterations;
    ASSERT_EQ(used.solver->factorize(a.values, 0), FactorStatus::Ok);
    used.solver->solve(r, p, 1e-8);
    ASSERT_EQ(used.solver->factorize(b.values, 0), FactorStatus::Ok);
    EXPECT_EQ(used.solver->solve(r, p, 1e-8).iterations, once);
    EXPECT_EQ(used.use(method).falls, 0);
  }
}

// The stiffness falls by a factor of 1e4 from node to node, as in a collapsed start. Multigrid may
// fail, but the solution is right.
TEST(PetscSolver, SomeMethodSolvesCollapsedElements) {
  const auto collapsed = [](Index i, Index j, bool up) {
    return std::pow(10.0, 16.0 * std::sin(0.9 * i) * std::cos(1.3 * j) + (up ? 3 : 0));
  };
  const StripMatrix m(kWidth, collapsed, 1e-8);
  const Vec exact = m.sampled(wavy);
  Vec copied = exact;
  m.partition->copy_from_owners(copied);
  const Vec r = m.times(copied);
  int solved = 0;
  for (const PetscMethod method : kPetscMethods) {
    SCOPED_TRACE(name(method));
    Solver s(method, m);
    Vec p;
    // The matrix is definite up to rounding; Newton's method would add a shift.
    if (s.solver->factorize(m.values, 0) != FactorStatus::Ok) continue;
    const Solution solution = s.solver->solve(r, p, 1e-6);
    if (solution.status == SolveStatus::Indefinite) continue;
    ++solved;
    EXPECT_EQ(solution.status, SolveStatus::Solved);
    EXPECT_GE(m.partition->dot(r, p), 0);
    EXPECT_LE(m.partition->norm(m.times(p) - r), 1e-5 * m.partition->norm(r));
  }
  EXPECT_GE(solved, 2);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
