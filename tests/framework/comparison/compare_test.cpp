// compare(): rows of all methods on problems of every kind, and its four notes, each provoked once
// and absent otherwise.
#include "majorant/framework/comparison/compare.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "expected_error.h"
#include "framework/scalar_terms.h"
#include "majorant/framework/comparison/ceres_methods.h"
#include "majorant/framework/comparison/cholmod_methods.h"
#include "majorant/framework/comparison/comparison_table.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant {
namespace {

std::vector<ComparisonMethod> all_methods() {
  std::vector<ComparisonMethod> others = ceres_methods();
  for (ComparisonMethod& method : cholmod_methods()) others.push_back(std::move(method));
  return comparison_methods(std::move(others));
}

const MethodRun& run_of(const Comparison& all, const std::string& method) {
  for (const MethodRun& run : all.runs)
    if (run.method == method) return run;
  throw std::runtime_error("no run of " + method);
}

std::vector<std::string> all_notes(const Comparison& all) {
  std::vector<std::string> notes = all.notes;
  for (const MethodRun& run : all.runs)
    for (const std::string& note : run.notes) notes.push_back(run.method + ": " + note);
  return notes;
}

// Returns the number of notes with these words; fails if there are other notes.
std::size_t notes_with(const Comparison& all, const std::string& words) {
  std::size_t count = 0;
  for (const std::string& note : all_notes(all)) count += note.find(words) != std::string::npos;
  return count;
}

Cells chain_pairs(Index count) {
  Cells pairs(count, 2);
  for (Index k = 0; k < count; ++k) pairs.row(k) << k, k + 1;
  return pairs;
}

// Springs in the plane that repel at short distance, under gravity, with fixed ends.
constexpr Index kNodes = 8;
ProblemBuilder springs() {
  ProblemBuilder builder(2 * kNodes);
  builder.add(make_term<2, 2>("springs", chain_pairs(kNodes - 1),
                              [](Index, const auto& z) {
                                const auto d = (z.col(1) - z.col(0)).squaredNorm();
                                return d + 0.01 / d + 0.1 * (z(1, 0) + z(1, 1));
                              }),
              1.0);
  builder.add(FixedPoints({{0, {0, 0}}, {kNodes - 1, {3, 0}}}));
  return builder;
}

Vec line() {
  Vec x = Vec::Zero(2 * kNodes);
  for (Index k = 0; k < kNodes; ++k) x[2 * k] = 3.0 * k / (kNodes - 1);
  x[5] = 0.3;
  return x;
}

// A minimizer with results that a test prescribes.
class Planted final : public Minimizer {
 public:
  explicit Planted(std::function<SolveResult(const Problem&, Vec)> run) : run_(std::move(run)) {}
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver*) const override {
    return run_(problem, std::move(y0));
  }

 private:
  std::function<SolveResult(const Problem&, Vec)> run_;
};

ComparisonMethod planted(std::function<SolveResult(const Problem&, Vec)> run) {
  return free_method("planted", "a test's", [run = std::move(run)](auto&, auto&) {
    return std::make_unique<Planted>(run);
  });
}

TEST(Compare, RowsOfAllMethods) {
  const Problem problem = springs().build();
  const Comparison all = compare(problem, problem.reduce(line()), all_methods());
  ASSERT_EQ(all.runs.size(), all_methods().size());
  const double best = all.best_energy();
  int applied = 0;
  for (const MethodRun& run : all.runs) {
    SCOPED_TRACE(run.method + ": " + run.message);
    if (run.status == kNotApplicable) {
      EXPECT_TRUE(run.points.empty());
      EXPECT_FALSE(run.message.empty());
      continue;
    }
    ++applied;
    EXPECT_EQ(run.status, "converged");
    EXPECT_NEAR(run.points.back().energy, best, 1e-6 * std::abs(best));
    EXPECT_LT(run.points.back().gradient_norm, 1e-3);
    EXPECT_LT(run.distance, 1e-2);
    EXPECT_EQ(run.definite, Definite::Yes);
    EXPECT_EQ(run.x.size(), problem.full_size());
    EXPECT_EQ(run.x[2 * kNodes - 2], 3);  // constraints hold
  }
  EXPECT_EQ(applied, 10);
  EXPECT_EQ(all_notes(all), std::vector<std::string>());
  for (const char* name : {"newton-majorizer", "levenberg-marquardt", "ceres-lm", "newton-mumps"})
    EXPECT_EQ(run_of(all, name).status, kNotApplicable) << name;
  EXPECT_NE(run_of(all, "ceres-lm").message.find("'springs' is no sum of squares"),
            std::string::npos);
  EXPECT_NE(run_of(all, "newton-mumps").message.find("PETSc"), std::string::npos);
}

TEST(Compare, CountsAreThoseOfASeparateRun) {
  const Problem problem = springs().build();
  const Vec y0 = problem.reduce(line());
  const SolveResult alone = NewtonMinimizer().minimize(problem, y0, nullptr);
  int factorizations = 0;
  for (const IterationRecord& record : alone.iterations) factorizations += record.factorizations;
  const Comparison all = compare(problem, y0, all_methods());
  for (const char* name : {"newton", "newton-eigen", "newton-cholmod"}) {
    const MethodRun& run = run_of(all, name);
    EXPECT_EQ(run.iterations(), static_cast<int>(alone.iterations.size())) << name;
    // The last step meets the decrement rule and is not taken, but its factorization counts.
    EXPECT_GE(run.factorizations, factorizations) << name;
    EXPECT_LE(run.factorizations, factorizations + 2) << name;
    EXPECT_GT(run.seconds.factorize, 0);
    EXPECT_GT(run.seconds.solve, 0);
    EXPECT_GT(run.seconds.assemble, 0);
    EXPECT_GT(run.seconds.line_search, 0);
    EXPECT_LE(run.seconds.sum(), run.points.back().seconds);
  }
  EXPECT_EQ(run_of(all, "ceres-lbfgs").factorizations, 0);
  EXPECT_TRUE(std::isnan(run_of(all, "ceres-lbfgs").seconds.sum()));
  EXPECT_EQ(run_of(all, "lbfgs").factorizations, 1);
  EXPECT_EQ(run_of(all, "gradient-flow").factorizations, 1);
}

TEST(Compare, LeastSquares) {
  Cells all_unknowns = Cells::Zero(1, 2);
  all_unknowns << 0, 1;
  ProblemBuilder builder(2);
  builder.add(make_least_squares<2>("Rosenbrock", all_unknowns,
                                    [](Index, const auto& z) {
                                      using T = std::decay_t<decltype(z[0] * 1.0)>;
                                      return Eigen::Vector<T, 2>(10.0 * (z[1] - z[0] * z[0]),
                                                                 1.0 - z[0]);
                                    }),
              1.0);
  const Problem problem = builder.build();
  const Comparison all = compare(problem, Eigen::Vector2d(-1.2, 1), all_methods());
  for (const char* name : {"newton", "levenberg-marquardt", "lbfgs", "ceres-lm", "ceres-dogleg"}) {
    EXPECT_EQ(run_of(all, name).status, "converged") << name;
    EXPECT_NEAR(run_of(all, name).x[0], 1, 1e-4) << name;
  }
  // Gradient flow is still in the valley at its last step.
  EXPECT_EQ(run_of(all, "gradient-flow").status, "max_iterations");
  EXPECT_EQ(all_notes(all).size(), 1u);
  EXPECT_EQ(notes_with(all, "gradient-flow: stopped with a gradient of"), 1u);
}

TEST(Compare, Bounds) {
  ProblemBuilder builder = springs();
  const Bounds above(Vec::Constant(2 * kNodes, -0.02),
                     Vec::Constant(2 * kNodes, std::numeric_limits<double>::infinity()));
  const auto bound = above.checker();
  const TermId barrier = builder.add(bound->barrier(), 1.0);
  builder.add(bound);
  const Problem problem = builder.build();
  const Comparison all =
      compare(problem, problem.reduce(line()), all_methods(), {.bounds = {{barrier, bound}}});
  for (const char* name : {"newton", "newton-absolute", "newton-exact", "newton-cholmod"}) {
    const MethodRun& run = run_of(all, name);
    EXPECT_EQ(run.status, "converged") << name << run.message;
    EXPECT_GE(run.x.minCoeff(), -0.02);
    EXPECT_LT(run.x.minCoeff(), -0.0199);
    EXPECT_NEAR(run.points.back().energy, all.best_energy(), 1e-6);
    EXPECT_LT(run.points.back().gradient_norm, 1e-2);  // gradient of energy and barrier
  }
  for (const char* name : {"lbfgs", "gradient-flow", "ceres-lbfgs"})
    EXPECT_NE(run_of(all, name).message.find("bounds"), std::string::npos) << name;
  EXPECT_EQ(all_notes(all), std::vector<std::string>());
}

TEST(Compare, Equalities) {
  ProblemBuilder builder = springs();
  Cells middle(1, 1);
  middle << 3;
  builder.add(equality<1, 2>("circle", middle,
                             [](Index, const auto& z) { return z.col(0).squaredNorm() - 1.0; }),
              1.0);
  const Problem problem = builder.build();
  const Comparison all = compare(problem, problem.reduce(line()), all_methods());
  const MethodRun& newton = run_of(all, "newton");
  EXPECT_EQ(newton.status, "converged") << newton.message;
  EXPECT_NEAR(newton.x.segment(6, 2).norm(), 1, 1e-8);
  // Points that violate the equality do not count, even if their energy is lower.
  EXPECT_NEAR(newton.points.back().energy, all.best_energy(), 1e-6 * std::abs(all.best_energy()));
  EXPECT_EQ(run_of(all, "lbfgs").status, kNotApplicable);
  EXPECT_EQ(all_notes(all), std::vector<std::string>());
}

TEST(Compare, Manifolds) {
  ManifoldProblemBuilder builder(3 * 4);
  Cells unknowns(4, 3);
  for (Index k = 0; k < 12; ++k) unknowns(k / 3, k % 3) = k;
  builder.on(unit_sphere(3), unknowns);
  Cells pairs(6, 2);
  pairs << 0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3;
  builder.add(make_term<2, 3>(
                  "repulsion", pairs,
                  [](Index, const auto& z) { return 1.0 / (z.col(1) - z.col(0)).squaredNorm(); }),
              1.0);
  Vec x0(12);
  x0 << 1, 0.1, 0, 0, 1, 0.2, 0.3, 0, 1, -1, 0.1, -0.2;
  const Comparison all = compare(builder.build(), x0, all_methods(), {.compares_points = false});
  // The minimum is a regular tetrahedron: all six squared distances are 8 / 3.
  EXPECT_EQ(run_of(all, "newton").status, "converged");
  EXPECT_NEAR(run_of(all, "newton").points.back().energy, 6 * 3.0 / 8, 1e-6);
  EXPECT_NEAR(run_of(all, "newton").x.head(3).norm(), 1, 1e-14);
  EXPECT_NE(run_of(all, "lbfgs").message.find("manifolds"), std::string::npos);
  EXPECT_EQ(notes_with(all, "gradient"), 0u);
}

TEST(Compare, CheckersHold) {
  ProblemBuilder builder(3);
  builder.add(std::make_shared<test::Chain>(3, test::parabola(2, 1)), 1.0);
  builder.add(std::make_shared<test::Box>(1.5, true));
  const Problem problem = builder.build();
  const Comparison all = compare(problem, Vec::Zero(3), all_methods(), {.time_limit_seconds = 5});
  for (const MethodRun& run : all.runs)
    if (run.status != kNotApplicable) {
      EXPECT_LE(run.x.maxCoeff(), 1.5) << run.method;
    }
}

TEST(Compare, UnknownNamesAreErrorsThatListTheNames) {
  try {
    named_methods({"newton", "newtn"}, all_methods());
    FAIL();
  } catch (const InvalidArgument& e) {
    expect_contains(e.what(), {"'newtn'", "newton-absolute", "lbfgs", "ceres-lm"});
  }
  const auto chosen = named_methods({"lbfgs", "newton", "lbfgs"}, all_methods());
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].name, "lbfgs");
}

// Returns a term with a slow evaluation.
test::Scalar slow_quartic() {
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); };
  return {[=](double t) { return wait(), t * t * t * t + t; },
          [=](double t) { return wait(), 4 * t * t * t + 1; }, [](double t) { return 12 * t * t; }};
}

TEST(Compare, TimeLimitOfEachMethod) {
  ProblemBuilder builder(1);
  builder.add(std::make_shared<test::Chain>(1, slow_quartic()), 1.0);
  const Comparison all =
      compare(builder.build(), Vec::Constant(1, 1e6), all_methods(), {.time_limit_seconds = 0.1});
  for (const MethodRun& run : all.runs) {
    if (run.status == kNotApplicable) continue;
    EXPECT_EQ(run.status, "time_limit") << run.method;
    EXPECT_LT(run.points.back().seconds, 0.5) << run.method;  // at most one evaluation longer
  }
}

// --------------------------------------------------------------------- notes

// A spring energy whose gradient has this factor; 1: it is right.
class WrongGradient final : public EnergyTerm {
 public:
  explicit WrongGradient(double factor) : chain_(3, test::double_well()), factor_(factor) {}
  std::string_view name() const override { return "wrong"; }
  const ElementDofs& element_dofs() const override { return chain_.element_dofs(); }
  bool supports(Curvature c) const override { return chain_.supports(c); }
  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace& w,
              std::span<double> f) const override {
    chain_.values(x, batch, state, w, f);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& w, LocalSystem& out) const override {
    chain_.local(x, batch, curvature, state, w, out);
    for (std::size_t p = 0; p < batch.elements.size(); ++p) out.gradient[p] *= factor_;
  }

 private:
  test::Chain chain_;
  double factor_;
};

TEST(CompareNotes, AGradientThatDisagreesWithDifferences) {
  const auto notes_of = [](double factor) {
    ProblemBuilder builder(3);
    builder.add(std::make_shared<WrongGradient>(factor), 1.0);
    return compare(builder.build(), Vec::Constant(3, 1.5),
                   named_methods({"newton", "lbfgs"}, all_methods()))
        .notes;
  };
  ASSERT_EQ(notes_of(1.3).size(), 1u);
  expect_contains(notes_of(1.3)[0], {"gradient of term 'wrong'", "at the start", "element 0"});
  EXPECT_EQ(notes_of(1), std::vector<std::string>());
}

TEST(CompareNotes, AnIndefiniteHessianAtTheEnd) {
  const auto notes_of = [](double second) {
    Cells cells(1, 2);
    cells << 0, 1;
    ProblemBuilder builder(2);
    builder.add(make_term<2>("saddle", cells,
                             [](Index, const auto& z) {
                               const auto w = z[1] * z[1];
                               return z[0] * z[0] - w + w * w;
                             }),
                1.0);
    return compare(builder.build(), Eigen::Vector2d(1, second),
                   named_methods({"newton", "lbfgs", "gradient-flow"}, all_methods()));
  };
  const Comparison saddle = notes_of(0);
  EXPECT_EQ(notes_with(saddle, "indefinite"), 3u);
  EXPECT_EQ(run_of(saddle, "lbfgs").definite, Definite::No);
  EXPECT_EQ(all_notes(notes_of(0.5)), std::vector<std::string>());
}

// A free rotation has negative curvature as long as the gradient is not 0.
TEST(CompareNotes, RotationsAreNoSaddles) {
  Cells node(1, 1);
  node << 0;
  ProblemBuilder builder(2);
  builder.add(make_term<1, 2>("spring", node,
                              [](Index, const auto& z) {
                                const auto stretch = z.col(0).squaredNorm() - 1.0;
                                return stretch * stretch;
                              }),
              1.0);
  const auto nearly = [](const Problem& problem, const Vec&) {
    SolveResult result;
    result.status = Status::Converged;
    result.y = (1 - 1e-6) * Eigen::Vector2d(0.6, 0.8);
    result.energy = Evaluator(problem).value(result.y);
    return result;
  };
  const Comparison all = compare(builder.build(), Eigen::Vector2d(1.2, 1.6), {planted(nearly)});
  EXPECT_EQ(all.runs[0].definite, Definite::Yes);
  EXPECT_EQ(all_notes(all), std::vector<std::string>());
}

// At the minimum of x^4 the Hessian is 0, which decides nothing.
TEST(CompareNotes, AHessianOfZeroIsNoSaddle) {
  ProblemBuilder builder(1);
  builder.add(make_term<1, 1>("quartic", Cells::Zero(1, 1),
                              [](Index, const auto& z) { return z[0] * z[0] * z[0] * z[0]; }),
              1.0);
  const auto at_zero = [](const Problem&, const Vec&) {
    SolveResult result;
    result.status = Status::Converged;
    result.y = Vec::Zero(1);
    return result;
  };
  const Comparison all = compare(builder.build(), Vec::Ones(1), {planted(at_zero)});
  EXPECT_EQ(all.runs[0].definite, Definite::NotTested);
  EXPECT_EQ(notes_with(all, "indefinite"), 0U);
}

// x^3 + x^4 has a stationary point at 0 and its minimum at -3/4.
TEST(CompareNotes, AnEndOnTheWayDown) {
  ProblemBuilder builder(1);
  builder.add(make_term<1, 1>("inflected", Cells::Zero(1, 1),
                              [](Index, const auto& z) {
                                return z[0] * z[0] * z[0] + z[0] * z[0] * z[0] * z[0];
                              }),
              1.0);
  const auto at = [](double x) {
    return planted([x](const Problem& problem, const Vec&) {
      SolveResult result;
      result.status = Status::Converged;
      result.y = Vec::Constant(1, x);
      result.energy = Evaluator(problem).value(result.y);
      return result;
    });
  };
  const Comparison all = compare(builder.build(), Vec::Ones(1), {at(1e-5), at(-0.75)});
  EXPECT_EQ(notes_with(all, "ended higher than"), 1U);
  EXPECT_EQ(notes_with(all, "another minimum"), 0U);
}

// Returns a problem of one unknown with minima near -1 and 1, the second about 2 * slope higher.
Problem two_wells(double slope) {
  ProblemBuilder builder(1);
  builder.add(std::make_shared<test::Chain>(
                  1, test::Scalar{[=](double t) { return std::pow(t * t - 1, 2) + slope * t; },
                                  [=](double t) { return 4 * t * (t * t - 1) + slope; },
                                  [](double t) { return 12 * t * t - 4; }}),
              1.0);
  return builder.build();
}

TEST(CompareNotes, MinimaThatDiffer) {
  const auto compared = [](double slope, double other_start, bool compares_points) {
    const auto elsewhere = [=](const Problem& problem, const Vec&) {
      return NewtonMinimizer().minimize(problem, Vec::Constant(1, other_start), nullptr);
    };
    std::vector<ComparisonMethod> methods = named_methods({"newton", "lbfgs"}, all_methods());
    methods.push_back(planted(elsewhere));
    return compare(two_wells(slope), Vec::Constant(1, -1.3), methods,
                   {.compares_points = compares_points});
  };
  const Comparison higher = compared(0.1, 1.3, true);
  ASSERT_EQ(all_notes(higher).size(), 1u);
  expect_contains(run_of(higher, "planted").notes[0],
                  {"another minimum than newton", "energy higher by 2.00e-01", "2.00e+00 away"});
  EXPECT_NEAR(run_of(higher, "planted").distance, 2, 0.1);

  const Comparison equal = compared(0, 1.3, true);
  ASSERT_EQ(all_notes(equal).size(), 1u);
  EXPECT_EQ(notes_with(equal, "another minimum of the same energy"), 1u);
  EXPECT_EQ(all_notes(compared(0, 1.3, false)), std::vector<std::string>());
  EXPECT_EQ(all_notes(compared(0.1, -1.3, true)), std::vector<std::string>());
}

TEST(CompareNotes, AGradientMuchLargerThanThatOfTheOthers) {
  const auto compared = [](int steps) {
    std::vector<ComparisonMethod> methods =
        named_methods({"newton", "newton-exact", "lbfgs"}, all_methods());
    methods.push_back(planted([=](const Problem& problem, const Vec& y) {
      NewtonOptions options;
      options.stopping.max_iterations = steps;
      SolveResult result = NewtonMinimizer(options).minimize(problem, y, nullptr);
      result.status = Status::Converged;
      return result;
    }));
    return compare(two_wells(0.1), Vec::Constant(1, -1.5), methods);
  };
  const Comparison early = compared(3);
  ASSERT_EQ(all_notes(early).size(), 1u) << testing::PrintToString(all_notes(early));
  expect_contains(run_of(early, "planted").notes[0], {"stopped with a gradient of"});
  EXPECT_EQ(all_notes(compared(100)), std::vector<std::string>());
}

TEST(Compare, TableHasTheNotes) {
  const Comparison all{"", "", {{"a", "converged", "", {{}}, 7}}, {"look here"}};
  Comparison noted = all;
  noted.runs[0].notes = {"a saddle"};
  const std::string text = comparison_table(noted);
  EXPECT_NE(text.find("a: a saddle\n"), std::string::npos);
  EXPECT_NE(text.find("note: look here\n"), std::string::npos);
  const std::string csv = comparison_rows_csv(noted);
  EXPECT_NE(csv.find("\na,converged,0,7,0,"), std::string::npos) << csv;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
