// A linear solver of one's own: Eigen's conjugate gradients with an incomplete Cholesky factor.
// Newton's method asks for no more accuracy than a step is worth; the solver says what it reached,
// and where the matrix turns out to be indefinite Newton tries a larger shift.
//
// Sample run:
//   example_custom_solver examples/meshes/cap.obj cap.vtu
#include <Eigen/IterativeLinearSolvers>
#include <cmath>
#include <iostream>

#include "majorant/framework/newton.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/majorant.h"
#include "majorant/maps/rest_shapes_of.h"

using namespace majorant;

struct ConjugateGradients final : LinearSolver {
  using Matrix = Eigen::SparseMatrix<double>;
  void analyze(const SparsePattern& pattern) override { pattern_ = &pattern; }
  FactorStatus factorize(const Vec& values, double shift) override {
    const SparsePattern& p = *pattern_;
    H_ = Eigen::Map<const Matrix>(p.size, p.size, p.nonzeros(), p.column_starts.data(),
                                  p.rows.data(), values.data());
    for (Index i = 0; i < p.size; ++i) H_.coeffRef(i, i) += shift;
    cg_.compute(H_);
    const bool done = cg_.info() == Eigen::Success;
    return done ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    cg_.setTolerance(tolerance);
    p = cg_.solve(r);
    const auto status = !(r.dot(p) > 0)                ? SolveStatus::Indefinite
                        : cg_.info() == Eigen::Success ? SolveStatus::Solved
                                                       : SolveStatus::NotConverged;
    return {status, cg_.error(), static_cast<int>(cg_.iterations())};
  }
  std::string description() const override { return "conjugate gradients"; }
  const SparsePattern* pattern_ = nullptr;
  Matrix H_;  // lower triangle
  Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::IncompleteCholesky<double>> cg_;
};

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  // 1. A problem: the map of a disk, from Tutte's.
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, {}));
  MapSpecification spec;
  spec.rest = std::make_shared<const RestShapes>(rest_shapes(*mesh));
  const auto space = start.shared_space();
  const DensityTerms terms = energy_terms(spec, space, {lattice_rule(1)});
  auto injectivity = std::make_shared<const LocalInjectivity>(space, 2 * spec.rest->measure);
  const Problem problem =
      map_problem(spec, space, start.control_points(), terms, injectivity).problem;
  // 2. Newton's method with that solver, and with the library's own.
  const Vec y0 = problem.reduce(start.control_points());
  NewtonOptions options;
  const SolveResult direct = NewtonMinimizer(options).minimize(problem, y0, {});
  options.linear_solver = [] { return std::make_unique<ConjugateGradients>(); };
  const SolveResult own = NewtonMinimizer(options).minimize(problem, y0, {});
  // 3. Print the steps; the minimum is the same.
  for (const IterationRecord& r : own.iterations)
    std::cout << "energy " << r.energy << ", residual " << r.residual << ", " << r.solver_iterations
              << " iterations of conjugate gradients\n";
  std::cout << status_name(own.status) << ", " << own.energy << "; direct " << direct.energy
            << "\n";
  write_vtu(argv[2], to_map_file(start.with(space, problem.expand(own.y))));
  return std::abs(own.energy - direct.energy) < 1e-6 * direct.energy ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
