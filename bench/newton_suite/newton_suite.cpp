// Newton's method and other methods on a suite of problems that are not maps (suite.h).
//
// Prints a row for each problem and method: unknowns and solved starts; iterations, factorizations,
// failed factorizations and trials of all starts together; CPU seconds on one thread; status and
// energy of unsolved starts. A start is solved if it has converged at a known minimum of table.cpp,
// or, if there is none, has failed within 60 steps. Methods for least squares skip other problems.
//
// --verify polishes the minima by exact Newton steps and compares each with the table: the energy
// to 11 digits, a gradient at rounding level, no direction of negative curvature, and the number of
// directions without curvature. Exit code 1 if one differs from the table.
//
// Sample runs:
//   build/release/bench/newton_suite --list
//   build/release/bench/newton_suite --csv suite.csv
//   build/release/bench/newton_suite --only solids --methods newton,newton-absolute --starts 3
//   build/release/bench/newton_suite --verify
#include <fmt/format.h>
#include <glog/logging.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/levenberg_marquardt.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/residual_term.h"
#include "suite.h"

using namespace majorant;
using namespace majorant::newton_suite;

namespace {

// ------------------------------------------------------------------ methods
using Run = std::function<SolveResult(const Problem&, const Vec& y0)>;

Run newton(Curvature curvature, double projection, bool blends) {
  NewtonOptions options;
  options.curvature = curvature;
  options.projection = projection;
  if (!blends) options.blend.below = 0;
  return [options](const Problem& problem, const Vec& y0) {
    return NewtonMinimizer(options).minimize(problem, y0, {});
  };
}

// Returns a run of Ceres with its default tolerances.
Run by_ceres(CeresOptions::Method method) {
  const CeresOptions options{
      .method = method, .function_tolerance = 1e-6, .parameter_tolerance = 1e-8};
  return [options](const Problem& problem, const Vec& y0) {
    return CeresMinimizer(options).minimize(problem, y0, {});
  };
}

// Returns whether the method can solve the problem: some methods need sums of squares.
bool is_for(const std::string& method, const Problem& problem) {
  if (method != "ceres-lm" && method != "ceres-dogleg") return true;
  return std::all_of(problem.terms().begin(), problem.terms().end(), [&](TermId id) {
    return dynamic_cast<const ResidualTerm*>(&problem.term(id)) != nullptr;
  });
}

const std::map<std::string, Run>& methods() {
  static const std::map<std::string, Run> all = {
      {"newton", [](const Problem& problem,
                    const Vec& y0) { return NewtonMinimizer().minimize(problem, y0, {}); }},
      {"newton-projected", newton(Curvature::Projected, 1, false)},
      {"newton-absolute", newton(Curvature::Projected, 2, true)},
      {"newton-adaptive",
       [](const Problem& problem, const Vec& y0) {
         NewtonOptions options;
         options.set_curvature(*curvature_choice("adaptive"));
         return NewtonMinimizer(options).minimize(problem, y0, {});
       }},
      {"newton-exact", newton(Curvature::Exact, 1, false)},
      {"levenberg-marquardt",
       [](const Problem& problem, const Vec& y0) {
         return LevenbergMarquardtMinimizer().minimize(problem, y0, {});
       }},
      {"lbfgs", [](const Problem& problem,
                   const Vec& y0) { return LbfgsMinimizer().minimize(problem, y0, {}); }},
      {"ceres-lbfgs", by_ceres(CeresOptions::Method::Lbfgs)},
      {"ceres-lm", by_ceres(CeresOptions::Method::LevenbergMarquardt)},
      {"ceres-dogleg", by_ceres(CeresOptions::Method::Dogleg)},
  };
  return all;
}

// ------------------------------------------------------------------ counts
struct Counts {
  int starts = 0, solved = 0, iterations = 0, factorizations = 0, failed = 0, trials = 0;
  double seconds = 0;
  std::map<std::string, int> failures;  // number of failures by status and energy

  void add(const Counts& other) {
    starts += other.starts;
    solved += other.solved;
    iterations += other.iterations;
    factorizations += other.factorizations;
    failed += other.failed;
    trials += other.trials;
    seconds += other.seconds;
    for (const auto& [what, count] : other.failures) failures[what] += count;
  }
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Counts counts_of(const SuiteProblem& problem, const SolveResult& result, double seconds) {
  Counts c;
  c.starts = 1;
  c.solved = problem.accepts(result);
  c.iterations = static_cast<int>(result.iterations.size());
  for (const IterationRecord& r : result.iterations) {
    c.factorizations += r.factorizations;
    c.failed += r.failed_factorizations;
    c.trials += r.trials;
  }
  c.seconds = seconds;
  if (!c.solved)
    c.failures[fmt::format("{} at {:.6g}", status_name(result.status), result.energy)] = 1;
  return c;
}

std::string row(const Counts& c) {
  std::string failures;
  for (const auto& [what, count] : c.failures)
    failures += fmt::format("{}{} {}", failures.empty() ? "" : ", ", count, what);
  return fmt::format("{} of {} | {} | {} | {} | {} | {:.2f} | {} |", c.solved, c.starts,
                     c.iterations, c.factorizations, c.failed, c.trials, c.seconds, failures);
}

// ------------------------------------------------------------------ verification
Eigen::MatrixXd dense(const SparsePattern& pattern, const Vec& values) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(pattern.size, pattern.size);
  for (Index c = 0; c < pattern.size; ++c)
    for (Index k = pattern.column_starts[to_size(c)]; k < pattern.column_starts[to_size(c) + 1];
         ++k)
      H(pattern.rows[to_size(k)], c) = H(c, pattern.rows[to_size(k)]) = values[k];
  return H;
}

// Eigenvalues below this fraction of the largest one count as 0.
constexpr double kNoCurvature = 1e-9;
// Relative accuracy of the energy and of the position of a polished minimum.
constexpr double kEnergyDigits = 1e-11;

struct Polished {
  double energy = std::numeric_limits<double>::infinity();
  double gradient = std::numeric_limits<double>::infinity();  // norm
  double displacement = 0;  // length of the next step, relative to |y| + 1
  double lowest = 0;        // least eigenvalue that is not 0, relative to the largest
  int nullity = 0;
};

// Takes exact Newton steps, orthogonal to directions without curvature, as long as the gradient
// falls and the energy does not rise.
Polished polish(const Problem& problem, Vec y) {
  constexpr int kMaxSteps = 60;
  Evaluator evaluator(problem);
  Vec gradient, hessian;
  Polished best;
  for (int k = 0; k < kMaxSteps; ++k) {
    Polished here;
    here.energy = evaluator.linearize(y, Curvature::Exact, gradient, hessian);
    here.gradient = gradient.norm();
    const bool rises = here.energy > best.energy + kEnergyTolerance * std::abs(best.energy);
    if (!(here.gradient < best.gradient) || rises) break;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense(problem.pattern(), hessian));
    const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
    here.lowest = std::numeric_limits<double>::infinity();
    Vec step = Vec::Zero(y.size());
    for (Index i = 0; i < y.size(); ++i) {
      const double value = eigen.eigenvalues()[i];
      if (std::abs(value) <= kNoCurvature * largest) {
        ++here.nullity;
        continue;
      }
      here.lowest = std::min(here.lowest, value / largest);
      const auto direction = eigen.eigenvectors().col(i);
      step -= direction * (direction.dot(gradient) / std::abs(value));
    }
    here.displacement = step.norm() / (y.norm() + 1);
    best = here;
    y += step;
    if (!std::isfinite(evaluator.value(y))) break;
  }
  return best;
}

// Returns the minimum of least gradient that runs from the starts reach.
std::optional<Polished> find(const SuiteProblem& problem, const SuiteInstance& instance,
                             double minimum) {
  std::optional<Polished> best;
  for (const char* method : {"newton", "newton-absolute", "newton-exact", "levenberg-marquardt"})
    for (const Vec& start : instance.starts) {
      if (best && best->displacement <= kEnergyDigits) return best;
      const SolveResult result = methods().at(method)(instance.problem, start);
      const double* reached = problem.minimum_at(result.energy);
      if (!reached || *reached != minimum) continue;
      const Polished polished = polish(instance.problem, result.y);
      if (!best || polished.gradient < best->gradient) best = polished;
    }
  return best;
}

// Returns the defect of a minimum of the table; empty if there is none.
std::string fault(const SuiteProblem& problem, double minimum, const std::optional<Polished>& p) {
  constexpr double kZero = 1e-15;
  if (!p) return "no run reaches it";
  const double tolerance = minimum == 0 ? kZero : kEnergyDigits * std::abs(minimum);
  if (std::abs(p->energy - minimum) > tolerance)
    return fmt::format("its energy is {:.13g}", p->energy);
  if (p->displacement > 1e-6) return fmt::format("steps are still {:.1e}", p->displacement);
  if (p->lowest < 0) return fmt::format("an eigenvalue is {:.1e} of the largest", p->lowest);
  if (!problem.is_singular && p->nullity != problem.nullity)
    return fmt::format("{} directions have no curvature, {} said", p->nullity, problem.nullity);
  return "";
}

bool verify(const SuiteProblem& problem) {
  const SuiteInstance instance = problem.make();
  bool all = true;
  for (const double minimum : problem.minima) {
    const std::optional<Polished> found = find(problem, instance, minimum);
    const std::string why = fault(problem, minimum, found);
    all = all && why.empty();
    const Polished p = found.value_or(Polished());
    fmt::print("| {} | {:.12g} | {:.1e} | {:.1e} | {:.1e} | {} | {} |\n", problem.name, minimum,
               p.energy - minimum, p.gradient, p.lowest, p.nullity, why.empty() ? "yes" : why);
    std::fflush(stdout);
  }
  return all;
}

// ------------------------------------------------------------------ runs
struct Arguments {
  std::vector<std::string> methods{"newton"};
  std::string only, csv;
  int starts = std::numeric_limits<int>::max();
  bool list = false, verify = false;
};

Counts run(const SuiteProblem& problem, const SuiteInstance& instance, const std::string& method,
           const Arguments& arguments, std::ofstream& csv) {
  Counts all;
  for (std::size_t k = 0; k < instance.starts.size() && static_cast<int>(k) < arguments.starts;
       ++k) {
    const double begin = cpu_seconds();
    const SolveResult result = methods().at(method)(instance.problem, instance.starts[k]);
    const Counts c = counts_of(problem, result, cpu_seconds() - begin);
    all.add(c);
    if (csv.is_open())
      csv << fmt::format("\"{}\",{},{},{},{},{:.13g},{},{},{},{},{:.4f}\n", problem.name, k, method,
                         status_name(result.status), c.solved, result.energy, c.iterations,
                         c.factorizations, c.failed, c.trials, c.seconds);
  }
  return all;
}

void run_all(const std::vector<SuiteProblem>& problems, const Arguments& arguments) {
  std::ofstream csv;
  if (!arguments.csv.empty()) {
    csv.open(arguments.csv);
    csv << "problem,start,method,status,solved,energy,iterations,factorizations,failed,trials,"
           "seconds\n";
    if (!csv) throw std::runtime_error(arguments.csv + ": cannot be written");
  }
  std::map<std::string, Counts> sums;
  fmt::print(
      "| problem | unknowns | method | solved | iterations | factorizations | failed | "
      "trials | s | not solved |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const SuiteProblem& problem : problems) {
    const SuiteInstance instance = problem.make();
    for (const std::string& method : arguments.methods) {
      if (!is_for(method, instance.problem)) continue;
      Counts c = run(problem, instance, method, arguments, csv);
      fmt::print("| {} | {} | {} | {}\n", problem.name, instance.problem.size(), method, row(c));
      std::fflush(stdout);
      c.failures.clear();
      sums[method].add(c);
    }
  }
  for (const std::string& method : arguments.methods)
    fmt::print("| all | | {} | {}\n", method, row(sums[method]));
}

// Returns the problems whose name or family contains the pattern. Throws std::runtime_error if
// there are none.
std::vector<SuiteProblem> chosen(const std::string& pattern) {
  std::vector<SuiteProblem> problems;
  const std::regex regex(pattern);
  for (const SuiteProblem& problem : majorant::newton_suite::newton_suite())
    if (std::regex_search(problem.name, regex) || std::regex_search(problem.family, regex))
      problems.push_back(problem);
  if (problems.empty()) throw std::runtime_error("--only " + pattern + ": no such problem");
  return problems;
}

std::string joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double x : numbers) text += fmt::format("{}{:.12g}", text.empty() ? "" : ", ", x);
  return text;
}

int main_of(const Arguments& arguments) {
  for (const std::string& method : arguments.methods)
    if (!methods().contains(method))
      throw std::runtime_error("--methods " + method + ": no such method, see --help");
  const std::vector<SuiteProblem> problems = chosen(arguments.only);
  const ThreadCount one(1);
  FLAGS_minloglevel = google::GLOG_FATAL;
  bool all = true;
  if (arguments.list) {
    fmt::print("| problem | family | source | minima |\n|---|---|---|---|\n");
    for (const SuiteProblem& p : problems)
      fmt::print("| {} | {} | {} | {} |\n", p.name, p.family, p.source, joined(p.minima));
  } else if (arguments.verify) {
    fmt::print(
        "| problem | minimum | off by | gradient | lowest | without curvature | holds |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const SuiteProblem& problem : problems) all = verify(problem) && all;
  } else {
    run_all(problems, arguments);
  }
  return all ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  std::string names;
  for (const auto& [name, method] : methods()) names += " " + name;
  CLI::App app("Newton's method on problems that are no maps");
  app.add_option("--only", arguments.only, "a regular expression: problems and families");
  app.add_option("--methods", arguments.methods, "some of" + names)->delimiter(',');
  app.add_option("--starts", arguments.starts, "of each problem, at most")
      ->check(CLI::PositiveNumber);
  app.add_option("--csv", arguments.csv, "a file: a line for each run");
  app.add_flag("--list", arguments.list, "names, sources and minima");
  app.add_flag("--verify", arguments.verify, "are the minima of the table minima?");
  CLI11_PARSE(app, argc, argv);
  try {
    return main_of(arguments);
  } catch (const std::exception& e) {
    fmt::print(stderr, "newton_suite: {}\n", e.what());
    return 1;
  }
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
