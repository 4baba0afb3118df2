// A linear constraint of one's own, held exactly: rows of integer coefficients, eliminated before
// the solver starts. Here a rigid link: one vertex keeps its offset from another.
//
// Sample run:
//   example_custom_constraint examples/meshes/cap.obj cap.vtu
#include <iostream>

#include "majorant/framework/newton.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/solve/parametrize.h"

using namespace majorant;

// x_b - x_a = offset: two rows, one for u, one for v.
class Link final : public Constraint {
 public:
  Link(Index a, Index b, Vector2 offset) : a_(a), b_(b), offset_(offset) {}
  void append_rows(ConstraintRows& rows) const override {
    for (int c = 0; c < 2; ++c) {
      rows.begin_row(c == 0 ? "link, u" : "link, v");  // named if it contradicts others
      rows.add(2 * b_ + c, 1);
      rows.add(2 * a_ + c, -1);
      rows.end_row(offset_[c]);
    }
  }

 private:
  Index a_, b_;
  Vector2 offset_;
};

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  // 1. A start that meets the constraint, which takes its offset from it: the initial map.
  ParametrizationOptions options;
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  const Vec& x = start.control_points();
  const Index a = 0, b = mesh->vertex_count() - 1;
  const Vector2 offset = x.segment<2>(2 * b) - x.segment<2>(2 * a);
  // 2. The problem of a map, with one constraint more.
  const RestShapes rest = flat_triangles(mesh->positions(), mesh->faces());
  ProblemBuilder builder(2 * mesh->vertex_count());
  builder.add(symmetric_dirichlet()(start.shared_space(), rest), 1 / mesh->area());
  builder.add(std::make_shared<const LocalInjectivity>(start.shared_space(), 2 * rest.measure));
  builder.add(FixedPoints::at({a}, x));
  builder.add(Link(a, b, offset));
  const Problem problem = builder.build();
  // 3. Solve; the link holds at every step.
  const SolveResult result = NewtonMinimizer().minimize(problem, problem.reduce(x), {});
  const BezierMap map(mesh, start.shared_space(), problem.expand(result.y));
  const Vector2 left =
      map.control_points().segment<2>(2 * b) - map.control_points().segment<2>(2 * a) - offset;
  std::cout << status_name(result.status) << ", energy " << result.energy << ", link off by "
            << left.norm() << "\n";
  write_vtu(argv[2], to_map_file(map));
  return result.status == Status::Converged && left.norm() < 1e-12 ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
