// majorant compare IN: one problem, many methods.
//
// Every method minimizes the same Problem from the same start, on one quadrature rule, without the
// help that parametrize gives Newton (degree schedule, refined quadrature, ways out of
// stalls).
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/command.h"
#include "apps/compare/comparison_table.h"
#include "apps/compare/matched_maps.h"
#include "apps/compare/methods.h"
#include "apps/compare/write_comparison.h"
#include "apps/energy_option.h"
#include "apps/map_request.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/plugins/plugin.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/certify/map_proof.h"
#include "majorant/framework/available_resources.h"
#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/io/claims.h"
#include "majorant/io/io.h"
#include "majorant/io/waiting_output.h"
#include "majorant/parametrization/maps/quadrature_ladder.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/parametrization/solve/solver_rules.h"
#include "majorant/results/report.h"
#include "majorant/results/solver_ladder.h"

namespace majorant::app {
namespace {

// `majorant compare --linear-solvers`: what solves Newton's systems, each on the same matrix, the
// projected Hessian at the start, and its gradient.
//
//   std::vector<LinearSolverRun> runs;
//   for (const std::string& name : linear_solver_names())
//     runs.push_back(measure_linear_solver(name, problem, y0));
//   std::cout << linear_solver_table(runs);

struct LinearSolverRun {
  std::string name;
  std::string description;  // LinearSolver::description()
  std::string message;      // why there is nothing else: it cannot be loaded, or it failed
  // Seconds of the processor, all threads: the median of several repetitions.
  double analyze_seconds = 0, factorize_seconds = 0, solve_seconds = 0;
  std::size_t memory_bytes = 0;  // that the process had at most beyond what it had before
  double residual = 0;           // |H p + g| / |g|
};

// The residual asked of iterative solvers; direct ones do not look at it.
constexpr double kAskedResidual = 1e-8;

// A measurement repeats as often as fits into this, three times at least, twenty at most.
constexpr double kMeasuredSeconds = 0.3;
constexpr std::size_t kFewest = 3, kMost = 20;

double cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double median_seconds(const Work& work) {
  std::vector<double> seconds;
  double all = 0;
  while (seconds.size() < kFewest || (all < kMeasuredSeconds && seconds.size() < kMost)) {
    const double before = cpu_seconds();
    work();
    seconds.push_back(cpu_seconds() - before);
    all += seconds.back();
  }
  std::nth_element(seconds.begin(), seconds.begin() + static_cast<long>(seconds.size() / 2),
                   seconds.end());
  return seconds[seconds.size() / 2];
}

// The most resident memory of the process since this was made, beyond what it had then; 0 where
// Linux does not reset its count (/proc/self/clear_refs).
class MemoryPeak {
 public:
  MemoryPeak() {
    release_free_memory();
    std::ofstream("/proc/self/clear_refs") << "5";
    before_ = status("VmHWM:");
  }
  std::size_t bytes() const { return status("VmHWM:") - before_; }

 private:
  static std::size_t status(const std::string& name) {
    std::ifstream file("/proc/self/status");
    std::string word;
    std::size_t kib = 0;
    while (file >> word)
      if (word == name) file >> kib;
    return 1024 * kib;
  }
  std::size_t before_;
};

std::shared_ptr<LinearSolver> make(const std::string& name) {
  if (name == "direct") return make_direct_solver();
  if (name == "eigen") return make_eigen_ldlt_solver();
  if (name == "cholmod") return load_plugin<CholmodPlugin>(kCholmodPlugin).make_solver();
  const Rung rung = name == "mumps" ? Rung::Mumps : Rung::Amg;
  return load_plugin<PetscPlugin>(kPetscPlugin)
      .ladder({rung, 0}, std::make_shared<LadderRecord>(), {})();
}

double residual(const SparsePattern& pattern, const Vec& values, const Vec& p, const Vec& r) {
  Vec rest = r;
  for (Index c = 0; c < pattern.size; ++c)
    for (Index k = pattern.column_starts[c]; k < pattern.column_starts[c + 1]; ++k) {
      const Index row = pattern.rows[k];
      rest[row] -= values[k] * p[c];
      if (row != c) rest[c] -= values[k] * p[row];
    }
  return rest.norm() / r.norm();
}

void measure(LinearSolver& solver, const Problem& problem, const Vec& y, LinearSolverRun& run) {
  Vec gradient, hessian, p;
  Evaluator(problem).linearize(y, Curvature::Projected, gradient, hessian);
  const SparsePattern& pattern = problem.pattern();
  const MemoryPeak memory;
  // For multigrid; as runs say it.
  const SolverFactory some = [] { return make_direct_solver(); };
  solver.hint_near_null_space(
      newton_options(Curvature::Projected, {}, {}, Ordering::Automatic, some)
          .near_null_space(problem));
  const double before = cpu_seconds();
  solver.analyze(pattern);
  run.analyze_seconds = cpu_seconds() - before;
  run.description = solver.description();
  const ShiftedFactorization first = factorize_shifted(solver, pattern, hessian);
  if (first.status != FactorStatus::Ok) throw Error(ErrorKind::Invalid, "not positive definite");
  if (first.shift > 0)
    for (Index c = 0; c < pattern.size; ++c) hessian[pattern.diagonal_slot(c)] += first.shift;
  run.factorize_seconds = median_seconds([&] { solver.factorize(hessian, 0); });
  const Vec r = -gradient;
  run.solve_seconds = median_seconds([&] { solver.solve(r, p, kAskedResidual); });
  run.memory_bytes = memory.bytes();
  run.residual = residual(pattern, hessian, p, r);
}

// as --linear-solver has them, and "eigen"
std::vector<std::string> linear_solver_names() {
  return {"direct", "cholmod", "eigen", "mumps", "cg-hypre"};
}

LinearSolverRun measure_linear_solver(const std::string& name, const Problem& problem,
                                      const Vec& y) {
  LinearSolverRun run;
  run.name = name;
  try {
    measure(*make(name), problem, y, run);
  } catch (const Error& e) {
    run.message = e.what();
  } catch (const std::bad_alloc&) {
    run.message = "out of memory";
  }
  return run;
}

std::string linear_solver_table(const std::vector<LinearSolverRun>& runs) {
  std::string text = fmt::format("{:<13}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {}\n", "linear solver",
                                 "analyze s", "factor s", "solve s", "memory MB", "residual", "");
  for (const LinearSolverRun& run : runs)
    text += !run.message.empty()
                ? fmt::format("{:<13}  {}\n", run.name, run.message)
                : fmt::format("{:<13}  {:>9.3g}  {:>9.3g}  {:>9.3g}  {:>9.4g}  {:>9.1e}  {}\n",
                              run.name, run.analyze_seconds, run.factorize_seconds,
                              run.solve_seconds, static_cast<double>(run.memory_bytes) / 1e6,
                              run.residual, run.description);
  return text;
}

struct CompareRequest {
  CommonOptions common;
  MapRequest map;
  std::string other;  // a second result, or empty
  std::vector<std::string> outputs, methods, linear_solvers;
  FormatOptions formats;
  int max_iterations = Contest().max_iterations;
  double tolerance = Contest().tolerance, time_limit = 60;
};

// Every point of a run measured in the same way, whatever the method says of itself. The clock
// stands still while measuring.
class PointMeter final : public RunObserver {
 public:
  PointMeter(const Contest& contest, double time_limit)
      : evaluator_(contest.problem),
        injectivity_(contest.space, 2 * contest.specification.rest->measure),
        vertices_(contest.space, AngleSums::Vertices::Interior),
        time_limit_(time_limit) {}

  void start(const Vec& y) {
    measure(0, 0, 0, y);
    resumed_ = Clock::now();
  }
  Directive after_step(const TraceEntry& row, const Vec& y) override {
    running_ += seconds_since(resumed_);
    measure(row.record.iteration, running_, row.record.step, y);
    resumed_ = Clock::now();
    if (interrupted_->load()) return Directive::Interrupt;
    return running_ > time_limit_ ? Directive::TimeLimit : Directive::Continue;
  }
  // For what happens between two points. Only refers.
  StopCheck stop() const {
    return StopCheck([this] {
      if (interrupted_->load(std::memory_order_relaxed)) return Directive::Interrupt;
      const double now = seconds_since(resumed_);
      return running_ + now > time_limit_ ? Directive::TimeLimit : Directive::Continue;
    });
  }
  std::vector<ComparisonPoint> take_points() { return std::move(points_); }

 private:
  using Clock = std::chrono::steady_clock;
  void measure(int iteration, double seconds, double step, const Vec& y) {
    Vec gradient;
    const Vec x = evaluator_.problem().expand(y);
    const double min_det = injectivity_.lower_bounds(x).minCoeff();
    // A map that is not certified is no result: it must not become the best.
    const bool valid = min_det > 0 && vertices_.check(x).feasible;
    using Limits = std::numeric_limits<double>;
    const double energy = valid ? evaluator_.gradient(y, gradient) : Limits::infinity();
    const double norm = std::isfinite(energy) ? gradient.norm() : Limits::quiet_NaN();
    points_.push_back({iteration, seconds, energy, norm, step, min_det});
  }
  Evaluator evaluator_;
  LocalInjectivity injectivity_;
  AngleSums vertices_;  // methods that certify no paths might wind twice around a vertex
  const std::atomic<bool>* interrupted_ = interruption_flag();
  double time_limit_, running_ = 0;
  Clock::time_point resumed_;
  std::vector<ComparisonPoint> points_;
};

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

// Under Ctrl-C alone: the time limit is that of the methods.
Contest make_contest(const CompareRequest& request) {
  RunRecord limits(std::numeric_limits<double>::infinity(), request.max_iterations,
                   interruption_flag());
  set_output_stop(limits.stop());
  MapJob in(MapTask::Parametrize, limits);
  read_input(request.map, in);
  const Vec initial = or_interrupted("making the start of " + request.map.input, [&] {
    return initial_map(*in.mesh, in.options.map, limits.start_stop());
  });
  const NormalizedStart start(BezierMap::linear(in.mesh, initial), in.options.map);
  BezierMap map = start.map();
  while (map.degree() < request.map.degree) map = map.elevated();
  Contest c;
  c.specification = start.specification();
  c.energy = request.map.energy;
  c.space = map.shared_space();
  c.rule = optimizer_ladder(map.degree(), request.map.quadrature).guarded.front();
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
  c.tolerance = request.tolerance;
  c.max_iterations = request.max_iterations;
  return c;
}

// The methods asked for, each once; all of them without a wish.
std::vector<const Method*> wanted_methods(const CompareRequest& request) {
  std::vector<const Method*> wanted;
  for (std::string name : request.methods) {
    std::erase(name, ' ');
    const Method* m = find_method(name);
    if (!m) {
      std::vector<std::string> names;
      for (const Method& known : methods()) names.push_back(known.name);
      throw Error(ErrorKind::Usage, fmt::format("no method is called '{}'{}; use {}", name,
                                                did_you_mean(name, names), fmt::join(names, ", ")));
    }
    if (std::find(wanted.begin(), wanted.end(), m) == wanted.end()) wanted.push_back(m);
  }
  if (wanted.empty() && !request.linear_solvers.empty()) wanted.push_back(find_method("newton"));
  if (wanted.empty())
    for (const Method& m : methods()) wanted.push_back(&m);
  return wanted;
}

std::vector<std::string> wanted_linear_solvers(const CompareRequest& request) {
  const std::vector<std::string> names = linear_solver_names();
  std::vector<std::string> wanted;
  for (std::string name : request.linear_solvers) {
    std::erase(name, ' ');
    if (name == "all") return names;
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(ErrorKind::Usage,
                  fmt::format("--linear-solvers: there is no {}{}; use all, or {}", name,
                              did_you_mean(name, names), fmt::join(names, ", ")));
    wanted.push_back(name);
  }
  return wanted;
}

// One after the other, on one thread.
std::vector<LinearSolverRun> measure_linear_solvers(const CompareRequest& request,
                                                    const Contest& contest) {
  const ThreadCount one(1);
  std::vector<LinearSolverRun> runs;
  for (const std::string& name : wanted_linear_solvers(request)) {
    if (interruption_flag()->load()) break;
    if (!request.common.quiet) say("{} ...\n", name);
    runs.push_back(
        measure_linear_solver(name, contest.problem, contest.problem.reduce(contest.start)));
  }
  return runs;
}

// Returns whether what the method needs can be loaded; asked for by name it must.
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

// Without those that the contest is not for; asked for by name, that is an error.
std::vector<const Method*> choose(const CompareRequest& request, const Contest& contest) {
  std::vector<const Method*> chosen;
  for (const Method* m : wanted_methods(request)) {
    const std::string why = m->obstacle ? m->obstacle(contest) : std::string();
    if (!why.empty() && !request.methods.empty())
      throw Error(ErrorKind::Usage, fmt::format("method {}: {}", m->name, why));
    if (why.empty() && can_be_had(*m, request)) chosen.push_back(m);
  }
  return chosen;
}

MethodRun race(const Method& method, const Contest& contest, double time_limit) {
  const Vec y0 = contest.problem.reduce(contest.start);
  PointMeter watch(contest, time_limit);
  Contest timed = contest;
  timed.stop = watch.stop();
  const std::unique_ptr<Minimizer> minimizer = method.make(timed);
  watch.start(y0);
  const SolveResult result = minimizer->minimize(contest.problem, y0, &watch);
  const std::string message = result.status == Status::Converged ? "" : result.message;
  return {method.name, std::string(status_name(result.status)), message, watch.take_points()};
}

// The first method would pay for waking threads and touching memory.
void warm_up(const Contest& contest) {
  Contest short_contest = contest;
  short_contest.max_iterations = 2;
  find_method("newton")
      ->make(short_contest)
      ->minimize(contest.problem, contest.problem.reduce(contest.start), {});
}

Json linear_solvers_section(const std::vector<LinearSolverRun>& runs) {
  Json rows = Json::array();
  for (const LinearSolverRun& run : runs)
    rows.push_back({{"name", run.name},
                    {"description", run.description},
                    {"message", run.message},
                    {"analyze_seconds", run.analyze_seconds},
                    {"factorize_seconds", run.factorize_seconds},
                    {"solve_seconds", run.solve_seconds},
                    {"memory_bytes", run.memory_bytes},
                    {"residual", run.residual}});
  return rows;
}

Json report_of(const CompareRequest& request, const Comparison& comparison,
               const std::vector<LinearSolverRun>& solvers) {
  Json options = request.map.to_json();
  options.erase("curvature");  // part of the methods' names
  options["tolerance"] = request.tolerance;
  options["max_iterations"] = request.max_iterations;
  options["time_limit"] = request.time_limit;
  options["strict"] = request.common.strict;
  const double best = comparison.best_energy();
  Json runs = Json::array();
  for (const MethodRun& run : comparison.runs) {
    Json within = Json::object();
    for (const auto& [key, fraction] : {std::pair("0.01", 0.01), {"0.0001", 0.0001}})
      if (const ComparisonPoint* p = first_within(run, best, fraction))
        within[key] = {{"iterations", p->iteration}, {"seconds", p->seconds}};
      else
        within[key] = nullptr;
    runs.push_back({{"method", run.method},
                    {"status", run.status},
                    {"message", run.message},
                    {"iterations", run.points.back().iteration},
                    {"seconds", run.points.back().seconds},
                    {"energy", run.points.back().energy},
                    {"gradient_norm", run.points.back().gradient_norm},
                    {"min_det", run.points.back().min_det},
                    {"within", within}});
  }
  Json report{{"schema_version", 1},           {"version", MAJORANT_VERSION},
              {"command", "compare"},          {"title", comparison.title},
              {"machine", comparison.machine}, {"options", options},
              {"best_energy", best},           {"methods", runs}};
  if (!solvers.empty()) report["linear_solvers"] = linear_solvers_section(solvers);
  return report;
}

WrittenFiles write(const CompareRequest& request, const Comparison& comparison,
                   const std::vector<LinearSolverRun>& solvers) {
  WrittenFiles written;
  std::vector<std::string> paths = request.outputs;
  if (!request.common.report.empty()) paths.push_back(request.common.report);
  for (const std::string& path : paths)
    written.write(path, [&] {
      if (extension(path) == ".csv") write_comparison_csv(path, comparison);
      if (extension(path) == ".html") write_comparison_html(path, comparison);
      if (extension(path) == ".json" || path == kStandardOutput)
        write_json(path, report_of(request, comparison, solvers));
    });
  return written;
}

int compare(const CompareRequest& request) {
  require_writable(request.common, {{request.outputs, {".csv", ".html", ".json"}}},
                   request.map.inputs());
  if (!(request.time_limit >= 0) || !(request.tolerance > 0))
    throw Error(ErrorKind::Usage, "--time-limit and --tolerance must be numbers");
  wanted_methods(request);  // complains before anything is read
  wanted_linear_solvers(request);
  interruption_flag();
  const ThreadCount threads(usable_threads(request.common.threads));
  const Contest contest = make_contest(request);
  const std::vector<const Method*> chosen = choose(request, contest);
  Comparison comparison;
  comparison.title = fmt::format("{}, degree {}, {}, {} boundary, {} unknowns",
                                 page_title(request.map.input), request.map.degree,
                                 request.map.energy, request.map.boundary, contest.problem.size());
  comparison.machine =
      fmt::format("{}, {}", processor(), count_text(ThreadCount::current(), "thread"));
  const std::vector<LinearSolverRun> solvers = measure_linear_solvers(request, contest);
  if (!solvers.empty() && request.common.report != kStandardOutput)
    print_text(linear_solver_table(solvers) + "\n");
  warm_up(contest);
  for (const Method* method : chosen) {
    if (!request.common.quiet) say("{} ...\n", method->name);
    comparison.runs.push_back(race(*method, contest, request.time_limit));
    if (interruption_flag()->load()) break;
  }
  if (request.common.report != kStandardOutput) print_text(comparison_table(comparison));
  return write(request, comparison, solvers)
      .conclude(interruption_flag()->load() ? kLimit : kSuccess);
}

// Throws Error(Usage) for an option that says how a problem is solved.
void require_no_problem(const CLI::App& verb) {
  const std::set<std::string> usable{"output", "threads", "quiet",       "verbose",
                                     "strict", "force",   "color-range", "color-by",
                                     "size",   "edges",   "legend",      "transparent"};
  for (const CLI::Option* option : verb.get_options())
    if (option->count() > 0 && !option->get_positional() &&
        usable.count(option->get_single_name()) == 0)
      throw Error(ErrorKind::Usage,
                  fmt::format("--{} is of one problem solved with many methods; leave it out to "
                              "compare two results, or leave out the second one",
                              option->get_single_name()));
}

// Pages hold a number a control point; the claims say what the file is.
MapPage page_of(const std::string& path, const MapFile& map) {
  MapPage page;
  page.title = page_title(path);
  page.map = map;
  page.points = claimed_points(parse_claims(map.claims, path), map);
  return page;
}

// compare A.vtu B.vtu -o AB.html -o AB.svg.
int compare_results(const CompareRequest& request) {
  const std::vector<std::string> extensions{".html", ".svg"};
  require_some_output(request.outputs, extensions);
  require_writable(request.common, {{request.outputs, extensions}},
                   {request.map.input, request.other});
  request.formats.require_effect(request.outputs);
  const auto read = [&](const std::string& path) {
    return within_memory(path, [&] { return read_map(path, {}, request.common.strictness()); });
  };
  const MapFile map = read(request.map.input);
  MapPage page = page_of(request.map.input, map);
  page.quantity = request.formats.svg.quantity;
  page.color_range = request.formats.svg.color_range;
  page.other = std::make_shared<MapPage>(page_of(
      request.other, matched_to(map, request.map.input, read(request.other), request.other)));
  WrittenFiles written;
  for (const std::string& path : request.outputs)
    written.write(path, [&] {
      if (extension(path) == ".html") return write_page(path, page);
      const auto captioned = [](const MapPage& of) {
        return CaptionedMap{of.map, of.title, of.points};
      };
      write_svg(path, MapPair{captioned(page), captioned(*page.other)}, request.formats.svg);
    });
  if (!request.common.quiet) written.say_sizes();
  return written.conclude(kSuccess);
}

}  // namespace

void add_compare(CLI::App& app, Action* run) {
  auto request = std::make_shared<CompareRequest>();
  CompareRequest& r = *request;
  CLI::App& verb = *app.add_subcommand(
      "compare", "solve one problem with many methods, or show two results side by side");
  r.map.add_to(verb, "3");
  r.map.init = "tutte";  // far enough from the minimum to compare the ways there
  r.map.add_start_to(verb);
  begin_group(verb, OptionGroup::Files);
  const CLI::Option* other =
      verb.add_option("other", r.other,
                      "a second result: the first one is a result of the same surface, too, and "
                      "-o OUT.html shows both with the difference of their densities, -o OUT.svg "
                      "both layouts, for a figure");
  r.formats.add_drawing_to(verb);
  begin_group(verb, OptionGroup::Solver);
  verb.add_option("--methods", r.methods, "names, comma separated (all that fit the energy)")
      ->type_name("NAMES")
      ->delimiter(',');
  verb.add_option("--linear-solvers", r.linear_solvers,
                  "also a table of what solves Newton's systems, on the first one: all, or names, "
                  "comma separated (" +
                      fmt::format("{}", fmt::join(linear_solver_names(), ", ")) + ")")
      ->type_name("NAMES")
      ->delimiter(',');
  begin_group(verb, OptionGroup::Files);
  verb.add_option("-o,--output", r.outputs,
                  "output: .csv .html .json, of two results .html .svg, repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  begin_group(verb, OptionGroup::Solver);
  verb.add_option("--tolerance", r.tolerance,
                  fmt::format("relative decrease that ends Newton ({})", r.tolerance))
      ->check(positive_number());
  verb.add_option("--max-iterations", r.max_iterations,
                  fmt::format("of each method ({})", r.max_iterations))
      ->check(whole_number(0));
  verb.add_option("--time-limit", r.time_limit,
                  fmt::format("seconds for each method ({})", r.time_limit))
      ->check(non_negative_number());
  r.common.add_to(verb);
  std::string list = energy_help() + "Methods:\n";
  for (const Method& m : methods()) list += fmt::format("  {:<24} {}\n", m.name, m.summary);
  verb.footer(list +
              "Example: majorant compare bunny.obj --degree 2 --methods newton,lbfgs -o c.html");
  verb.callback([request, run, other, &verb] {
    if (other->count() > 0) require_no_problem(verb);
    if (const std::string option = request->formats.first_given();
        other->count() == 0 && !option.empty())
      throw Error(ErrorKind::Usage, fmt::format("{} is of two results side by side; add the second "
                                                "one, or leave it out",
                                                option));
    *run = [request] {
      if (!request->other.empty()) return compare_results(*request);
      request->map.choose_degree({});
      request->map.strictness = request->common.strictness();
      return compare(*request);
    };
  });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
