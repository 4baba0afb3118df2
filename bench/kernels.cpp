// Kernels of one Newton iteration (Google Benchmark).
//
// Sample runs:
//   build/release/bench/majorant_bench
//   build/release/bench/majorant_bench --benchmark_filter=linearize/3
#include <benchmark/benchmark.h>

#include "bench_problem.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/vectorized.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

const BenchProblem& creature(int degree) {
  static std::array<std::unique_ptr<BenchProblem>, 9> problems;
  auto& p = problems.at(to_size(degree));
  if (!p) p = std::make_unique<BenchProblem>(MAJORANT_MESHES "creature.obj", degree);
  return *p;
}

void value(benchmark::State& state) {
  const BenchProblem& b = creature(static_cast<int>(state.range(0)));
  Evaluator evaluator(b.problem);
  const Vec y = b.problem.reduce(b.x);
  for (auto _ : state) benchmark::DoNotOptimize(evaluator.value(y));
}

void linearize(benchmark::State& state) {
  const BenchProblem& b = creature(static_cast<int>(state.range(0)));
  Evaluator evaluator(b.problem);
  const Vec y = b.problem.reduce(b.x);
  Vec g, h;
  for (auto _ : state) benchmark::DoNotOptimize(evaluator.linearize(y, Curvature::Projected, g, h));
}

void certify(benchmark::State& state) {
  const BenchProblem& b = creature(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(b.injectivity->check(b.x).feasible);
}

void max_step(benchmark::State& state) {
  const BenchProblem& b = creature(static_cast<int>(state.range(0)));
  Evaluator evaluator(b.problem);
  Vec y = b.problem.reduce(b.x), g, h, d;
  evaluator.linearize(y, Curvature::Projected, g, h);
  ProblemParts::elimination(b.problem).expand_direction(-g / g.norm(), d);
  for (auto _ : state) benchmark::DoNotOptimize(b.injectivity->max_step(b.x, d, 1.0).step);
}

void factorize_and_solve(benchmark::State& state) {
  const BenchProblem& b = creature(static_cast<int>(state.range(0)));
  Evaluator evaluator(b.problem);
  Vec g, h, p;
  evaluator.linearize(b.problem.reduce(b.x), Curvature::Projected, g, h);
  const auto solver = make_direct_solver();
  solver->analyze(b.problem.pattern());
  for (auto _ : state) {
    benchmark::DoNotOptimize(solver->factorize(h, 0.0));
    solver->solve(g, p);
  }
}

// Second derivatives of the same energy, built in and as a user's formula.
void formula(benchmark::State& state, const EnergyFactory& energy) {
  const BenchProblem& b = creature(static_cast<int>(state.range(0)));
  ProblemBuilder builder(2 * b.space->node_count());
  builder.add(energy(b.space, flat_triangles(b.mesh->positions(), b.mesh->faces()),
                     optimizer_quadrature(b.space->degree(), 0).guarded),
              1.0);
  const Problem problem = builder.build();
  Evaluator evaluator(problem);
  const Vec y = problem.reduce(b.x);
  Vec g, h;
  for (auto _ : state) benchmark::DoNotOptimize(evaluator.linearize(y, Curvature::Projected, g, h));
}

const auto kSpectral = spectral(
    "spectral", [](auto S, auto s) { return S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s); },
    {.convexity = Convexity::Convex});
const auto kOfJacobian = density<2, 2>(
    "of J", [](const auto& J) { return J.squaredNorm() + J.inverse().squaredNorm(); });

#define MAJORANT_BENCH(f) BENCHMARK(f)->DenseRange(1, 4)->Unit(benchmark::kMillisecond)
MAJORANT_BENCH(value);
MAJORANT_BENCH(linearize);
MAJORANT_BENCH(certify);
MAJORANT_BENCH(max_step);
MAJORANT_BENCH(factorize_and_solve);
#define MAJORANT_FORMULA(name, energy) \
  BENCHMARK_CAPTURE(formula, name, energy)->DenseRange(1, 3)->Unit(benchmark::kMillisecond)
MAJORANT_FORMULA(built_in, symmetric_dirichlet());
MAJORANT_FORMULA(spectral, energy_factory(kSpectral));
MAJORANT_FORMULA(vectorized, energy_factory(kSpectral, vectorized(kSpectral)));
MAJORANT_FORMULA(of_jacobian, energy_factory(kOfJacobian));

}  // namespace
}  // namespace majorant

BENCHMARK_MAIN();

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
