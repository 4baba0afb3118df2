// A problem like those of parametrize(), at the optimum of degree 1, for timings.
#pragma once

#include <memory>
#include <string>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/newton.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

struct BenchProblem {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  std::shared_ptr<const LocalInjectivity> injectivity;
  Vec x;
  Problem problem;

  BenchProblem(const std::string& path, int degree, int steps = 1000) {
    mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
    ParametrizationOptions options;
    options.map.degree = 1;
    RunRecord record(1e9, steps);
    BezierMap map = *parametrize(mesh, options, record).map;
    while (map.degree() < degree) map = map.elevated();
    space = map.shared_space();
    x = map.control_points();
    const RestShapes rest = flat_triangles(mesh->positions(), mesh->faces());
    injectivity = std::make_shared<const LocalInjectivity>(space, 2 * rest.measure);
    ProblemBuilder builder(2 * space->node_count());
    builder.add(symmetric_dirichlet()(space, rest, optimizer_quadrature(degree, 0).guarded),
                1.0 / mesh->area());
    builder.add(injectivity);
    builder.add(FixedPoints::at({0}, x));
    problem = builder.build();
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
