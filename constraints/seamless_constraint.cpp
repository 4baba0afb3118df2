#include "majorant/constraints/seamless_constraint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace majorant {
namespace {

// i^k (u, v) by components: component c is factor * (u, v)[from].
struct Turned {
  int from;
  long factor;
};
Turned turned(int turns, int c) {
  constexpr Turned kTable[4][2] = {
      {{0, 1}, {1, 1}}, {{1, -1}, {0, 1}}, {{0, -1}, {1, -1}}, {{1, 1}, {0, -1}}};
  return kTable[turns][c];
}

struct NodePair {
  Index side, opposite, edge;
};

// The pairs of nodes that a chain joins, each once.
std::vector<std::vector<NodePair>> pairs_by_chain(const BezierTriangleSpace& space,
                                                  const Seams& seams) {
  std::vector<std::vector<NodePair>> pairs(static_cast<std::size_t>(seams.chain_count()));
  for (std::size_t e = 0; e < seams.edges().size(); ++e) {
    const SeamEdge& edge = seams.edges()[e];
    const std::vector<Index> a = edge_nodes(space, edge.side);
    const std::vector<Index> b = edge_nodes(space, edge.opposite);
    for (std::size_t i = 0; i < a.size(); ++i)
      pairs[static_cast<std::size_t>(edge.chain)].push_back(
          {a[i], b[a.size() - 1 - i], static_cast<Index>(e)});
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

SeamlessConstraint::SeamlessConstraint(std::shared_ptr<const BezierTriangleSpace> space,
                                       std::shared_ptr<const Seams> seams)
    : space_(std::move(space)), seams_(std::move(seams)) {}

void SeamlessConstraint::append_rows(ConstraintRows& rows) const {
  const auto vertex = [&](Index half_edge, int end) {
    const Index cut = space_->cells()(half_edge / 3, (half_edge + end) % 3);
    return seams_->surface_vertex()[static_cast<std::size_t>(cut)];
  };
  for (const auto& pairs : pairs_by_chain(*space_, *seams_)) {
    const Index half_translation[2] = {rows.add_auxiliary(), rows.add_auxiliary()};
    for (const NodePair& p : pairs) {
      const SeamEdge& edge = seams_->edges()[static_cast<std::size_t>(p.edge)];
      for (int c = 0; c < 2; ++c) {
        const Turned t = turned(edge.turns, c);
        rows.begin_row(fmt::format("{} of the seam at edge ({}, {})", c == 0 ? 'u' : 'v',
                                   vertex(edge.side, 0), vertex(edge.side, 1)));
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
  std::vector<char> is_seam(static_cast<std::size_t>(3 * space.element_count()), 0);
  for (const SeamEdge& edge : seams.edges())
    is_seam[static_cast<std::size_t>(edge.side)] =
        is_seam[static_cast<std::size_t>(edge.opposite)] = 1;
  // Half-edges by their undirected edge: those alone there lie on the boundary of the space.
  using Key = std::array<Index, 3>;  // smaller vertex, larger vertex, half-edge
  std::vector<Key> keys;
  for (Index h = 0; h < 3 * space.element_count(); ++h) {
    const Index a = space.faces()(h / 3, h % 3), b = space.faces()(h / 3, (h + 1) % 3);
    keys.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(keys.begin(), keys.end());
  const auto same = [&](std::size_t i, std::size_t j) {
    return j < keys.size() && keys[i][0] == keys[j][0] && keys[i][1] == keys[j][1];
  };
  std::vector<Index> nodes;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (same(k, k + 1) || (k > 0 && same(k, k - 1)) ||
        is_seam[static_cast<std::size_t>(keys[k][2])])
      continue;
    for (const Index node : edge_nodes(space, keys[k][2])) nodes.push_back(node);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

SeamMismatch worst_seam_edge(const BezierTriangleSpace& space, const Seams& seams, VecIn x) {
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
