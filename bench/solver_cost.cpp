// Measures parts of an iteration and whole runs in fe (unit_fe.h). One fe is one factorization and
// solve of the same matrix by CHOLMOD with fixed settings.
//
// For each mesh and degree, medians of --repeat, on --threads (1):
//
//     unit_ms        1 fe: the cheapest of four variants of CHOLMOD. `variants` has their names and
//                    milliseconds (JSON only; null: left out, since they cannot be the cheapest)
//     assembly_fe    gradient and Hessian at the optimum
//     analysis_fe, factorization_fe, solve_fe    by the library's default solver
//     iterations, factorizations    numbers of a whole run on the input mesh, which do not depend
//                    on the machine
//     start_fe       the initial map
//     setup_fe       everything besides start and iterations: coordinates, problem, analysis
//     iterations_fe  assembly, factorization, solve and line search of all iterations
//     total_fe       start, setup and iterations: from the mesh in memory to the control points in
//                    memory, without reading, writing and the final proof
//     fe_per_iteration    total_fe / iterations
//     energy, status
//     reached        the energy of a run to a tolerance of 1e-11, which is not timed
//     within_fe, within_iterations, within_factorizations    until the energy is at most
//                    (1 + 1e-4) reached; null if the run ends above that
//
// With one thread, seconds are CPU seconds, which depend little on other processes. With several,
// they are wall seconds of runs; the unit always has one thread. The seconds of a run are divided
// among its phases in proportion to their wall time.
//
// Sample runs:
//   build/release/bench/solver_cost ../shared/data/public/disks/*_10000.obj
//   build/release/bench/solver_cost --degrees 1,2,3 --json examples/meshes/creature.obj
//   build/release/bench/solver_cost --no-runs --threads 2 --degrees 3 examples/meshes/creature.obj
//   build/release/bench/solver_cost --init tutte --bijective examples/meshes/creature.obj
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench_problem.h"
#include "majorant/framework/parallel.h"
#include "unit_fe.h"

using namespace majorant;

namespace {

struct Arguments {
  std::vector<std::string> meshes;
  std::vector<int> degrees{1};
  int repeat = 5, threads = 1;
  std::string init = "auto";
  bool json = false, no_runs = false, bijective = false;
};

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <class F>
double median_seconds(const Arguments& arguments, const F& f) {
  std::vector<double> seconds;
  for (int k = 0; k < arguments.repeat; ++k) {
    const auto now = arguments.threads == 1 ? cpu_seconds : wall_seconds;
    const double started = now();
    f();
    seconds.push_back(now() - started);
  }
  return median(seconds);
}

// Prints the parts of one iteration. Returns the unit in seconds.
double measure_pieces(const BenchProblem& b, const Arguments& arguments,
                      nlohmann::ordered_json& row) {
  Evaluator evaluator(b.problem);
  const Vec y = b.problem.reduce(b.x);
  Vec g, h, p;
  evaluator.linearize(y, Curvature::Projected, g, h);
  const UnitFe unit = measure_unit_fe(b.problem.pattern(), h, g, arguments.repeat);
  const auto fe = [&](double seconds) { return seconds / unit.seconds; };
  row["unknowns"] = b.problem.size();
  row["unit_ms"] = 1e3 * unit.seconds;
  for (const UnitFe::Variant& v : unit.variants) row["variants"][v.name] = 1e3 * v.seconds;
  row["assembly_fe"] =
      fe(median_seconds(arguments, [&] { evaluator.linearize(y, Curvature::Projected, g, h); }));
  const auto solver = NewtonOptions().linear_solver();
  row["analysis_fe"] = fe(median_seconds(arguments, [&] { solver->analyze(b.problem.pattern()); }));
  solver->factorize(h, 0.0);
  row["factorization_fe"] = fe(median_seconds(arguments, [&] { solver->factorize(h, 0.0); }));
  row["solve_fe"] = fe(median_seconds(arguments, [&] { solver->solve(g, p); }));
  row["solver"] = solver->description();
  return unit.seconds;
}

struct Phases {
  double start = 0, setup = 0, iterations = 0, total = 0, within = 0;
};

// Relative accuracy at which tables compare programs, and the least tolerance that doubles allow.
constexpr double kWithin = 1e-4, kTight = 1e-11;

ParametrizationOptions run_options(const Arguments& arguments, int degree) {
  ParametrizationOptions options;
  options.map.degree = degree;
  options.solve.threads = arguments.threads;
  if (arguments.bijective) options.map.injectivity = MapInjectivity::Global;
  return options;
}

ParametrizationResult solve(const BenchProblem& b, const ParametrizationOptions& options,
                            const Arguments& arguments, RunRecord& record) {
  if (arguments.init == "auto") return parametrize(b.mesh, options, record);
  const double started = record.seconds();
  const BezierMap start = BezierMap::linear(b.mesh, tutte_map(*b.mesh));
  const double start_seconds = record.seconds() - started;
  ParametrizationResult result = parametrize(start, options, record);
  result.initialize_seconds = start_seconds;
  return result;
}

// The first time at which a run is within kWithin of its target energy.
struct Within {
  double reached = 0;
  int row = -1;  // row of the trace, from 0; -1: the start, or no row
  bool found = false;
};

Within find_within(const BenchProblem& b, ParametrizationOptions options,
                   const Arguments& arguments) {
  RunRecord record, tight;
  const ParametrizationResult result = solve(b, options, arguments, record);
  options.solve.tolerance = kTight;
  Within within;
  within.reached =
      std::min(result.value_quadrature, solve(b, options, arguments, tight).value_quadrature);
  const double enough = (1 + kWithin) * within.reached;
  within.found = options.map.degree == 1 && result.initial_value <= enough;
  for (std::size_t k = 0; k < record.trace().size() && !within.found; ++k) {
    const TraceEntry& row = record.trace()[k];
    within.found = row.level == 0 && row.degree == options.map.degree && row.energy <= enough;
    within.row = static_cast<int>(k);
  }
  return within;
}

// Returns the seconds of the phases. result: of the last run.
Phases time_run(const BenchProblem& b, const ParametrizationOptions& options,
                const Arguments& arguments, const Within& within, ParametrizationResult& result,
                std::vector<TraceEntry>& trace) {
  RunRecord record;
  const double cpu = cpu_seconds(), wall = wall_seconds();
  result = solve(b, options, arguments, record);
  const double all = wall_seconds() - wall, counted = all - result.measure_seconds;
  trace = record.trace();
  Phases p;
  p.start = result.initialize_seconds;
  for (const TraceEntry& entry : trace)
    if (entry.level == 0) p.iterations += entry.record.seconds.sum();
  p.setup = counted - p.start - p.iterations;
  p.total = counted;
  p.within = within.row < 0 ? p.start : trace[within.row].elapsed;
  const double factor = options.solve.threads == 1 ? (cpu_seconds() - cpu) / all : 1.0;
  return {factor * p.start, factor * p.setup, factor * p.iterations, factor * p.total,
          factor * p.within};
}

// Returns the number of factorizations on the input mesh.
int factorizations(const std::vector<TraceEntry>& trace) {
  int sum = 0;
  for (const TraceEntry& row : trace)
    if (row.level == 0) sum += row.record.factorizations;
  return sum;
}

void measure_runs(const BenchProblem& b, int degree, const Arguments& arguments, double unit,
                  nlohmann::ordered_json& row) {
  const ParametrizationOptions options = run_options(arguments, degree);
  ParametrizationResult result;
  std::vector<TraceEntry> trace;
  std::vector<Phases> runs;
  const Within within = find_within(b, options, arguments);
  for (int k = 0; k < arguments.repeat; ++k)
    runs.push_back(time_run(b, options, arguments, within, result, trace));
  std::sort(runs.begin(), runs.end(),
            [](const Phases& a, const Phases& c) { return a.total < c.total; });
  const Phases& middle = runs[runs.size() / 2];
  const int iterations = steps_taken(trace);
  row["iterations"] = iterations;
  row["factorizations"] = factorizations(trace);
  row["start_fe"] = middle.start / unit;
  row["setup_fe"] = middle.setup / unit;
  row["iterations_fe"] = middle.iterations / unit;
  row["total_fe"] = middle.total / unit;
  row["fe_per_iteration"] = middle.total / unit / std::max(1.0, static_cast<double>(iterations));
  row["energy"] = result.value_quadrature;
  row["status"] = status_name(result.status);
  std::sort(runs.begin(), runs.end(),
            [](const Phases& a, const Phases& c) { return a.within < c.within; });
  row["reached"] = within.reached;
  for (const char* key : {"within_fe", "within_iterations", "within_factorizations"})
    row[key] = nullptr;
  if (!within.found) return;
  trace.resize(to_size(within.row + 1));
  row["within_fe"] = runs[runs.size() / 2].within / unit;
  row["within_iterations"] = steps_taken(trace);
  row["within_factorizations"] = factorizations(trace);
}

void print_markdown(const nlohmann::ordered_json& row, bool first) {
  std::string head = "|", rule = "|", line = "|";
  for (const auto& [key, value] : row.items()) {
    if (key == "variants" || key == "solver") continue;
    head += " " + key + " |";
    rule += "---|";
    line += value.is_number_float() && key != "energy" && key != "reached"
                ? fmt::format(" {:.3f} |", value.get<double>())
                : fmt::format(" {} |", value.is_string() ? value.get<std::string>() : value.dump());
  }
  if (first) fmt::print("{}\n{}\n", head, rule);
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("What solving costs, in factorizations by CHOLMOD");
  app.add_option("meshes", arguments.meshes)->required();
  app.add_option("--degrees", arguments.degrees)->delimiter(',');
  app.add_option("--repeat", arguments.repeat)->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.threads)->check(CLI::PositiveNumber);
  app.add_flag("--json", arguments.json, "an array of rows, all figures unrounded");
  app.add_option("--init", arguments.init)->check(CLI::IsMember({"auto", "tutte"}));
  app.add_flag("--bijective", arguments.bijective, "runs without overlaps");
  app.add_flag("--no-runs", arguments.no_runs, "pieces of an iteration alone");
  CLI11_PARSE(app, argc, argv);
  const ThreadCount threads(arguments.threads);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const std::string& path : arguments.meshes)
    for (const int degree : arguments.degrees) {
      const BenchProblem b(path, degree);
      nlohmann::ordered_json row{{"mesh", path.substr(path.rfind('/') + 1)}, {"degree", degree}};
      const double unit = measure_pieces(b, arguments, row);
      if (!arguments.no_runs) measure_runs(b, degree, arguments, unit, row);
      if (!arguments.json) print_markdown(row, rows.empty());
      rows.push_back(std::move(row));
    }
  if (arguments.json) fmt::print("{}\n", rows.dump(2));
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
