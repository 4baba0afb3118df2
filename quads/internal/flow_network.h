// The network in which a quantization is a flow of least cost [HWB23].
//
// Each pair of opposite sides of a patch is an equation, sum_{a in side} n_a - sum_{a in opposite
// side} n_a = 0. Every arc has two terms, one for the patch on each side, whose signs make this a
// bidirected graph. Its double cover is directed: each equation gives two nodes, for both signs of
// its excess, and each arc an edge and its mirror image. A flow in the cover gives n_a in halves,
// as the mean of its two edges.
//
//   const FlowNetwork network(t_mesh);
//   for (const auto& [step, to] : network.leaving(0)) std::cout << to << "\n";
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// The term of half-arc h on side s of a patch, with its sign in equation 2 patch + s % 2. Beyond
// the border there is no equation.
struct SideTerm {
  Index equation = -1;
  int sign = 0;
};

// The network. The outside of the border is one node without an equation.
class FlowNetwork {
 public:
  // An edge. A unit of flow lowers the excess of one node and raises that of the other.
  struct Edge {
    Index from, to;
  };
  // A step to a node: one unit more on an edge (step 2 edge), or one less (step 2 edge + 1).
  struct Way {
    Index step, to;
  };

  explicit FlowNetwork(const TMesh& mesh);

  const std::vector<Edge>& edges() const { return edges_; }
  std::span<const Way> leaving(Index node) const {
    return {ways_.data() + begin_[node], ways_.data() + begin_[node + 1]};
  }
  Index start(Index step) const {
    return step % 2 == 0 ? edges_[step / 2].from : edges_[step / 2].to;
  }
  Index end(Index step) const { return start(step ^ 1); }
  Index node_count() const { return nodes_; }

 private:
  Index node(const SideTerm& term, int sign) const;

  Index nodes_;
  std::vector<Edge> edges_;  // 2 arc, and its mirror image 2 arc + 1
  std::vector<Way> ways_;    // steps by the node that they leave
  std::vector<std::size_t> begin_;
};

// Returns the reverse step.
constexpr Index undone(Index step) { return step ^ 1; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
