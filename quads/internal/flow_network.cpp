#include "majorant/quads/internal/flow_network.h"

namespace majorant {

FlowNetwork::FlowNetwork(const TMesh& mesh)
    : nodes_(static_cast<Index>(4 * mesh.patches.size() + 1)), edges_(2 * mesh.arcs.size()) {
  std::vector<SideTerm> terms(2 * mesh.arcs.size());
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (std::size_t s = 0; s < 4; ++s)
      for (const Index h : mesh.patches[p].sides[s])
        terms[h] = {static_cast<Index>(2 * p + s % 2), s < 2 ? 1 : -1};
  for (std::size_t a = 0; a < mesh.arcs.size(); ++a) {
    const SideTerm &one = terms[2 * a], &other = terms[2 * a + 1];
    edges_[2 * a] = {node(other, -other.sign), node(one, one.sign)};
    edges_[2 * a + 1] = {node(one, -one.sign), node(other, other.sign)};
  }
  std::vector<std::vector<Way>> leaving(to_size(nodes_));
  for (Index e = 0; e < static_cast<Index>(edges_.size()); ++e) {
    const auto& [from, to] = edges_[e];
    if (from == to) continue;  // the arc is on opposite sides of one patch: any number fits
    leaving[from].push_back({2 * e, to});
    leaving[to].push_back({2 * e + 1, from});
  }
  for (const std::vector<Way>& of_node : leaving) {
    begin_.push_back(ways_.size());
    ways_.insert(ways_.end(), of_node.begin(), of_node.end());
  }
  begin_.push_back(ways_.size());
}

Index FlowNetwork::node(const SideTerm& term, int sign) const {
  return term.equation < 0 ? nodes_ - 1 : 2 * term.equation + (sign > 0);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
