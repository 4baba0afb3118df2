// A raw EnergyTerm: anything that couples a few unknowns. Here springs along the boundary edges,
// which keep their length on the surface, added to a map's problem that is put together by hand.
//
// Sample run:
//   example_custom_term examples/meshes/cap.obj cap.vtu
#include <cmath>
#include <iostream>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/newton.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/solve/parametrize.h"

using namespace majorant;

// f = (|x_b - x_a| - L)^2 / L for each spring (a, b) of length L at rest.
class Springs final : public EnergyTerm {
 public:
  Springs(Cells ends, Vec lengths)
      : element_dofs_{std::move(ends), 2}, lengths_(std::move(lengths)) {}
  std::string_view name() const override { return "springs"; }
  const ElementDofs& element_dofs() const override {
    return element_dofs_;
  }  // 2 nodes of 2 unknowns
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }

  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      f[p] = std::pow(edge(x, e).norm() - lengths_[e], 2) / lengths_[e];
    }
  }

  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double length = lengths_[batch.elements[p]];
      const Vector2 d = edge(x, batch.elements[p]);
      const double r = d.norm();
      const Vector2 t = d / r;
      const double across = curvature.clamped(1 - length / r);  // negative where compressed
      const Eigen::Matrix2d along = t * t.transpose();
      const Eigen::Matrix2d h =
          2 / length * (along + across * (Eigen::Matrix2d::Identity() - along));
      for (int i = 0, k = 0; i < 4; ++i) {
        const double sign = i < 2 ? -1 : 1;
        out.gradient[i * LocalSystem::stride + p] = sign * 2 * (r - length) / length * t[i % 2];
        if (!out.hessian) continue;
        for (int j = 0; j <= i; ++j, ++k)
          out.hessian[k * LocalSystem::stride + p] = sign * (j < 2 ? -1 : 1) * h(i % 2, j % 2);
      }
    }
  }

 private:
  Vector2 edge(VecIn x, Index e) const {
    const Index a = element_dofs_.nodes(e, 0), b = element_dofs_.nodes(e, 1);
    return x.segment<2>(2 * b) - x.segment<2>(2 * a);
  }
  ElementDofs element_dofs_;
  Vec lengths_;
};

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  // 1. One spring per boundary edge.
  const std::vector<Index>& loop = mesh->boundary_loops().front();
  Cells ends(static_cast<Index>(loop.size()), 2);
  Vec lengths(ends.rows());
  for (Index e = 0; e < ends.rows(); ++e) {
    ends.row(e) << loop[static_cast<std::size_t>(e)],
        loop[static_cast<std::size_t>(e + 1) % loop.size()];
    lengths[e] = (mesh->positions().row(ends(e, 0)) - mesh->positions().row(ends(e, 1))).norm();
  }
  auto springs = std::make_shared<const Springs>(ends, lengths);
  // 2. A linear map to start from, its energy, the springs, injectivity, one point held.
  ParametrizationOptions options;
  options.map.degree = 1;
  const BezierMap start = *parametrize(mesh, options).map;
  const RestShapes rest = flat_triangles(mesh->positions(), mesh->faces());
  ProblemBuilder builder(2 * mesh->vertex_count());
  builder.add(symmetric_dirichlet()(start.shared_space(), rest), 1 / mesh->area());
  builder.add(springs, 100 / lengths.sum());
  builder.add(std::make_shared<const LocalInjectivity>(start.shared_space(), 2 * rest.measure));
  builder.add(FixedPoints::at({0}, start.control_points()));
  const Problem problem = builder.build();
  // 3. Any minimizer.
  const Vec y0 = problem.reduce(start.control_points());
  const SolveResult result = NewtonMinimizer().minimize(problem, y0, {});
  const auto report = check_derivatives(*springs, problem.expand(result.y));
  std::cout << status_name(result.status) << ", energy " << result.energy << "\n"
            << report.message();
  const BezierMap map(mesh, start.shared_space(), problem.expand(result.y));
  write_vtu(argv[2], to_map_file(map));
  return result.status == Status::Converged && report.ok() ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
