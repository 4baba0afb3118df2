// A curved surface of quads in OpenMesh, moved as little as it takes to make every quad planar: one
// equality a quad, the volume of the tetrahedron of its corners.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cmath>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/least_squares.h"
#include "outcome.h"
using namespace majorant;
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

int main() {
  // 1. A mesh of the program's own.
  const int n = 10;
  const double h = 1.0 / n;
  Mesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      mesh.add_vertex(Mesh::Point(i * h, j * h, 0.2 * std::sin(4 * i * h) * std::cos(3 * j * h)));
  const auto corner = [n](int i, int j) { return Mesh::VertexHandle(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      mesh.add_face(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
  // 2. Its vertices are nodes with three unknowns.
  Vec start(3 * (n + 1) * (n + 1));
  Cells vertices((n + 1) * (n + 1), 1), quads(n * n, 4);
  for (const auto v : mesh.vertices()) {
    vertices(v.idx(), 0) = v.idx();
    start.segment<3>(3 * v.idx()) = Eigen::Map<const Vector3>(mesh.point(v).data());
  }
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : mesh.fv_range(f)) quads(f.idx(), k++) = v.idx();
  }
  // 3. Near the start, and planar: volumes in cubes of the width of a quad.
  ProblemBuilder builder(start.size());
  builder.add(make_least_squares<1, 3>("near the start", vertices,
                                       [&start](Index v, const auto& z) {
                                         return (z.col(0) - start.segment<3>(3 * v)).eval();
                                       }),
              1);
  builder.add(equality<4, 3>("planar", quads,
                             [h](Index, const auto& z) {
                               const auto edges =
                                   (z.template rightCols<3>().colwise() - z.col(0)).eval();
                               return edges.determinant() / (h * h * h);
                             }),
              1);
  const Problem problem = builder.build();
  const BarrierResult result = BarrierMinimizer({}).run(problem, problem.reduce(start));
  // 4. Back into the mesh.
  const Vec x = problem.expand(result.y);
  for (const auto v : mesh.vertices()) mesh.set_point(v, Mesh::Point(x.data() + 3 * v.idx()));
  std::cout << "moved by at most " << (x - start).lpNorm<Eigen::Infinity>() << "\n";
  return outcome(result, "the largest violation", result.violation, 0, 1e-10);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
