// Barriers whose weight falls to 0: their ends, reports and refusals.
#include "majorant/framework/barrier_minimizer.h"

#include <gtest/gtest.h>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/local_term.h"
#include "random.h"

namespace majorant {
namespace {

// The points of the unit disk, one for each corner of a polygon, that lie farthest along c.
struct Disks {
  Vec directions;
  Problem problem;
  TermId barrier;

  explicit Disks(Index count, double weight = 1)
      : Disks(count, weight, ProblemBuilder(2 * count)) {}

 private:
  Disks(Index count, double weight, ProblemBuilder builder)
      : directions(test::Random(1).vector(2 * count)), problem(), barrier() {
    Cells points(count, 1);
    for (Index i = 0; i < count; ++i) points(i, 0) = i;
    const auto disk = inequality<1, 2>("disk", points,
                                       [](Index, const auto& z) { return 1.0 - z.squaredNorm(); });
    builder.add(linear_term("along", -directions), 1);
    barrier = builder.add(disk.barrier(), weight);
    problem = builder.build();
  }
};

TEST(BarrierMinimizer, EndsOnTheBoundary) {
  const Index count = 50;
  const Disks disks(count);
  const BarrierResult result =
      BarrierMinimizer({disks.barrier}).run(disks.problem, Vec::Zero(2 * count));
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  double best = 0;
  for (Index i = 0; i < count; ++i) {
    const Vector2 c = disks.directions.segment<2>(2 * i), x = result.y.segment<2>(2 * i);
    EXPECT_LE((x - c.normalized()).norm(), 1e-6);
    EXPECT_LT(x.norm(), 1);
    best -= c.norm();
  }
  EXPECT_NEAR(result.energy, best, 1e-8 * -best);
  EXPECT_GE(result.energy, best);
}

TEST(BarrierMinimizer, ReportsItsPhases) {
  const Disks disks(7, 3);
  BarrierOptions options;
  options.first_gap = 10;  // no phase is long
  options.fall = 0.2;
  options.tolerance = 1e-5;
  int seen = 0;
  StepObserver observer([&](const TraceEntry& row, const Vec&) {
    EXPECT_EQ(row.record.iteration, ++seen);
    return Directive::Continue;
  });
  const BarrierResult result =
      BarrierMinimizer({disks.barrier}, options).run(disks.problem, Vec::Zero(14), &observer);
  int iterations = 0;
  for (std::size_t k = 0; k < result.phases.size(); ++k) {
    const BarrierPhase& phase = result.phases[k];
    iterations += phase.iterations;
    EXPECT_DOUBLE_EQ(phase.gap, 7 * 3 * phase.mu);
    if (k == 0) continue;
    EXPECT_DOUBLE_EQ(phase.mu, 0.2 * result.phases[k - 1].mu);
    EXPECT_LT(phase.energy, result.phases[k - 1].energy);
  }
  EXPECT_EQ(result.iterations.size(), iterations);
  EXPECT_EQ(result.iterations.back().iteration, iterations);
  EXPECT_EQ(seen, iterations);
  const BarrierPhase& last = result.phases.back();
  EXPECT_EQ(last.energy, result.energy);
  EXPECT_LE(last.gap, 1e-5 * std::abs(last.energy));
  EXPECT_GT(last.gap, 0.2 * 0.2 * 1e-5 * std::abs(last.energy));
  // On a convex problem the gap bounds the excess energy.
  double best = 0;
  for (Index i = 0; i < 7; ++i) best -= disks.directions.segment<2>(2 * i).norm();
  EXPECT_LE(result.energy - best, 1.001 * last.gap);
}

// Hock and Schittkowski 71 has the minimum 17.0140173 at (1, 4.743, 3.8211, 1.3794); its equality
// is a penalty here, its bounds and inequality barriers.
TEST(BarrierMinimizer, NonconvexWithOtherConstraintsInactive) {
  const auto objective = make_term<4>("hs71", Cells{{0, 1, 2, 3}}, [](Index, const auto& z) {
    const auto sphere = z.squaredNorm() - 40.0;
    return z[0] * z[3] * (z[0] + z[1] + z[2]) + z[2] + 1e6 * sphere * sphere;
  });
  const auto product = inequality<4>("product", Cells{{0, 1, 2, 3}}, [](Index, const auto& z) {
    return z[0] * z[1] * z[2] * z[3] - 25.0;
  });
  Cells each(4, 1);
  each << 0, 1, 2, 3;
  const auto low = inequality<1>("low", each, [](Index, const auto& z) { return z[0] - 1.0; });
  const auto high = inequality<1>("high", each, [](Index, const auto& z) { return 5.0 - z[0]; });
  ProblemBuilder builder(4);
  builder.add(objective, 1);
  const std::vector<TermId> ids{builder.add(product.barrier(), 1), builder.add(low.barrier(), 1),
                                builder.add(high.barrier(), 1)};
  const BarrierResult result =
      BarrierMinimizer(ids).run(builder.build(), Vec{{1.5, 4.5, 4.5, 1.5}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_LE((result.y - Vec{{1, 4.7429994, 3.8211503, 1.3794082}}).norm(), 1e-5);
}

TEST(BarrierMinimizer, PenaltyEndsOutside) {
  // (x - 2)^2 with x <= 1: x = 1 + 1 / (1 + w).
  const auto pull = make_term<1>("pull", Cells{{0}},
                                 [](Index, const auto& z) { return (z[0] - 2.0) * (z[0] - 2.0); });
  const auto wall =
      inequality<1>("wall", Cells{{0}}, [](Index, const auto& z) { return 1.0 - z[0]; });
  for (const double start : {-3.0, 0.5, 5.0}) {
    EXPECT_TRUE(check_derivatives(*wall.penalty(), Vec::Constant(1, start)).ok());
    const Problem problem = ProblemBuilder(1).add(pull, 1).add(wall.penalty(), 99).build();
    const SolveResult result = NewtonMinimizer().minimize(problem, Vec::Constant(1, start), {});
    EXPECT_NEAR(result.y[0], 1.01, 1e-9);
  }
}

TEST(BarrierMinimizer, LimitsAndStarts) {
  const Disks disks(5);
  const auto run = [&](BarrierOptions options, const Vec& y0, RunObserver* observer = nullptr) {
    return BarrierMinimizer({disks.barrier}, options).run(disks.problem, y0, observer);
  };
  BarrierOptions few;
  few.newton.stopping.max_iterations = 7;
  EXPECT_EQ(run(few, Vec::Zero(10)).status, Status::MaxIterations);
  EXPECT_EQ(run(few, Vec::Zero(10)).iterations.size(), 7);
  StepObserver interrupt([](const TraceEntry& row, const Vec&) {
    return row.record.iteration == 9 ? Directive::Interrupt : Directive::Continue;
  });
  const BarrierResult interrupted = run({}, Vec::Zero(10), &interrupt);
  EXPECT_EQ(interrupted.status, Status::Interrupted);
  EXPECT_EQ(interrupted.iterations.size(), 9);
  const BarrierResult outside = run({}, Vec::Constant(10, 1));
  EXPECT_EQ(outside.status, Status::Infeasible);
  EXPECT_EQ(outside.y, Vec::Constant(10, 1));
  EXPECT_TRUE(
      outside.message.ends_with("Bounds::interior() moves a start inside, "
                                "BarrierMinimizer::of_bounds() leads it"))
      << outside.message;
}

// A barrier with more weight than its number of elements: E, 1 at the bound, exceeds that by 1000
// mu.
TEST(BarrierMinimizer, ReachesTheMinimumForHeavyBarriers) {
  ProblemBuilder builder(1);
  builder.add(linear_term("along", Vec::Ones(1)), 1);
  const TermId barrier = builder.add(make_term<1>("heavy", Cells{{0}},
                                                  [](Index, const auto& z) {
                                                    using std::log;
                                                    return -1000.0 * log(z[0] - 1.0);
                                                  }),
                                     1);
  const Problem problem = builder.build();
  const BarrierResult result = BarrierMinimizer({barrier}).run(problem, Vec{{2}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_EQ(result.end, PathEnd::Arrived);
  EXPECT_NEAR(result.energy, 1, 2e-8);
  BarrierOptions options;
  options.most_phases = 9;
  const BarrierResult limited = BarrierMinimizer({barrier}, options).run(problem, Vec{{2}});
  EXPECT_EQ(limited.status, Status::Stalled);
  EXPECT_EQ(limited.end, PathEnd::None);
  EXPECT_EQ(limited.phases.size(), 9u);
  EXPECT_TRUE(limited.message.find("after 9 weights of their barriers") != std::string::npos)
      << limited.message;
}

// x_k >= limit for every unknown; certifies paths.
class Above final : public BarrierChecker {
 public:
  explicit Above(double limit) : limit_(limit) {}
  std::string_view name() const override { return "above"; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    verdict.margin = x.minCoeff() - limit_;
    verdict.feasible = verdict.margin > 0;
    if (!verdict.feasible) verdict.blocking.push_back(0);
    return verdict;
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    StepBound bound{s, {}};
    for (Index k = 0; k < x.size(); ++k)
      if (d[k] < 0) bound.step = std::min(bound.step, (limit_ - x[k]) / d[k]);
    return bound;
  }
  std::shared_ptr<const EnergyTerm> barrier() const override {
    return make_term<1>("above", Cells{{0}, {1}}, [l = limit_](Index, const auto& z) {
      using std::log;
      return -log(z[0] - l);
    });
  }
  std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const override {
    const double least = x.minCoeff();
    return std::make_shared<const Above>(std::min(limit_, least - 0.1 * (1 + std::abs(least))));
  }

 private:
  double limit_;
};

// A checker that does not relax.
class Stubborn final : public BarrierChecker {
 public:
  std::string_view name() const override { return "stubborn"; }
  Verdict check(VecIn x) const override { return above_.check(x); }
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }
  std::shared_ptr<const EnergyTerm> barrier() const override { return above_.barrier(); }
  std::shared_ptr<const BarrierChecker> relaxed(VecIn) const override {
    return std::make_shared<const Stubborn>();
  }

 private:
  Above above_{1};
};

// Requires every unknown to be below 1/2.
class HeldBelow final : public FeasibilityChecker {
 public:
  std::string_view name() const override { return "held below"; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    verdict.feasible = x.maxCoeff() < 0.5;
    return verdict;
  }
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }
};

// |x - target|^2 with x >= 1, y >= 1.
struct Walled {
  Problem problem;
  BarrierMinimizer minimizer;

  Walled(Vec target, std::shared_ptr<const BarrierChecker> wall, BarrierOptions options = {})
      : Walled(target, wall, options, ProblemBuilder(2)) {}

 private:
  Walled(Vec target, std::shared_ptr<const BarrierChecker> wall, const BarrierOptions& options,
         ProblemBuilder builder)
      : problem(), minimizer({}) {
    builder.add(make_term<1>("pull", Cells{{0}, {1}},
                             [target](Index e, const auto& z) {
                               return (z[0] - target[e]) * (z[0] - target[e]);
                             }),
                1);
    const TermId barrier = builder.add(wall->barrier(), 1);
    builder.add(wall);
    problem = builder.build();
    minimizer = BarrierMinimizer::of_bounds({{barrier, wall}}, {}, options);
  }
};

TEST(BarrierMinimizer, LeadsStartsInside) {
  const auto above = std::make_shared<const Above>(1);
  for (const double start : {-40.0, 0.0, 1.0, 5.0}) {
    SCOPED_TRACE(start);
    const Walled w(Vec{{-3, 4}}, above);
    const BarrierResult result = w.minimizer.run(w.problem, Vec{{start, start}});
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_LE((result.y - Vec{{1, 4}}).norm(), 1e-5);
    EXPECT_GT(result.y[0], 1);
    EXPECT_FALSE(result.phases.empty());
    for (std::size_t k = 0; k < result.iterations.size(); ++k)
      EXPECT_EQ(result.iterations[k].iteration, static_cast<int>(k) + 1);
  }
}

TEST(BarrierMinimizer, NamesTheBoundThatNoPointMeets) {
  // Both unknowns must be below 1.
  const auto above = std::make_shared<const Above>(1);
  ProblemBuilder builder(2);
  builder.add(
      make_term<2>("bowl", Cells{{0, 1}}, [](Index, const auto& z) { return z.squaredNorm(); }), 1);
  const TermId barrier = builder.add(above->barrier(), 1);
  builder.add(above);
  builder.add(std::make_shared<const HeldBelow>());
  const BarrierResult result =
      BarrierMinimizer::of_bounds({{barrier, above}}).run(builder.build(), Vec::Zero(2));
  EXPECT_EQ(result.status, Status::Stalled);
  EXPECT_EQ(result.message,
            "no point was found that meets the bound 'above', held back by 'held below'; that is "
            "no proof that there is none, start inside");
  EXPECT_EQ(result.blocking, std::vector<Index>{0});
  EXPECT_TRUE(result.phases.empty());
}

// x^2 with x >= low, and 1 - x^2 >= 0, repeated.
struct Slit {
  Problem problem;
  BarrierMinimizer minimizer;

  explicit Slit(double low, Index copies = 1) : Slit(low, copies, ProblemBuilder(1)) {}

 private:
  Slit(double low, Index copies, ProblemBuilder builder) : problem(), minimizer({}) {
    builder.add(make_term<1>("bowl", Cells{{0}}, [](Index, const auto& z) { return z[0] * z[0]; }),
                1);
    const double none = std::numeric_limits<double>::infinity();
    const auto above = Bounds(Vec::Constant(1, low), Vec::Constant(1, none)).checker();
    const auto below = inequality<1>("below 1", Cells::Zero(copies, 1), [](Index, const auto& z) {
                         return 1.0 - z[0] * z[0];
                       }).checker();
    const HeldBound held[] = {{builder.add(above->barrier(), 1), above},
                              {builder.add(below->barrier(), 1), below}};
    builder.add(above).add(below);
    problem = builder.build();
    minimizer = BarrierMinimizer::of_bounds({held[0], held[1]});
  }
};

TEST(BarrierMinimizer, FindsANarrowInside) {
  for (const double low : {0.5, 0.9, 0.99, 0.9999})
    for (const Index copies : {1, 1000})
      for (const double start : {-0.9, 0.0, 5.0}) {
        SCOPED_TRACE(testing::Message() << low << " " << copies << " " << start);
        const Slit slit(low, copies);
        const BarrierResult result = slit.minimizer.run(slit.problem, Vec::Constant(1, start));
        EXPECT_EQ(result.status, Status::Converged) << result.message;
        EXPECT_NEAR(result.y[0], low, 1e-5);
        EXPECT_GT(result.y[0], low);
        EXPECT_LE(result.iterations.size(), 100);
      }
}

// The part of the unit disk to the right of x = low, and a curved valley in it.
struct Cap {
  Problem problem;
  BarrierMinimizer minimizer{{}};

  explicit Cap(double low, const BarrierOptions& options = {}) {
    const double none = std::numeric_limits<double>::infinity();
    const auto right = Bounds(Vec{{low, -none}}, Vec::Constant(2, none)).checker();
    const auto disk = inequality<1, 2>("disk", Cells{{0}}, [](Index, const auto& z) {
                        return 1.0 - z.squaredNorm();
                      }).checker();
    ProblemBuilder builder(2);
    builder.add(make_term<2>("valley", Cells{{0, 1}},
                             [](Index, const auto& z) {
                               const auto off = z[1] - z[0] * z[0];
                               return (1.0 - z[0]) * (1.0 - z[0]) + 100.0 * off * off;
                             }),
                1);
    const HeldBound held[] = {{builder.add(right->barrier(), 1), right},
                              {builder.add(disk->barrier(), 1), disk}};
    builder.add(right).add(disk);
    problem = builder.build();
    minimizer = BarrierMinimizer::of_bounds({held[0], held[1]}, {}, options);
  }
};

TEST(BarrierMinimizer, DoesNotCreepAlongBoundsThatAreMet) {
  for (const double low : {0.9, 0.99, 0.999})
    for (const Vec& start : {Vec{{0, 0}}, Vec{{0, 0.99}}, Vec{{3, 3}}}) {
      SCOPED_TRACE(testing::Message() << low << " " << start.transpose());
      const Cap cap(low);
      const BarrierResult result = cap.minimizer.run(cap.problem, start);
      EXPECT_EQ(result.status, Status::Converged) << result.message;
      const double y = std::sqrt(1 - low * low);
      EXPECT_NEAR(result.y[0], low, 1e-6);
      EXPECT_NEAR(result.y[1], y, 1e-5);
      EXPECT_LE(result.iterations.size(), 150);
    }
  for (const Vec& start : {Vec{{0, 0}}, Vec{{0.1, 0.2}}, Vec{{3, 1}}}) {
    const Cap none(2);
    const BarrierResult result = none.minimizer.run(none.problem, start);
    EXPECT_EQ(result.status, Status::Infeasible) << start.transpose() << ": " << result.message;
  }
}

TEST(BarrierMinimizer, ReportsViolationsLeftByALimit) {
  BarrierOptions few;
  few.newton.stopping.max_iterations = 1;
  const Cap cap(0.99, few);
  const BarrierResult result = cap.minimizer.run(cap.problem, Vec::Zero(2));
  EXPECT_EQ(result.status, Status::MaxIterations);
  EXPECT_NE(result.message.find("; the point violates 'bounds' by "), std::string::npos)
      << result.message;
}

TEST(BarrierMinimizer, ReportsByHowMuchBoundsContradictEachOther) {
  const Slit slit(1.25);
  for (const double start : {0.0, 5.0}) {  // starts with 1 - x^2 >= 0, and with x >= 1.25
    SCOPED_TRACE(start);
    const BarrierResult result = slit.minimizer.run(slit.problem, Vec::Constant(1, start));
    EXPECT_EQ(result.status, Status::Infeasible);
    EXPECT_TRUE(result.phases.empty());
    EXPECT_EQ(result.message,
              "no point meets the bounds, or none nearby if they are not convex: their smallest "
              "violation is that of 'bounds' by 0.203 at unknown 0, held back by 'below 1'");
  }
}

TEST(BarrierMinimizer, AStationaryPointThatIsNoMinimumProvesNothing) {
  // Two points at one place have no direction of separation.
  ProblemBuilder builder(2);
  builder.add(
      make_term<2>("bowl", Cells{{0, 1}}, [](Index, const auto& z) { return z.squaredNorm(); }), 1);
  const auto apart = inequality<2>("apart", Cells{{0, 1}}, [](Index, const auto& z) {
                       return (z[1] - z[0]) * (z[1] - z[0]) - 1.0;
                     }).checker();
  const TermId barrier = builder.add(apart->barrier(), 1);
  builder.add(apart);
  const BarrierMinimizer minimizer = BarrierMinimizer::of_bounds({{barrier, apart}});
  const Problem problem = builder.build();
  const BarrierResult held = minimizer.run(problem, Vec::Zero(2));
  EXPECT_EQ(held.status, Status::Stalled);
  EXPECT_EQ(held.message,
            "no point was found that meets the bounds: the last one violates 'apart' by 1 at "
            "element 0, which begins with unknown 0; that is no proof that there is none, start "
            "inside");
  const BarrierResult found = minimizer.run(problem, Vec{{0, 0.1}});
  EXPECT_EQ(found.status, Status::Converged) << found.message;
  EXPECT_NEAR(found.energy, 0.5, 1e-6);
}

// At a point of inflection the curvature of a nearby point is used.
TEST(BarrierMinimizer, LeavesAPointOfInflection) {
  ProblemBuilder builder(1);
  builder.add(make_term<1>("wave", Cells{{0}},
                           [](Index, const auto& z) {
                             using std::sin;
                             return sin(z[0]);
                           }),
              1.0);
  const BarrierResult result = BarrierMinimizer({}).run(builder.build(), Vec{{0}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_NEAR(result.energy, -1, 1e-12);
  EXPECT_EQ(result.definite, Definite::Yes);
}

// A one-sided barrier has no minimum if the energy is flat: a smaller weight is tried.
TEST(BarrierMinimizer, RestartsIfABarrierIsUnboundedBelow) {
  ProblemBuilder builder(1);
  builder.add(make_term<1>("hole", Cells{{0}},
                           [](Index, const auto& z) {
                             using std::exp;
                             return 0.03 * (1.0 - exp(-z[0] * z[0]));
                           }),
              1.0);
  const auto wall =
      inequality<1>("wall", Cells{{0}}, [](Index, const auto& z) { return z[0] + 1.0; });
  const TermId barrier = builder.add(wall.barrier(), 1.0);
  const BarrierResult result = BarrierMinimizer({barrier}).run(builder.build(), Vec{{3}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_NEAR(result.y[0], 0, 1e-5);
  EXPECT_LT(result.iterations.size(), 200u);
}

// Satisfied elements are not relaxed with the others.
TEST(BarrierMinimizer, RelaxesViolatedBounds) {
  const auto above = inequality<1>("above", Cells{{0}, {1}}, [](Index e, const auto& z) {
                       return z[0] - static_cast<double>(e);
                     }).checker();
  const auto relaxed = above->relaxed(Vec{{0.1, -4}});
  EXPECT_TRUE(relaxed->check(Vec{{0.1, -4}}).feasible);
  EXPECT_FALSE(relaxed->check(Vec{{-0.1, -4}}).feasible);
  EXPECT_FALSE(relaxed->check(Vec{{0.1, -10}}).feasible);
  EXPECT_TRUE(relaxed->check(Vec{{1e-6, -4}}).feasible);
  EXPECT_TRUE(above->relaxed(Vec{{0, 2}})->check(Vec{{-5e-4, 2}}).feasible);  // g is 0 at the point
}

TEST(BarrierMinimizer, LimitsHoldOnTheWayInside) {
  BarrierOptions few;
  few.newton.stopping.max_iterations = 1;
  const Walled w(Vec{{-3, 4}}, std::make_shared<const Above>(1), few);
  const BarrierResult result = w.minimizer.run(w.problem, Vec::Constant(2, -40));
  EXPECT_EQ(result.status, Status::MaxIterations);
  EXPECT_EQ(result.iterations.size(), 1);
  const Slit slit(0.5);
  StepObserver interrupt([](const TraceEntry&, const Vec&) { return Directive::Interrupt; });
  const BarrierResult ended = slit.minimizer.run(slit.problem, Vec::Zero(1), &interrupt);
  EXPECT_EQ(ended.status, Status::Interrupted);
  EXPECT_EQ(ended.iterations.size(), 1);
  EXPECT_TRUE(ended.phases.empty());
}

TEST(BarrierMinimizer, Misuse) {
  const Disks disks(5);
  const Vec y0 = Vec::Zero(10);
  EXPECT_THROW(BarrierMinimizer({TermId(7)}).run(disks.problem, y0), Error);
  EXPECT_THROW(BarrierMinimizer({disks.barrier, disks.barrier}).run(disks.problem, y0), Error);
  const auto above = std::make_shared<const Above>(1);
  EXPECT_THROW(BarrierMinimizer::of_bounds({{disks.barrier, above}}).run(disks.problem, y0),
               InvalidArgument);  // not a checker of the problem
  EXPECT_THROW(BarrierMinimizer::of_bounds({{disks.barrier, nullptr}}), InvalidArgument);
  const Walled wrong(y0, std::make_shared<const Stubborn>());
  EXPECT_THROW(wrong.minimizer.run(wrong.problem, Vec::Zero(2)), InvalidArgument);
  EXPECT_THROW(BarrierMinimizer({}, {.fall = 1}), Error);
  EXPECT_THROW(BarrierMinimizer({}, {.tolerance = 0}), Error);
  EXPECT_THROW(BarrierMinimizer({}, {.first_gap = -1}), Error);
}

TEST(BarrierMinimizer, WithoutBarriersItIsNewton) {
  const auto bowl = make_term<2>("bowl", Cells{{0, 1}}, [](Index, const auto& z) {
    return z.squaredNorm() + z[0] * z[1] + z[0];
  });
  const Problem problem = ProblemBuilder(2).add(bowl, 1).build();
  const BarrierResult result = BarrierMinimizer({}).run(problem, Vec::Ones(2));
  const SolveResult newton = NewtonMinimizer().minimize(problem, Vec::Ones(2), {});
  EXPECT_EQ(result.y, newton.y);
  EXPECT_EQ(result.phases.size(), 1);
  EXPECT_EQ(result.phases.back().mu, 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
