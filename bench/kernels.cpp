// Kernels of one Newton iteration (Google Benchmark).
//
// Sample runs:
//   build/release/bench/majorant_bench
//   build/release/bench/majorant_bench --benchmark_filter=linearize/3
#include <benchmark/benchmark.h>

#include "bench_problem.h"
#include "majorant/framework/internal/problem_parts.h"

namespace majorant {
namespace {

const BenchProblem& creature(int degree) {
  static std::array<std::unique_ptr<BenchProblem>, 9> problems;
  auto& p = problems.at(at(degree));
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

#define MAJORANT_BENCH(f) BENCHMARK(f)->DenseRange(1, 4)->Unit(benchmark::kMillisecond)
MAJORANT_BENCH(value);
MAJORANT_BENCH(linearize);
MAJORANT_BENCH(certify);
MAJORANT_BENCH(max_step);
MAJORANT_BENCH(factorize_and_solve);

}  // namespace
}  // namespace majorant

BENCHMARK_MAIN();
