// majorant compare IN: solves one problem with many methods.
//
// Every method minimizes the same Problem from the same start, with one quadrature rule. None gets
// what parametrize adds to Newton: a degree schedule, refined quadrature, remedies for stalls.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/compare/benchmark_problem.h"
#include "apps/compare/compare_request.h"
#include "apps/compare/linear_solver_run.h"
#include "apps/compare/methods.h"
#include "apps/compare/two_results.h"
#include "apps/energy_option.h"
#include "apps/map_request.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/process.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/framework/comparison/comparison_table.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "majorant/io/claims.h"
#include "majorant/io/io.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/pictures/write_comparison.h"

namespace majorant::app {
namespace {

// Only Ctrl-C stops this; the time limit is per method.
BenchmarkProblem make_benchmark(const CompareRequest& request, Run& run) {
  MapJob in(MapTask::Parametrize, run.record());
  read_input(request.map, in);
  const Vec initial = run.make("making the start of " + request.map.input, [&] {
    return initial_map(*in.mesh, in.options.map, run.start_stop());
  });
  const NormalizedStart start(BezierMap::linear(in.mesh, initial), in.options.map);
  BezierMap map = start.map();
  while (map.degree() < request.map.degree) map = map.elevated();
  BenchmarkProblem c;
  c.specification = start.specification();
  c.space = map.shared_space();
  c.rule = optimizer_quadrature(map.degree(), request.map.quadrature).guarded.front();
  c.injectivity =
      std::make_shared<const LocalInjectivity>(c.space, 2 * c.specification.rest->measure);
  c.start = map.control_points();
  c.problem = map_problem(c.specification, c.space, c.start,
                          energy_terms(c.specification, c.space, {c.rule}), c.injectivity)
                  .problem;
  if (!std::isfinite(Evaluator(c.problem).value(c.problem.reduce(c.start))))
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}: energy '{}' is infinite at the start; take another energy",
                            request.map.input, request.map.energy));
  return c;
}

// Measures them one after the other, on one thread.
std::vector<LinearSolverRun> measure_linear_solvers(const CompareRequest& request,
                                                    const BenchmarkProblem& benchmark) {
  const ThreadCount one(1);
  std::vector<LinearSolverRun> runs;
  for (const std::string& name : request.chosen_linear_solvers()) {
    if (interruption_flag()->load()) break;
    if (!request.common.quiet) say("{} ...\n", name);
    runs.push_back(
        measure_linear_solver(name, benchmark.problem, benchmark.problem.reduce(benchmark.start)));
  }
  return runs;
}

// Returns whether the libraries of a method can be loaded. Throws Error if the method is named and
// they cannot.
bool can_be_had(const Method& method, const CompareRequest& request) {
  if (!method.load) return true;
  try {
    method.load();
    return true;
  } catch (const Error& e) {
    const std::string why = fmt::format("method {}: {}", method.name, e.what());
    if (!request.methods.empty()) throw Error(e.kind(), why);
    if (!request.common.quiet) say_warnings({why});
    return false;
  }
}

// Returns the methods that fit the problem. Throws Error if one that does not fit is named.
std::vector<ComparisonMethod> choose(const CompareRequest& request,
                                     const BenchmarkProblem& benchmark) {
  std::vector<ComparisonMethod> chosen;
  for (const Method* m : request.chosen_methods()) {
    ComparisonMethod method = m->on(benchmark);
    const std::string why = method.obstacle({benchmark.problem});
    if (!why.empty() && !request.methods.empty())
      throw Error(ErrorKind::Usage, fmt::format("method {}: {}", m->name, why));
    if (why.empty() && can_be_had(*m, request)) chosen.push_back(std::move(method));
  }
  return chosen;
}

std::vector<MadeFile> files_of(const CompareRequest& request,
                               const std::shared_ptr<const Comparison>& comparison) {
  std::vector<MadeFile> files;
  for (const std::string& path : request.outputs) {
    if (extension(path) == ".csv")
      files.push_back({path, [=] { write_comparison_csv(path, *comparison); }});
    if (extension(path) == ".html")
      files.push_back({path, [=] { write_comparison_html(path, *comparison); }});
  }
  return files;
}

// Solves the problem by all methods, within the request's limits.
Comparison comparison_of(const CompareRequest& request, const BenchmarkProblem& benchmark,
                         const std::vector<ComparisonMethod>& chosen) {
  ComparisonOptions options = options_of(benchmark);
  options.title = fmt::format("{}, degree {}, {}, {} boundary, {} unknowns",
                              page_title(request.map.input), request.map.degree, request.map.energy,
                              request.map.boundary, benchmark.problem.size());
  options.time_limit_seconds = request.time_limit;
  options.tolerance = request.tolerance;
  options.stop = StopCheck([flag = interruption_flag()] {
    return flag->load(std::memory_order_relaxed) ? Directive::Interrupt : Directive::Continue;
  });
  const Vec y0 = benchmark.problem.reduce(benchmark.start);
  // A short run first: otherwise the first method would pay for starting threads and touching
  // memory.
  ComparisonOptions brief = options;
  brief.max_iterations = 2;
  compare(benchmark.problem, y0, {find_method("newton")->on(benchmark)}, brief);
  options.max_iterations = request.max_iterations;
  if (!request.common.quiet)
    options.begin = [](const ComparisonMethod& method) { say("{} ...\n", method.name); };
  return compare(benchmark.problem, y0, chosen, options);
}

Made compared(const CompareRequest& request, Run& run) {
  const BenchmarkProblem benchmark = make_benchmark(request, run);
  const std::vector<ComparisonMethod> chosen = choose(request, benchmark);
  run.record().begin(Activity::Solving);
  const std::vector<LinearSolverRun> solvers = measure_linear_solvers(request, benchmark);
  const bool is_printed = request.common.report != kStandardOutput;
  if (!solvers.empty() && is_printed) print_text(linear_solver_table(solvers) + "\n");
  const auto comparison =
      std::make_shared<const Comparison>(comparison_of(request, benchmark, chosen));
  Made made{.report = comparison_report(request, *comparison, solvers), .is_verdict_news = true};
  if (is_printed) made.verdict = comparison_table(*comparison);
  if (interruption_flag()->load()) made.report.status = "interrupted";
  made.files = files_of(request, comparison);
  return made;
}

int compare_methods(const CompareRequest& request) {
  request.chosen_methods();  // throws before anything is read
  request.chosen_linear_solvers();
  const RunPlan plan{.command = "compare",
                     .common = request.common,
                     .inputs = request.map.inputs(),
                     .outputs = {{request.outputs, {".csv", ".html", ".json"}}},
                     .stages = {},
                     .max_iterations = request.max_iterations,
                     .with_result = {Activity::Solving, Activity::Writing}};
  return run_verb(plan, [&](Run& run) { return compared(request, run); });
}

}  // namespace

void add_compare(CLI::App& app, Action* run) {
  auto request = std::make_shared<CompareRequest>();
  CompareRequest& r = *request;
  CLI::App& verb = *app.add_subcommand(
      "compare", "solve one problem with many methods, or show two results side by side");
  r.add_to(verb);
  std::string list = energy_help() + "Methods:\n";
  for (const Method& m : methods()) list += fmt::format("  {:<24} {}\n", m.name, m.summary);
  verb.footer(list +
              "Example: majorant compare bunny.obj --degree 2 --methods newton,lbfgs -o c.html");
  verb.callback([request, run, &verb] {
    request->require_fitting(verb);
    *run = [request] {
      if (!request->other.empty()) return compare_results(*request);
      request->map.choose_degree({});
      request->map.strictness = request->common.strictness();
      return compare_methods(*request);
    };
  });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
