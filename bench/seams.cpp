// What seams cost: rows and elimination, and Newton's iteration with them against the same cut mesh
// without them, in one run.
//
// The surface is a plate with 7 bumps made of squares, 64 cones, cut open along a short tree
// (--cuts long: a tree twice as long), lifted so that there is something to optimize; its seamless
// coordinates are known by construction. "Glued" is the closed surface with one value a node: what
// the translations of the seams add is measured against that, because cutting a surface open makes
// its factorization cheaper by itself.
//
// Sample runs:
//   build/release/bench/majorant_seams_bench
//   build/release/bench/majorant_seams_bench --cuts long
//   build/release/bench/majorant_seams_bench --subdivision 9 --degrees 1,3 --threads 2 --steps 8
//   build/release/bench/majorant_seams_bench --subdivision 4 --more-cuts 0.1   # random ones
#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <string>
#include <vector>

#include "majorant/constraints/fixed_points.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/named_energies.h"
#include "majorant/framework/internal/problem_parts.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/thread_count.h"
#include "majorant/parametrization/maps/internal/quadrature_ladder.h"
#include "parametrization/maps/test_maps.h"
#include "parametrization/starts/seamless_cases.h"

using namespace majorant;

namespace {

struct Arguments {
  int subdivision = 18, threads = 1, steps = 6;
  double more_cuts = 0;  // of the edges
  Charts charts = Charts::ConeTree;
  std::vector<int> degrees{1};
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int k = 1; k + 1 < argc; k += 2) {
    if (!std::strcmp(argv[k], "--subdivision")) a.subdivision = std::stoi(argv[k + 1]);
    if (!std::strcmp(argv[k], "--threads")) a.threads = std::stoi(argv[k + 1]);
    if (!std::strcmp(argv[k], "--steps")) a.steps = std::stoi(argv[k + 1]);
    if (!std::strcmp(argv[k], "--more-cuts")) a.more_cuts = std::stod(argv[k + 1]);
    if (!std::strcmp(argv[k], "--cuts") && !std::strcmp(argv[k + 1], "long"))
      a.charts = Charts::OneWithoutSlits;
    if (std::strcmp(argv[k], "--degrees")) continue;
    a.degrees.clear();
    for (const char* c = argv[k + 1]; *c; ++c)
      if (*c != ',') a.degrees.push_back(*c - '0');
  }
  return a;
}

template <class F>
auto timed(double& milliseconds, const F& f) {
  const auto start = std::chrono::steady_clock::now();
  auto result = f();
  milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

SeamlessCase bumpy_plate(int m, Charts charts) {
  std::vector<std::array<int, 3>> cubes;
  for (int i = 0; i < 15; ++i)
    for (int j = 0; j < 3; ++j) {
      cubes.push_back({i, j, 0});
      if (i % 2 == 1 && j == 1) cubes.push_back({i, j, 1});
    }
  return squares_case(polycube(cubes), m, charts, [](const Vector3& p) {
    return Vector3(p.x() + 0.12 * std::sin(3 * p.y() + p.z()), p.y() + 0.1 * std::sin(2.3 * p.x()),
                   p.z() + 0.15 * std::sin(1.7 * p.x() + 2.1 * p.y()));
  });
}

void report_elimination(const SeamlessConstraint& constraint, Index full_size) {
  double rows_ms = 0, eliminate_ms = 0;
  const ConstraintRows rows = timed(rows_ms, [&] {
    ConstraintRows r;
    constraint.append_rows(r);
    return r;
  });
  const Elimination z = timed(eliminate_ms, [&] { return Elimination(full_size, rows); });
  std::vector<Index> column(at(z.reduced_size()), 0);
  long nonzeros = 0;
  for (Index i = 0; i < full_size; ++i)
    for (auto e = z.begin(i); e != z.end(i); ++e, ++nonzeros) ++column[at(e->reduced)];
  fmt::print(
      "rows {} ({:.1f} ms), elimination {:.1f} ms: rank {}, unknowns {} -> {}, Z {} nonzeros, "
      "largest column {}\n",
      rows.size(), rows_ms, eliminate_ms, z.rank(), full_size, z.reduced_size(), nonzeros,
      *std::max_element(column.begin(), column.end()));
}

// Mean milliseconds of an iteration, all, and by part.
struct Costs {
  double build = 0, analyze = 0, total = 0, assemble = 0, factorize = 0, solve = 0, search = 0;
  double trials = 0, energy = 0;
  std::size_t colours = 0;
  long nonzeros = 0;
  std::string solver;
};

Costs newton_costs(const ProblemBuilder& builder, const Vec& x, int steps) {
  Costs c;
  const Problem problem = timed(c.build, [&] { return builder.build(); });
  c.colours = ProblemParts::plan(problem, problem.terms().front()).colours().size();
  c.nonzeros = problem.pattern().nonzeros();
  const auto solver = make_direct_solver();
  timed(c.analyze, [&] {
    solver->analyze(problem.pattern());
    return 0;
  });
  c.solver = solver->description();
  NewtonStepper stepper(problem, {});
  Vec y = problem.reduce(x);
  double energy = stepper.evaluator().value(y);
  stepper.step(y, energy);  // allocates
  for (int k = 0; k < steps; ++k) {
    double ms = 0;
    const auto step = timed(ms, [&] { return stepper.step(y, energy); });
    const double share = 1e3 / steps;
    c.total += ms / steps;
    c.assemble += share * step.record.seconds.assemble;
    c.factorize += share * step.record.seconds.factorize;
    c.solve += share * step.record.seconds.solve;
    c.search += share * step.record.seconds.line_search;
    c.trials += double(step.record.trials) / steps;
  }
  c.energy = energy;
  return c;
}

void print(const char* name, const Costs& c) {
  fmt::print(
      "{:8} build {:7.1f} ms, analyze {:7.1f} ms, {} colours, {} nonzeros, {}\n"
      "{:8} iteration {:7.1f} ms = assemble {:.1f} + factorize {:.1f} + solve {:.1f} + line search "
      "{:.1f} ({:.1f} trials); energy {:.6f}\n",
      name, c.build, c.analyze, c.colours, c.nonzeros, c.solver, "", c.total, c.assemble,
      c.factorize, c.solve, c.search, c.trials, c.energy);
}

// What factorization and solve would cost on the glued surface, one value a node, no translations:
// for any numbers in its pattern.
double report_glued(const SurfaceMesh& mesh, int degree, int steps) {
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh.faces(), mesh.vertex_count(), degree);
  const RestShapes rest = flat_triangles(mesh.positions(), mesh.faces());
  const auto term = symmetric_dirichlet()(space, rest, optimizer_ladder(degree, 0).guarded);
  const Problem problem = ProblemBuilder(2 * space->node_count()).add(term, 1.0).build();
  const SparsePattern& pattern = problem.pattern();
  const auto solver = make_direct_solver();
  solver->analyze(pattern);
  Vec values = Vec::Constant(pattern.nonzeros(), -1.0), p;
  for (Index j = 0; j < pattern.size; ++j)
    values[pattern.column_starts[at(j)]] = double(pattern.nonzeros()) / pattern.size * 20;
  solver->factorize(values, 0);
  double ms = 0;
  timed(ms, [&] {
    for (int k = 0; k < steps; ++k) {
      solver->factorize(values, 0);
      solver->solve(Vec::Ones(pattern.size), p);
    }
    return 0;
  });
  fmt::print("{:8} factorize + solve {:.1f} ms, {}\n", "glued", ms / steps, solver->description());
  return ms / steps;
}

void report_degree(const SurfaceMesh& glued_mesh, const BezierMap& start, int degree, int steps) {
  const BezierMap map = elevated_to(start, degree);
  const auto space = map.shared_space();
  const RestShapes rest = flat_triangles(map.mesh().positions(), map.mesh().faces());
  const Index full_size = 2 * space->node_count();
  const SeamlessConstraint seams(space, map.shared_seams());
  fmt::print("degree {}: ", degree);
  report_elimination(seams, full_size);
  const auto term = symmetric_dirichlet()(space, rest, optimizer_ladder(degree, 0).guarded);
  const auto injectivity = std::make_shared<const LocalInjectivity>(space, 2 * rest.measure);
  const auto builder = [&] {
    ProblemBuilder b(full_size);
    b.add(term, 1.0 / rest.measure.sum()).add(injectivity);
    return b;
  };
  const FixedPoints gauge = FixedPoints::at({map.mesh().faces()(0, 2)}, map.control_points());
  const Costs free = newton_costs(builder().add(gauge), map.control_points(), steps);
  const Costs held = newton_costs(builder().add(seams).add(gauge), map.control_points(), steps);
  print("without", free);
  print("with", held);
  const double glued = report_glued(glued_mesh, degree, steps);
  const auto per_trial = [](const Costs& c) {
    return c.assemble + c.factorize + c.solve + c.search / c.trials;
  };
  fmt::print(
      "with / without: build {:.2f}, assemble {:.2f}, factorize {:.2f}, solve {:.2f}, line search "
      "{:.2f}, iteration {:.2f}, iteration with one trial {:.2f}; factorize + solve with / glued "
      "{:.2f}\n",
      held.build / free.build, held.assemble / free.assemble, held.factorize / free.factorize,
      held.solve / free.solve, held.search / free.search, held.total / free.total,
      per_trial(held) / per_trial(free), (held.factorize + held.solve) / glued);
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  const ThreadCount threads(arguments.threads);
  double start_ms = 0;
  SeamlessCase surface = bumpy_plate(arguments.subdivision, arguments.charts);
  if (arguments.more_cuts > 0) surface = with_random_cuts(surface, arguments.more_cuts, 1);
  const Start start = timed(start_ms, [&] { return surface.start(); });
  const Seams& seams = start.map.seams();
  fmt::print(
      "{} faces, {} cones, {} seam edges, {} chains, {} thread(s); start read in {:.1f} ms\n",
      start.map.mesh().face_count(), seams.cones().size(), seams.edges().size(),
      seams.chain_count(), arguments.threads, start_ms);
  for (const int degree : arguments.degrees)
    report_degree(*surface.mesh, start.map, degree, arguments.steps);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
