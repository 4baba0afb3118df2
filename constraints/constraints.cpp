#include "majorant/constraints/constraints.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

// One component of i^k (u, v): factor * (u, v)[from].
struct Turned {
  int from;
  long factor;
};
Turned turned(int turns, int c) {
  constexpr Turned kTable[4][2] = {
      {{0, 1}, {1, 1}}, {{1, -1}, {0, 1}}, {{0, -1}, {1, -1}}, {{1, 1}, {0, -1}}};
  return kTable[turns][c];
}

void require_fitting(const BezierTriangleSpace& space, const Seams& seams) {
  for (const SeamEdge& edge : seams.edges())
    for (const Index h : {edge.side, edge.opposite})
      require_index("seams: half-edge", h, 3 * space.element_count());
}

struct NodePair {
  Index side, opposite, edge;
};

// Returns the pairs of nodes that a chain joins, each once.
std::vector<std::vector<NodePair>> pairs_by_chain(const BezierTriangleSpace& space,
                                                  const Seams& seams) {
  std::vector<std::vector<NodePair>> pairs(to_size(seams.chain_count()));
  for (std::size_t e = 0; e < seams.edges().size(); ++e) {
    const SeamEdge& edge = seams.edges()[e];
    const std::vector<Index> a = edge_nodes(space, edge.side);
    const std::vector<Index> b = edge_nodes(space, edge.opposite);
    for (std::size_t i = 0; i < a.size(); ++i)
      pairs[edge.chain].push_back({a[i], b[a.size() - 1 - i], static_cast<Index>(e)});
  }
  const auto key = [](const NodePair& p) { return std::pair(p.side, p.opposite); };
  for (auto& list : pairs) {
    std::stable_sort(list.begin(), list.end(),
                     [&](const NodePair& a, const NodePair& b) { return key(a) < key(b); });
    list.erase(std::unique(list.begin(), list.end(),
                           [&](const NodePair& a, const NodePair& b) { return key(a) == key(b); }),
               list.end());
  }
  return pairs;
}

}  // namespace

AxisAlignment::AxisAlignment(std::shared_ptr<const BezierTriangleSpace> space,
                             std::vector<AlignedEdge> edges)
    : space_(given("AxisAlignment: the space", std::move(space))), edges_(std::move(edges)) {
  for (const AlignedEdge& edge : edges_)
    if (edge.half_edge < 0 || edge.half_edge >= 3 * space_->element_count() ||
        edge.coordinate < 0 || edge.coordinate > 1)
      throw InvalidArgument(
          fmt::format("AxisAlignment: there is no half-edge {} or no coordinate {}", edge.half_edge,
                      edge.coordinate));
}

// Edges that meet and hold the same coordinate form a component. Each of its unknowns equals the
// last one, so that rows are solved independently of each other; rows for pairs of neighbours would
// not be.
void AxisAlignment::append_rows(ConstraintRows& rows) const {
  rows.expect_nodes(2, "AxisAlignment", "it is a constraint of maps to the plane");
  const Index unknowns = 2 * space_->node_count();
  UnionFind components(unknowns);
  for (const AlignedEdge& edge : edges_) {
    const std::vector<Index> nodes = edge_nodes(*space_, edge.half_edge);
    for (const Index node : nodes)
      components.join(2 * node + edge.coordinate, 2 * nodes[0] + edge.coordinate);
  }
  std::vector<Index> last_of(to_size(unknowns));  // by component
  for (Index i = 0; i < unknowns; ++i) last_of[components.find(i)] = i;
  std::vector<char> written(to_size(unknowns), 0);
  for (const AlignedEdge& edge : edges_) {
    const Cells& faces = space_->faces();
    for (const Index node : edge_nodes(*space_, edge.half_edge)) {
      const Index unknown = 2 * node + edge.coordinate, last = last_of[components.find(unknown)];
      if (unknown == last || written[unknown]) continue;
      written[unknown] = 1;
      rows.begin_row(
          fmt::format("constant {} along edge ({}, {})", edge.coordinate == 0 ? 'u' : 'v',
                      from_vertex(faces, edge.half_edge), to_vertex(faces, edge.half_edge)));
      rows.add(unknown, 1);
      rows.add(last, -1);
      rows.end_row(0);
    }
  }
}

SeamlessConstraint::SeamlessConstraint(std::shared_ptr<const BezierTriangleSpace> space,
                                       std::shared_ptr<const Seams> seams)
    : space_(given("SeamlessConstraint: the space", std::move(space))),
      seams_(given("SeamlessConstraint: the seams", std::move(seams))) {
  require_fitting(*space_, *seams_);
}

void SeamlessConstraint::append_rows(ConstraintRows& rows) const {
  rows.expect_nodes(2, "SeamlessConstraint", "it is a constraint of maps to the plane");
  const auto surface_vertex = [&](Index cut) { return seams_->surface_vertex()[cut]; };
  for (const auto& pairs : pairs_by_chain(*space_, *seams_)) {
    const Index half_translation[2] = {rows.add_auxiliary(), rows.add_auxiliary()};
    for (const NodePair& p : pairs) {
      const SeamEdge& edge = seams_->edges()[p.edge];
      for (int c = 0; c < 2; ++c) {
        const Turned t = turned(edge.turns, c);
        rows.begin_row(fmt::format("{} of the seam at edge ({}, {})", c == 0 ? 'u' : 'v',
                                   surface_vertex(from_vertex(space_->faces(), edge.side)),
                                   surface_vertex(to_vertex(space_->faces(), edge.side))));
        rows.add(2 * p.side + c, 1);
        rows.add(2 * p.opposite + t.from, -t.factor);
        rows.add(half_translation[c], -2);
        rows.end_row(0);
      }
    }
  }
}

std::vector<Index> boundary_nodes(const BezierTriangleSpace& space, const Seams& seams) {
  if (seams.empty()) return space.boundary_nodes();
  std::vector<char> is_seam(to_size(3 * space.element_count()), 0);
  for (const SeamEdge& edge : seams.edges()) is_seam[edge.side] = is_seam[edge.opposite] = 1;
  const std::vector<Index> opposite = opposite_half_edges(space.faces());
  std::vector<Index> nodes;
  for (Index h = 0; h < static_cast<Index>(opposite.size()); ++h) {
    if (opposite[h] >= 0 || is_seam[h]) continue;
    for (const Index node : edge_nodes(space, h)) nodes.push_back(node);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

SeamMismatch worst_seam_edge(const BezierTriangleSpace& space, const Seams& seams, VecIn x) {
  require_enough("worst_seam_edge: x", x.size(), 2 * space.node_count());
  require_fitting(space, seams);
  const auto point = [&](Index node) { return Vector2(x[2 * node], x[2 * node + 1]); };
  SeamMismatch worst;
  for (std::size_t e = 0; e < seams.edges().size(); ++e) {
    const SeamEdge& edge = seams.edges()[e];
    const std::vector<Index> a = edge_nodes(space, edge.side);
    const std::vector<Index> b = edge_nodes(space, edge.opposite);
    for (std::size_t i = 0, last = a.size() - 1; i < last; ++i) {
      const Vector2 d = point(a[i]) - point(a[i + 1]);
      const Vector2 d_opposite = point(b[last - i]) - point(b[last - i - 1]);
      const double distance = (d - rotated(d_opposite, edge.turns)).norm();
      if (!(distance <= worst.distance)) worst = {static_cast<Index>(e), distance};
    }
  }
  return worst;
}

double seam_residual(const BezierTriangleSpace& space, const Seams& seams, VecIn x) {
  return worst_seam_edge(space, seams, x).distance;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
