// Measures the cost and the quality of multiresolution starts.
//
// Each mesh is solved at degree 1 with symmetric Dirichlet, a free boundary and one thread. The
// program prints the CPU time of every part of the start in fe (bench/unit_fe.h), and the excess of
// the start's energy over the minimum reached from it. It also prints the iterations to within 1e-2
// and 1e-4 of that minimum, from this start and from Tutte's, with the final energies.
//
// Sample runs:
//   build/release/bench/majorant_multiresolution ../shared/data/public/disks/*_10000.obj
//   build/release/bench/majorant_multiresolution --start-only /tmp/spot_1000000.obj
//   build/release/bench/majorant_multiresolution --ratio 2 --sweeps 2 examples/meshes/creature.obj
#include "majorant/parametrization/initialization/multiresolution.h"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <string>

#include "majorant/constraints/constraints.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "unit_fe.h"

using namespace majorant;

namespace {

// Upper bound on the faces of meshes whose factorization is timed more than once.
constexpr Index kLarge = 300000;

// Returns the seconds of 1 fe of the surface's matrix.
double factorization(const SurfaceMesh& mesh, const Vec& x) {
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh.faces(), mesh.vertex_count(), 1);
  ProblemBuilder builder(2 * mesh.vertex_count());
  builder.add(symmetric_dirichlet()(space, flat_triangles(mesh.positions(), mesh.faces()),
                                    {lattice_rule(1)}),
              1.0 / mesh.area());
  builder.add(FixedPoints::at({0}, x));
  const Problem problem = builder.build();
  Vec g, h;
  Evaluator(problem).linearize(problem.reduce(x), Curvature::Projected, g, h);
  return measure_unit_fe(problem.pattern(), h, g, mesh.face_count() > kLarge ? 1 : 3).seconds;
}

struct Run {
  double start_error, energy;
  int coarsely = -1, finely = -1, iterations;  // to within 1e-2, to within 1e-4, in all
};

Run solve(const std::shared_ptr<const SurfaceMesh>& mesh, const Vec& start) {
  ParametrizationOptions options;
  options.map.degree = 1;
  RunRecord record;
  const ParametrizationResult result = parametrize(BezierMap::linear(mesh, start), options, record);
  Run run{};
  run.energy = result.value_quadrature;
  run.start_error = result.initial_value / run.energy - 1;
  run.iterations = static_cast<int>(record.trace().size());
  const auto reached = [&](double tolerance) {
    if (run.start_error <= tolerance) return 0;
    for (const TraceEntry& e : record.trace())
      if (e.phase != Phase::SoftStart && e.record.energy <= (1 + tolerance) * run.energy)
        return e.record.iteration;
    return -1;
  };
  run.coarsely = reached(1e-2);
  run.finely = reached(1e-4);
  return run;
}

void report(const std::string& path, const MultiresolutionRules& rules, bool start_only) {
  const auto mesh =
      std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
  const std::string name = path.substr(path.rfind('/') + 1);
  MultiresolutionRecord record;
  const double before = cpu_seconds();
  const auto start = multiresolution_map(*mesh, {}, {}, rules, &record);
  const double total = cpu_seconds() - before;
  if (!start) {
    fmt::print("| {} | {} | given up |\n", name, mesh->face_count());
    return;
  }
  const double unit = factorization(*mesh, *start);
  LevelRecord sum;
  for (std::size_t k = 1; k < record.levels.size(); ++k) {
    sum.insert_seconds += record.levels[k].insert_seconds;
    sum.sweep_seconds += record.levels[k].sweep_seconds;
    sum.compressed_seconds += record.levels[k].compressed_seconds;
    sum.solve_seconds += record.levels[k].solve_seconds;
  }
  fmt::print("| {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |",
             name, mesh->face_count(), 1e3 * unit, record.decimation_seconds / unit,
             record.levels.front().solve_seconds / unit, sum.insert_seconds / unit,
             sum.sweep_seconds / unit, sum.compressed_seconds / unit, sum.solve_seconds / unit,
             total / unit);
  if (!start_only) {
    const Run here = solve(mesh, *start), there = solve(mesh, tutte_map(*mesh));
    fmt::print(" {:.1e} | {} / {} of {} | {:.8f} | {} / {} of {} | {:.8f} |", here.start_error,
               here.coarsely, here.finely, here.iterations, here.energy, there.coarsely,
               there.finely, there.iterations, there.energy);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const ThreadCount one(1);
  MultiresolutionRules rules;
  const std::map<std::string, double*> reals{
      {"--ratio", &rules.ratio},           {"--high-energy", &rules.high_energy},
      {"--compressed", &rules.compressed}, {"--compressed-share", &rules.compressed_share},
      {"--decrease", &rules.decrease},     {"--coarse-decrease", &rules.coarse_decrease}};
  const std::map<std::string, int*> integers{{"--coarsest", &rules.coarsest},
                                             {"--sweeps", &rules.sweeps},
                                             {"--insertion-steps", &rules.insertion_steps},
                                             {"--high-energy-rounds", &rules.high_energy_rounds},
                                             {"--compressed-rings", &rules.compressed_rings},
                                             {"--compressed-steps", &rules.compressed_steps},
                                             {"--factor-steps", &rules.factor_steps},
                                             {"--most-steps", &rules.most_steps}};
  bool start_only = false;
  fmt::print(
      "| mesh | faces | fe, ms | decimation | coarsest | insertion | sweeps | compressed | levels "
      "| "
      "start, "
      "fe | error | to 1e-2 / 1e-4 | energy | from Tutte | energy |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int a = 1; a < argc; ++a) {
    const std::string word = argv[a];
    if (word == "--start-only")
      start_only = true;
    else if (reals.count(word) && a + 1 < argc)
      *reals.at(word) = std::stod(argv[++a]);
    else if (integers.count(word) && a + 1 < argc)
      *integers.at(word) = std::stoi(argv[++a]);
    else
      report(word, rules, start_only);
  }
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
