// Measures derivatives of solutions. The unit is a Newton step of the same problem: exact gradient
// and Hessian, factorization, solve, energy of the next point. Times are CPU seconds on one thread,
// medians of --repeat.
//
//     analysis      analysis of the pattern alone, with AMD's ordering
//     make          Sensitivity of a solution that is accurate to the last digits, with an analysis
//     with_solver   make with the solver of the minimization, whose ordering is reused
//     polished      make for a solution of default options, which is polished first
//     b, first_b    forward() by right-hand sides, and its first call
//     data, first_data    forward() by data of the first term
//     adjoint, first_adjoint    adjoint() by all data
//     rest, first_rest    forward and adjoint by rest positions together; making RestSensitivity
//
// Sample run:
//   build/release/bench/sensitivities --repeat 7
#include <fmt/format.h>
#include <time.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/rest_sensitivity.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/local_term.h"

using namespace majorant;

namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const std::function<void()>& f) {
  const double started = processor_seconds();
  f();
  return processor_seconds() - started;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Subject {
  std::string name;
  Problem problem;
  Vec start;                // reduced unknowns
  std::optional<Vec> data;  // data of the first term
  RowMatrix positions = {};
  Cells cells = {};
};

// Returns a hanging net of springs whose lengths are data: one list for all springs, or a row each.
Subject net(Index n, bool rows) {
  Cells edges(2 * n * (n - 1), 2);
  Index e = 0;
  for (Index k = 0; k < n * n; ++k) {
    if (k % n + 1 < n) edges.row(e++) << k, k + 1;
    if (k / n + 1 < n) edges.row(e++) << k, k + n;
  }
  const auto spring = [](const auto& z, double length) {
    const auto stretch = (z.col(1) - z.col(0)).squaredNorm() / (length * length) - 1.0;
    return stretch * stretch;
  };
  const Vec lengths = Vec::Constant(edges.rows(), 0.9);
  const auto term =
      rows ? make_term<2, 3>(
                 "net", edges, [=](Index, const auto& z, const auto& l) { return spring(z, l[0]); },
                 RowMatrix(lengths))
           : make_term<2, 3>(
                 "net", edges,
                 [=](Index i, const auto& z, const auto& l) { return spring(z, l[i]); }, lengths);
  Vec load = Vec::Zero(3 * n * n), x(3 * n * n);
  std::vector<FixedPoint3> held;
  for (Index k = 0; k < n * n; ++k) {
    load[3 * k + 2] = 0.01;
    x.segment<3>(3 * k) << k % n, k / n, 0;
    if (k % n == 0 || k % n == n - 1) held.push_back({k, x.segment<3>(3 * k)});
  }
  ProblemBuilder builder(3 * n * n);
  builder.add(term, 1).add(linear_term("load", load), 1);
  builder.add(FixedPoints::in_space(held));
  const Problem problem = builder.build();
  return {rows ? "net, lengths in rows" : "net, lengths in a list", problem, problem.reduce(x),
          lengths};
}

// Returns a bumpy sheet that is flattened with two pins.
Subject flattening(Index n) {
  RowMatrix p(n * n, 3);
  Vec x(2 * n * n);
  for (Index k = 0; k < n * n; ++k) {
    const double u = static_cast<double>(k % n) / (n - 1), v = static_cast<double>(k / n) / (n - 1);
    p.row(k) << u, v, 0.2 * std::sin(5 * u + 1) * std::cos(4 * v);
    x.segment<2>(2 * k) << u, v;
  }
  Cells faces(2 * (n - 1) * (n - 1), 3);
  Index t = 0;
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = i + n * j;
      faces.row(t++) << a, a + 1, a + n + 1;
      faces.row(t++) << a, a + n + 1, a + n;
    }
  const auto space = std::make_shared<const BezierTriangleSpace>(faces, n * n, 1);
  ProblemBuilder builder(2 * n * n);
  builder.add(symmetric_dirichlet()(space, flat_simplices(p, faces)), 1);
  builder.add(FixedPoints({{0, {0, 0}}, {n - 1, {1.1, 0}}}));
  const Problem problem = builder.build();
  x[2 * n - 2] = 1.1;
  return {"flattening", problem, problem.reduce(x), {}, p, faces};
}

void measure(const Subject& subject, int repeat) {
  const Problem& problem = subject.problem;
  const std::shared_ptr<LinearSolver> solver = make_direct_solver();
  NewtonOptions tight;
  tight.linear_solver = [&] { return solver; };
  tight.stopping.relative_decrease = 1e-15;
  tight.stopping.decrement = 1e-30;
  const SolveResult usual = NewtonMinimizer().minimize(problem, subject.start, nullptr);
  const SolveResult end = NewtonMinimizer(tight).minimize(problem, usual.y, nullptr);
  std::vector<double> step, analysis, make, with_solver, polished, first_b, b, first_data, data,
      first_adjoint, adjoint, first_rest, rest;
  const std::shared_ptr<LinearSolver> own = make_direct_solver();
  own->analyze(problem.pattern());
  for (int k = 0; k < repeat; ++k) {
    Evaluator evaluator(problem);
    Vec gradient, values, p;
    step.push_back(seconds_of([&] {
      evaluator.linearize(end.y, Curvature::Exact, gradient, values);
      own->factorize(values, 0);
      own->solve(gradient, p);
      evaluator.value(end.y - p);
    }));
    analysis.push_back(seconds_of(
        [&] { make_direct_solver({.ordering = Ordering::Amd})->analyze(problem.pattern()); }));
    std::optional<Sensitivity> s;
    make.push_back(seconds_of([&] { s.emplace(problem, end); }));
    SensitivityOptions same;
    same.analysed_solver = solver;
    with_solver.push_back(seconds_of([&] { Sensitivity(problem, end, same); }));
    polished.push_back(seconds_of([&] { Sensitivity(problem, usual); }));
    Sensitivity::Change by_rows, by_data;
    by_rows.right_hand_sides = Vec::Ones(s->row_count());
    const auto forward_b = [&] { s->forward(by_rows); };
    first_b.push_back(seconds_of(forward_b));
    b.push_back(seconds_of(forward_b));
    const Vec slope = Vec::Ones(problem.full_size());
    const auto backward = [&] { s->adjoint(slope); };
    if (subject.data) {
      by_data.parameters = {{problem.terms().front(), Vec::Ones(subject.data->size())}};
      const auto forward_data = [&] { s->forward(by_data); };
      first_data.push_back(seconds_of(forward_data));
      first_adjoint.push_back(seconds_of(backward));
      data.push_back(seconds_of(forward_data));
    } else {
      first_adjoint.push_back(seconds_of(backward));
    }
    adjoint.push_back(seconds_of(backward));
    if (subject.positions.rows() > 0) {
      std::optional<RestSensitivity> made;
      first_rest.push_back(seconds_of([&] {
        made.emplace(problem, *s, std::vector{problem.terms().front()}, subject.positions,
                     subject.cells);
      }));
      const RestSensitivity& by = *made;
      const Sensitivity::Derivative d = s->adjoint(slope);
      rest.push_back(seconds_of([&] {
        by.forward(subject.positions);
        by.adjoint(d);
      }));
    }
  }
  const double unit = median(step);
  const auto in_steps = [&](const std::vector<double>& seconds) {
    return seconds.empty() ? std::string("-") : fmt::format("{:.2f}", median(seconds) / unit);
  };
  fmt::print("| {} | {} | {:.1f} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
             subject.name, problem.size(), 1e3 * unit, in_steps(analysis), in_steps(make),
             in_steps(with_solver), in_steps(polished), in_steps(first_b), in_steps(b),
             in_steps(first_data), in_steps(data), in_steps(first_adjoint), in_steps(adjoint),
             in_steps(first_rest), in_steps(rest));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  int repeat = 5;
  Index size = 120;
  CLI::App app("What derivatives of solutions cost, in Newton steps");
  app.add_option("--repeat", repeat)->check(CLI::PositiveNumber);
  app.add_option("--size", size)->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  const ThreadCount one(1);
  fmt::print(
      "| problem | unknowns | step, ms | analysis | make | with_solver | polished | first_b | b | "
      "first_data | data | first_adjoint | adjoint | first_rest | rest |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  measure(net(size, true), repeat);
  measure(net(size, false), repeat);
  measure(flattening(size), repeat);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
