#include <fmt/format.h>

#include <utility>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/internal/node_lattice.h"
#include "majorant/framework/argument_check.h"

namespace majorant {
namespace {

std::vector<Exponents> triangle_lattice(const Degrees& degrees) {
  const TriangleIndices& ix = TriangleIndices::of_degree(degrees[0]);
  std::vector<Exponents> out;
  for (int l = 0; l < ix.count(); ++l) {
    const auto [i, j, k] = ix.multi(l);
    out.push_back({i, j, k});
  }
  return out;
}

// Describes a triangle; derivatives are by xi0 and xi1 with xi2 = 1 - xi0 - xi1, as in [MC20].
BernsteinElement triangle(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "BezierTriangleSpace",
          .degree = degree,
          .max_degree = BezierTriangleSpace::kMaxDegree,
          .factors = {3},
          .lattice = triangle_lattice,
          .derivatives = {{0, 2}, {1, 2}},
          .bisections = {{1, 2, {m, 0, 1}, {m, 2, 0}}}};  // the newest vertex comes first
}

}  // namespace

LatticeNumbering number_lattice(const Cells& faces, Index vertex_count, int n) {
  require_at_least("number_lattice: n", n, 1);
  const NodeLattice lattice(triangle(n).basis({n}));
  return number_nodes(lattice, faces, vertex_count, "number_lattice");
}

BezierTriangleSpace::BezierTriangleSpace(const Cells& faces, Index vertex_count, int degree)
    : BernsteinSpace(triangle(degree), faces, vertex_count) {
  if (degree > 1) faces_ = faces;
}

BezierTriangleSpace::BezierTriangleSpace(NodeNumbering numbering, int degree)
    : BernsteinSpace(triangle(degree), std::move(numbering)) {
  if (degree > 1) faces_ = cells().leftCols<3>();
}

Vec BezierTriangleSpace::elevate(VecIn x, const BezierTriangleSpace& higher) const {
  require_enough("BezierTriangleSpace::elevate: x", x.size(), 2 * node_count());
  if (higher.degree() != degree() + 1 || higher.element_count() != element_count())
    throw InvalidArgument(
        fmt::format("BezierTriangleSpace::elevate: a space of degree {} with {} faces, degree {} "
                    "with {} is needed",
                    higher.degree(), higher.element_count(), degree() + 1, element_count()));
  const Eigen::MatrixXd e = elevation_matrix(degree());
  Vec out = Vec::Zero(2 * higher.node_count());
  for (Index f = 0; f < cells().rows(); ++f)
    for (Index q = 0; q < e.rows(); ++q)
      for (int c = 0; c < 2; ++c) {
        double value = 0;
        for (Index p = 0; p < e.cols(); ++p) value += e(q, p) * x[2 * cells()(f, p) + c];
        out[2 * higher.cells()(f, q) + c] = value;
      }
  // Corner points keep their doubles.
  for (Index v = 0; v < 2 * vertex_count(); ++v) out[v] = x[v];
  return out;
}

std::vector<Index> edge_nodes(const BezierTriangleSpace& space, Index half_edge) {
  require_index("edge_nodes: half-edge", half_edge, 3 * space.element_count());
  const TriangleIndices& ix = TriangleIndices::of_degree(space.degree());
  std::vector<Index> nodes;
  for (const int local : ix.edge(half_edge % 3))
    nodes.push_back(space.cells()(half_edge / 3, local));
  return nodes;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
