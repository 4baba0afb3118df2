#include "majorant/mesh/seams.h"

#include <algorithm>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {
namespace {

int opposite_turns(int turns) { return (4 - turns) % 4; }

}  // namespace

Vector2 rotated(const Vector2& uv, int turns) {
  switch ((turns % 4 + 4) % 4) {
    case 1:
      return {-uv.y(), uv.x()};
    case 2:
      return {-uv.x(), -uv.y()};
    case 3:
      return {uv.y(), -uv.x()};
    default:
      return uv;
  }
}

Seams::Seams(const Cells& cut_faces, std::vector<Index> surface_vertex, std::vector<SeamEdge> edges,
             std::vector<int> quarter_turns)
    : surface_vertex_(std::move(surface_vertex)),
      edges_(std::move(edges)),
      quarter_turns_(std::move(quarter_turns)) {
  const Index half_edges = 3 * static_cast<Index>(cut_faces.rows());
  for (const SeamEdge& edge : edges_) {
    for (const Index h : {edge.side, edge.opposite})
      require_index("Seams: half-edge", h, half_edges);
    require_index("Seams: turns", edge.turns, 4);
  }
  if (!edges_.empty() && cut_faces.maxCoeff() >= static_cast<Index>(surface_vertex_.size()))
    throw InvalidArgument("Seams: surface_vertex has fewer numbers than the cut surface vertices");
  for (const Index v : surface_vertex_)
    require_index("Seams: vertex", v, static_cast<Index>(quarter_turns_.size()));
  find_chains(cut_faces);
}

std::vector<Cone> Seams::cones() const {
  std::vector<Cone> cones;
  for (std::size_t v = 0; v < quarter_turns_.size(); ++v)
    if (quarter_turns_[v] != 0 && quarter_turns_[v] != 4)
      cones.push_back({static_cast<Index>(v), quarter_turns_[v]});
  return cones;
}

// Walks from every edge across vertices where only two seam edges of equal turns meet.
void Seams::find_chains(const Cells& cut_faces) {
  const auto from = [&](Index h) { return from_vertex(cut_faces, h); };
  const auto to = [&](Index h) { return to_vertex(cut_faces, h); };
  std::vector<std::vector<Index>> edges_at(quarter_turns_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e)
    for (const Index v : {from(edges_[e].side), to(edges_[e].side)})
      edges_at[surface_vertex_[v]].push_back(static_cast<Index>(e));
  for (SeamEdge& edge : edges_) edge.chain = -1;
  std::vector<Index> stack;
  for (std::size_t start = 0; start < edges_.size(); ++start) {
    if (edges_[start].chain >= 0) continue;
    edges_[start].chain = chain_count_;
    stack.push_back(static_cast<Index>(start));
    while (!stack.empty()) {
      const Index e = stack.back();
      stack.pop_back();
      const SeamEdge& edge = edges_[e];
      for (const Index v : {from(edge.side), to(edge.side)}) {
        const Index surface = surface_vertex_[v];
        const auto& around = edges_at[surface];
        if (around.size() != 2 || around[0] == around[1] || quarter_turns_[surface] == 0) continue;
        SeamEdge& other = edges_[around[0] == e ? around[1] : around[0]];
        if (other.chain == chain_count_) continue;
        // One fan of faces lies on the same side of both edges.
        const bool same = from(other.side) == v || to(other.side) == v;
        if ((same ? other.turns : opposite_turns(other.turns)) != edge.turns) continue;
        if (!same) {
          std::swap(other.side, other.opposite);
          other.turns = opposite_turns(other.turns);
        }
        other.chain = chain_count_;
        stack.push_back(static_cast<Index>(&other - edges_.data()));
      }
    }
    ++chain_count_;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
