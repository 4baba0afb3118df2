// Factors in the memory of earlier ones.
#include "majorant/framework/kept_factor_memory.h"

#include <gtest/gtest.h>

#include <utility>

#include "framework/random_matrix.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {
namespace {

using test::Matrix;
using test::Random;
using test::random_matrix;

Vec solved(const Matrix& m, const Vec& r) {
  const auto solver = make_direct_solver();
  solver->analyze(m.pattern);
  EXPECT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok);
  Vec p;
  solver->solve(r, p);
  return p;
}

TEST(KeptFactorMemory, IsHandedOnWithinABlockAndChangesNoNumber) {
  Random random(5);
  const Matrix large = random_matrix(random, 150, 2, 60), small = random_matrix(random, 20, 2, 60);
  const Vec r = random.vector(large.pattern.size);
  const Vec first = solved(large, r), second = solved(small, r.head(small.pattern.size));
  EXPECT_EQ(KeptFactorMemory::take().factor.size, 0u);
  {
    const KeptFactorMemory kept;
    EXPECT_EQ(solved(large, r), first);
    {
      const KeptFactorMemory inner;  // the same
      EXPECT_EQ(solved(small, r.head(small.pattern.size)), second);
    }
    EXPECT_EQ(solved(large, r), first);
    FactorMemory memory = KeptFactorMemory::take();
    EXPECT_GT(memory.factor.size, 300u * 300u / 8);
    const double* const values = memory.factor.values.get();
    EXPECT_EQ(KeptFactorMemory::take().factor.size, 0u);
    KeptFactorMemory::give(std::move(memory));
    EXPECT_EQ(solved(small, r.head(small.pattern.size)), second);
    EXPECT_EQ(KeptFactorMemory::take().factor.values.get(), values);
  }
  EXPECT_EQ(KeptFactorMemory::take().factor.size, 0u);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
