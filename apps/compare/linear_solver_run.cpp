#include "apps/compare/linear_solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <memory>
#include <new>

#include "apps/plugins/plugin.h"
#include "majorant/apps/jobs/petsc_fallback.h"
#include "majorant/framework/error.h"
#include "majorant/framework/heap.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant::app {
namespace {

// The relative residual at which iterative solvers stop. Direct solvers ignore it.
constexpr double kResidual = 1e-8;

// Repetitions of a measurement fill this time: at least three, at most twenty.
constexpr double kMeasuredSeconds = 0.3;
constexpr std::size_t kFewest = 3, kMaximum = 20;

double cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double median_seconds(const Work& work) {
  std::vector<double> seconds;
  double all = 0;
  while (seconds.size() < kFewest || (all < kMeasuredSeconds && seconds.size() < kMaximum)) {
    const double before = cpu_seconds();
    work();
    seconds.push_back(cpu_seconds() - before);
    all += seconds.back();
  }
  std::nth_element(seconds.begin(), seconds.begin() + static_cast<long>(seconds.size() / 2),
                   seconds.end());
  return seconds[seconds.size() / 2];
}

// Measures by how much the peak memory of the process exceeds its memory at construction. 0 if
// Linux does not reset its peak (/proc/self/clear_refs).
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
  solver.hint_near_null_space(near_null_space_of_maps()(problem));
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
  run.solve_seconds = median_seconds([&] { solver.solve(r, p, kResidual); });
  run.memory_bytes = memory.bytes();
  run.residual = residual(pattern, hessian, p, r);
}

}  // namespace

std::vector<std::string> linear_solver_names() {
  return {"direct", "cholmod", "eigen", "mumps", "cg-hypre"};
}

std::shared_ptr<LinearSolver> linear_solver_named(const std::string& name) {
  if (name == "direct") return make_direct_solver();
  if (name == "eigen") return make_eigen_ldlt_solver();
  if (name == "cholmod") return load_plugin<CholmodPlugin>(kCholmodPlugin).make_solver();
  const PetscMethod method = name == "mumps" ? PetscMethod::Mumps : PetscMethod::Amg;
  return load_plugin<PetscPlugin>(kPetscPlugin)
      .fallback_chain({method, 0}, std::make_shared<FallbackRecord>(), {})();
}

std::function<Eigen::MatrixXd(const Problem&)> near_null_space_of_maps() {
  const SolverFactory some = [] { return make_direct_solver(); };
  return newton_options(Curvature::Projected, {}, {}, {}, some).near_null_space;  // as in runs
}

LinearSolverRun measure_linear_solver(const std::string& name, const Problem& problem,
                                      const Vec& y) {
  LinearSolverRun run;
  run.name = name;
  try {
    measure(*linear_solver_named(name), problem, y, run);
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

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
