// Quads of an OpenMesh are made planar: the sum of the angles of each is 360 degrees, while
// vertices stay near their positions and edges near their lengths.
//
// The row of equalities makes the quads planar up to rounding. Its energy is that of positions and
// lengths, which is smaller for nearly planar quads.
#include "rows.h"
#if __has_include(<OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>)
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant::tinyad {
namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

Mesh mesh_of(const Input& input) {
  Mesh mesh;
  for (const auto& p : input.array("positions").rowwise())
    mesh.add_vertex(Mesh::Point(p[0], p[1], p[2]));
  const Cells faces = input.cells("faces");
  for (const auto& q : faces.rowwise())
    mesh.add_face(Mesh::VertexHandle(q[0]), Mesh::VertexHandle(q[1]), Mesh::VertexHandle(q[2]),
                  Mesh::VertexHandle(q[3]));
  return mesh;
}

// lines: planar
struct Nodes {
  Cells vertices, edges, quads;
  Vec start, lengths;
};

Nodes nodes_of(const Mesh& mesh) {
  const auto count = [](std::size_t n) { return static_cast<Index>(n); };
  Nodes n{Cells(count(mesh.n_vertices()), 1), Cells(count(mesh.n_edges()), 2),
          Cells(count(mesh.n_faces()), 4), Vec(3 * count(mesh.n_vertices())),
          Vec(count(mesh.n_edges()))};
  for (const auto v : mesh.vertices()) {
    n.vertices(v.idx(), 0) = v.idx();
    n.start.segment<3>(3 * v.idx()) = Eigen::Map<const Vector3>(mesh.point(v).data());
  }
  for (const auto e : mesh.edges()) {
    n.edges.row(e.idx()) << e.v0().idx(), e.v1().idx();
    n.lengths[e.idx()] = mesh.calc_edge_length(e);
  }
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : mesh.fv_range(f)) n.quads(f.idx(), k++) = v.idx();
  }
  return n;
}
// end

// lines: planar, lambda, least squares
// Returns the sum of the angles of a quad minus 360 degrees.
template <class Z>
auto angle_excess(const Z& z) {
  using std::acos;
  const auto side = [&z](int k) { return (z.col((k + 1) % 4) - z.col(k % 4)).normalized().eval(); };
  const auto angle = [&side](int k) { return acos(-side(k).dot(side(k + 1))); };
  return angle(0) + angle(1) + angle(2) + angle(3) - 2 * M_PI;
}
// end

// lines: planar
// Returns the change of an edge's length.
template <class Z>
auto length_change(const Z& z, double length) {
  const auto ratio = ((z.col(1) - z.col(0)).norm() / length);
  return 0.5 * (ratio + 1.0 / ratio) - 1.0;
}
// end

End by_lambda(const Input& input, Watch& watch) {
  const Mesh mesh = mesh_of(input);
  // lines: planar, lambda
  const Nodes n = nodes_of(mesh);
  ProblemBuilder builder(static_cast<Index>(n.start.size()));
  builder.add(make_term<4, 3>("planar", n.quads,
                              [](Index, const auto& z) {
                                const auto excess = angle_excess(z);
                                return excess * excess;
                              }),
              1.0 / n.quads.rows());
  builder.add(
      make_term<2, 3>("lengths", n.edges,
                      [&](Index e, const auto& z) { return length_change(z, n.lengths[e]); }),
      0.1 / n.edges.rows());
  builder.add(make_term<1, 3>("places", n.vertices,
                              [&](Index v, const auto& z) {
                                return (z.col(0) - n.start.segment<3>(3 * v)).squaredNorm();
                              }),
              1.0 / n.vertices.rows());
  const NewtonMinimizer newton(watch.options());
  const SolveResult result = newton.minimize(builder.build(), n.start, &watch);
  // end
  return end_of(result);
}

End by_least_squares(const Input& input, Watch& watch) {
  const Mesh mesh = mesh_of(input);
  // lines: planar, least squares
  const Nodes n = nodes_of(mesh);
  ProblemBuilder builder(static_cast<Index>(n.start.size()));
  builder.add(make_least_squares<4, 3>("planar", n.quads,
                                       [](Index, const auto& z) { return angle_excess(z); }),
              2.0 / n.quads.rows());
  builder.add(
      make_term<2, 3>("lengths", n.edges,
                      [&](Index e, const auto& z) { return length_change(z, n.lengths[e]); }),
      0.1 / n.edges.rows());
  builder.add(make_least_squares<1, 3>("places", n.vertices,
                                       [&](Index v, const auto& z) {
                                         return (z.col(0) - n.start.segment<3>(3 * v)).eval();
                                       }),
              2.0 / n.vertices.rows());
  const NewtonMinimizer newton(watch.options());
  const SolveResult result = newton.minimize(builder.build(), n.start, &watch);
  // end
  return end_of(result);
}

End by_equality(const Input& input, Watch& watch) {
  const Mesh mesh = mesh_of(input);
  // lines: planar, equality
  const Nodes n = nodes_of(mesh);
  const double volume = std::pow(n.lengths.mean(), 3);
  ProblemBuilder builder(static_cast<Index>(n.start.size()));
  builder.add(equality<4, 3>("planar", n.quads,
                             [=](Index, const auto& z) {
                               const auto edges =
                                   (z.template rightCols<3>().colwise() - z.col(0)).eval();
                               return edges.determinant() / volume;
                             }),
              1);
  builder.add(
      make_term<2, 3>("lengths", n.edges,
                      [&](Index e, const auto& z) { return length_change(z, n.lengths[e]); }),
      0.1 / n.edges.rows());
  builder.add(make_least_squares<1, 3>("places", n.vertices,
                                       [&](Index v, const auto& z) {
                                         return (z.col(0) - n.start.segment<3>(3 * v)).eval();
                                       }),
              2.0 / n.vertices.rows());
  BarrierOptions options;
  options.newton = watch.options();
  const Problem problem = builder.build();
  const BarrierResult result = BarrierMinimizer({}, options).run(problem, n.start, &watch);
  // end
  return {result, result.energy, result.violation};
}

}  // namespace

std::vector<TinyadProblem> planar_quads() {
  return {
      {"planar quads",
       quads,
       {{"lambda", by_lambda}, {"least squares", by_least_squares}, {"equality", by_equality}}}};
}

}  // namespace majorant::tinyad
#else
std::vector<majorant::tinyad::TinyadProblem> majorant::tinyad::planar_quads() { return {}; }
#endif

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
