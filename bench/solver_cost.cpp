// What an iteration costs against one factorization and solve: the project's measure of speed.
//
// For each mesh and degree: the time of assembly (gradient and Hessian, one thread), of
// factorization + solve for every CHOLMOD variant (best of several), their ratio; for degree 1 also
// the whole optimization against iterations x the best factorization + solve. Ratios of one run on
// one machine; absolute times mean little.
//
// Sample runs:
//   build/release/bench/solver_cost ../shared/data/public/disks/*_10000.obj
//   build/release/bench/solver_cost --degrees 1,2,3 meshes/creature.obj
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>

#include "bench_problem.h"
#include "majorant/framework/thread_count.h"

using namespace majorant;

namespace {

template <class F>
double best_milliseconds(int repeats, const F& f) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) {
    const auto start = std::chrono::steady_clock::now();
    f();
    best = std::min(
        best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count());
  }
  return best;
}

struct Variant {
  const char* name;
  Factorization factorization;
  Ordering ordering;
};
constexpr Variant kVariants[] = {{"supernodal AMD", Factorization::Supernodal, Ordering::Amd},
                                 {"supernodal METIS", Factorization::Supernodal, Ordering::Metis},
                                 {"simplicial AMD", Factorization::Simplicial, Ordering::Amd},
                                 {"simplicial METIS", Factorization::Simplicial, Ordering::Metis},
                                 {"default", Factorization::Automatic, Ordering::Best}};

double report_costs(const BenchProblem& b, const std::string& label) {
  Evaluator evaluator(b.problem);
  const Vec y = b.problem.reduce(b.x);
  Vec g, h, p;
  const double assembly =
      best_milliseconds(9, [&] { evaluator.linearize(y, Curvature::Projected, g, h); });
  std::string line = fmt::format("| {} | {} | {:.2f} |", label, b.problem.size(), assembly);
  double best = std::numeric_limits<double>::infinity();
  for (const Variant& v : kVariants) {
    const auto solver = make_cholmod_solver(v.factorization, v.ordering);
    solver->analyze(b.problem.pattern());
    const double ms = best_milliseconds(5, [&] {
      solver->factorize(h, 0.0);
      solver->solve(g, p);
    });
    best = std::min(best, ms);
    line += fmt::format(" {:.2f} |", ms);
  }
  fmt::print("{} {:.3f} |", line, assembly / best);
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const ThreadCount one(1);
  std::vector<int> degrees{1};
  fmt::print("| mesh, degree | unknowns | assembly ms |");
  for (const Variant& v : kVariants) fmt::print(" {} ms |", v.name);
  fmt::print(" assembly / best | iterations | optimize ms | optimize / (iterations x best) |\n|");
  for (int k = 0; k < 12; ++k) fmt::print("---|");
  fmt::print("\n");
  for (int a = 1; a < argc; ++a) {
    if (!std::strcmp(argv[a], "--degrees") && a + 1 < argc) {
      degrees.clear();
      for (const char* c = argv[++a]; *c; ++c)
        if (*c != ',') degrees.push_back(*c - '0');
      continue;
    }
    const std::string path = argv[a], name = path.substr(path.rfind('/') + 1);
    for (const int degree : degrees) {
      const BenchProblem b(path, degree);
      const double best = report_costs(b, fmt::format("{}, {}", name, degree));
      if (degree > 1) {
        fmt::print(" | | |\n");
        continue;
      }
      ParametrizationOptions options;
      options.map.degree = degree;
      RunRecord record;
      const ParametrizationResult r = parametrize(b.mesh, options, record);
      const double ms = 1e3 * r.optimize_seconds, n = static_cast<double>(record.trace().size());
      fmt::print(" {} | {:.1f} | {:.2f} |\n", n, ms, ms / (n * best));
    }
    std::fflush(stdout);
  }
}
