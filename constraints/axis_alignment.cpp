#include <fmt/format.h>

#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
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

// Edges that hold the same coordinate and meet are a component. Every unknown of one equals its
// last: rows that are solved without touching each other, which a row for each pair of neighbours
// would not be.
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
