// Another element: a curved patch of quadratic tensor-product quads, flattened with a built-in
// energy. The rest shapes are curved, so the Jacobian of the rest shape varies inside elements.
//
// Sample run:
//   example_quad_patch patch.vtk
#include <cmath>
#include <iostream>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/newton.h"
#include "write_vtk.h"

using namespace majorant;

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: " << argv[0] << " OUT.vtk\n", 1;
  // 1. A grid of quads; its control points, lifted off the plane, are a curved surface.
  constexpr int kCells = 8;
  RowMatrix vertices((kCells + 1) * (kCells + 1), 2);
  Cells cells(kCells * kCells, 4);
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const Index v = i * (kCells + 1) + j;
      vertices.row(v) << double(i) / kCells, double(j) / kCells;
      if (i < kCells && j < kCells)
        cells.row(i * kCells + j) << v, v + kCells + 1, v + kCells + 2, v + 1;
    }
  auto space =
      std::make_shared<const BezierQuadSpace>(cells, static_cast<Index>(vertices.rows()), 2);
  const RowMatrix flat = space->node_positions(vertices);
  RowMatrix surface(flat.rows(), 3);
  surface << flat,
      (0.3 * (3 * flat.col(0).array()).sin() * (2 * flat.col(1).array()).cos()).matrix();
  // 2. Measured against the surface; the start is its projection.
  const RestShapes rest = curved_shapes(*space, surface, tensor_gauss_rule(5));
  const Vec start = Eigen::Map<const Vec>(flat.data(), flat.size());
  auto injectivity = std::make_shared<const LocalInjectivity>(space, rest.measure);
  ProblemBuilder builder(2 * space->node_count());
  builder.add(symmetric_dirichlet()(space, rest), 1 / rest.measure.sum());
  builder.add(injectivity);
  builder.add(FixedPoints::at({0}, start));
  const Problem problem = builder.build();
  // 3. Minimize with the same solver as for triangles.
  const SolveResult result = NewtonMinimizer().minimize(problem, problem.reduce(start), {});
  const Vec x = problem.expand(result.y);
  std::cout << status_name(result.status) << " after " << result.iterations.size()
            << " iterations, energy " << result.energy
            << ", det J >= " << injectivity->lower_bounds(x).minCoeff() << "\n";
  write_vtk(argv[argc - 1], *space, x, 2, 77);
  return result.status == Status::Converged && injectivity->check(x).feasible ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
