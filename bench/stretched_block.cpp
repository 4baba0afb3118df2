// Compares methods on a large volume problem: n^3 cubes of six straight tetrahedra, with two
// opposite faces held at a stretch of 1.5, from the affine map. Prints a Markdown table: steps and
// factorizations until the energy is within 1e-6 of the least energy of all methods, and until the
// end of the method; CPU seconds of the whole solve on one thread.
//
// Sample run:
//   stretched_block 28 amips-exponential        # 131,712 tetrahedra
//
// The energy: mips, amips-exponential, ... symmetric-dirichlet has its minimum at the start, since
// after a stretch in one direction the other directions cannot lower it.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/solid_energies.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"

using namespace majorant;

namespace {

constexpr double kStretch = 1.5;
constexpr double kWithin = 1e-6;  // relative to the least energy

// Returns six tetrahedra around the diagonal of each cube (Kuhn).
Cells cells_of_cube(int n) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  Cells cells(6 * n * n * n, 4);
  Index e = 0;
  for (int cube = 0; cube < n * n * n; ++cube)
    for (int t = 0; t < 6; ++t, ++e) {
      int at[3] = {cube / (n * n), cube / n % n, cube % n};
      for (int corner = 0; corner < 4; ++corner) {
        if (corner > 0) ++at[kOrders[t][corner - 1]];
        cells(e, corner) = (at[0] * (n + 1) + at[1]) * (n + 1) + at[2];
      }
      if (t >= 3)
        std::swap(cells(e, 1), cells(e, 2));  // odd permutations have negative orientation
    }
  return cells;
}

RowMatrix vertices_of_cube(int n) {
  RowMatrix out((n + 1) * (n + 1) * (n + 1), 3);
  for (Index v = 0; v < out.rows(); ++v)
    out.row(v) << static_cast<double>(v / ((n + 1) * (n + 1))),
        static_cast<double>(v / (n + 1) % (n + 1)), static_cast<double>(v % (n + 1));
  return out / n;
}

class StretchedBlock {
 public:
  explicit StretchedBlock(int n)
      : vertices_(vertices_of_cube(n)),
        space_(std::make_shared<const BezierTetrahedronSpace>(
            cells_of_cube(n), static_cast<Index>(vertices_.rows()), 1)),
        rest_(flat_simplices(vertices_, cells_of_cube(n))) {
    RowMatrix stretched = vertices_;
    stretched.col(0) *= kStretch;
    start_ = Eigen::Map<const Vec>(stretched.data(), stretched.size());
  }

  Problem problem(const EnergyFactory& make) const {
    std::vector<FixedUnknown> held;
    for (Index v = 0; v < vertices_.rows(); ++v)
      if (vertices_(v, 0) == 0 || vertices_(v, 0) == 1)
        for (int c = 0; c < 3; ++c) held.push_back({3 * v + c, start_[3 * v + c]});
    ProblemBuilder builder(start_.size());
    builder.add(make(space_, rest_), 1 / rest_.measure.sum());
    builder.add(FixedUnknowns(held));
    builder.add(std::make_shared<LocalInjectivity>(space_, 6 * rest_.measure));
    return builder.build();
  }
  const Vec& start() const { return start_; }
  Index elements() const { return rest_.measure.size(); }

 private:
  RowMatrix vertices_;
  std::shared_ptr<const BezierTetrahedronSpace> space_;
  RestShapes rest_;
  Vec start_;
};

struct Run {
  std::string name;
  SolveResult result;
  double seconds;
};

std::vector<std::pair<std::string, std::unique_ptr<Minimizer>>> methods(const Problem& problem) {
  std::vector<std::pair<std::string, std::unique_ptr<Minimizer>>> out;
  out.emplace_back("newton", std::make_unique<NewtonMinimizer>());
  NewtonOptions projected;
  projected.blend.below = 0;
  out.emplace_back("newton-projected", std::make_unique<NewtonMinimizer>(projected));
  NewtonOptions exact;
  exact.curvature = Curvature::Exact;
  out.emplace_back("newton-exact", std::make_unique<NewtonMinimizer>(exact));
  LbfgsOptions hessian;
  hessian.metric = problem;
  out.emplace_back("lbfgs-hessian", std::make_unique<LbfgsMinimizer>(hessian));
  return out;
}

int factorizations(const SolveResult& result, std::size_t steps) {
  int sum = 0;
  for (std::size_t k = 0; k < steps; ++k) sum += result.iterations[k].factorizations;
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 28;
  const NamedEnergy* energy = find_solid_energy(argc > 2 ? argv[2] : "amips-exponential");
  if (n < 1 || energy == nullptr) return fmt::print(stderr, "usage: {} N ENERGY\n", argv[0]), 1;
  const ThreadCount one(1);
  const StretchedBlock block(n);
  const Problem problem = block.problem(energy->make);
  std::vector<Run> runs;
  for (const auto& [name, method] : methods(problem)) {
    const std::clock_t before = std::clock();
    SolveResult result = method->minimize(problem, problem.reduce(block.start()), nullptr);
    runs.push_back(
        {name, std::move(result), static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC});
  }
  double least = runs.front().result.energy;
  for (const Run& run : runs) least = std::min(least, run.result.energy);
  fmt::print(
      "| {} tetrahedra, {} unknowns | status | steps to 1e-6 | factorizations | steps in all | "
      "factorizations "
      "| energy | CPU s |\n|---|---|---|---|---|---|---|---|\n",
      block.elements(), problem.size());
  for (const auto& [name, result, seconds] : runs) {
    const auto& rows = result.iterations;
    const auto reached =
        static_cast<std::size_t>(std::find_if(rows.begin(), rows.end(),
                                              [&](const IterationRecord& row) {
                                                return row.energy <= least * (1 + kWithin);
                                              }) -
                                 rows.begin());
    const bool is_reached = reached < rows.size();
    fmt::print("| {} | {} | {} | {} | {} | {} | {:.9f} | {:.1f} |\n", name,
               status_name(result.status), is_reached ? std::to_string(reached + 1) : "-",
               is_reached ? std::to_string(factorizations(result, reached + 1)) : "-", rows.size(),
               factorizations(result, rows.size()), result.energy, seconds);
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
