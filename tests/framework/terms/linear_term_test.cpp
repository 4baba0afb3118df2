// Linear terms: loads.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "random.h"

namespace majorant {
namespace {

TEST(LinearTerm, Derivatives) {
  Vec c{{2, 0, -3, 0.5}};
  const auto term = linear_term("loads", c);
  EXPECT_EQ(term->element_dofs().element_count(), 3);
  const Vec x{{1, 9, 2, -4}};
  const DerivativeReport report = check_derivatives(*term, x);
  EXPECT_TRUE(report.ok()) << report.message();
  const Problem problem = ProblemBuilder(4).add(term, 3).build();
  Vec g;
  EXPECT_EQ(Evaluator(problem).gradient(x, g), 3 * c.dot(x));
  EXPECT_EQ(g, 3 * c);
}

// With a spring for each unknown, x = -c / k.
TEST(LinearTerm, Equilibrium) {
  const Index n = 200;
  test::Random random(1);
  const Vec c = random.vector(n), k = random.vector(n, 1, 10);
  Cells each(n, 1);
  for (Index i = 0; i < n; ++i) each(i, 0) = i;
  const auto springs = make_term<1>(
      "springs", each, [k](Index e, const auto& z) { return 0.5 * k[e] * z[0] * z[0]; });
  const Problem problem = ProblemBuilder(n).add(springs, 1).add(linear_term("c", c), 1).build();
  const SolveResult result = NewtonMinimizer().minimize(problem, random.vector(n), {});
  EXPECT_EQ(result.status, Status::Converged);
  EXPECT_LE((result.y + c.cwiseQuotient(k)).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(LinearTerm, NotFinite) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(linear_term("bad", Vec{{1, inf}}), Error);
  EXPECT_NO_THROW(linear_term("none", Vec::Zero(3)));
}

// A term that is shorter than the problem would leave the last unknowns without a load.
TEST(LinearTerm, AProblemOfAnotherSizeRefusesIt) {
  for (const Index size : {2, 4}) {
    try {
      ProblemBuilder(3).add(linear_term("load", Vec::Zero(size)), 1);
      ADD_FAILURE() << size;
    } catch (const InvalidArgument& e) {
      EXPECT_NE(std::string(e.what()).find("term 'load': it is of " + std::to_string(size) +
                                           " unknowns, the problem has 3"),
                std::string::npos)
          << e.what();
    }
  }
  EXPECT_NO_THROW(ProblemBuilder(3).add(linear_term("load", Vec::Zero(3)), 1));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
