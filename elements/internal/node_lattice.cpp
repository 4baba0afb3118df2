#include "majorant/elements/internal/node_lattice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/pair_order.h"

namespace majorant {
namespace {

constexpr std::size_t kMaxCorners = 4;  // of a part

// A part of a cell: a vertex, edge or face. Parts of different cells are equal if their vertices
// are.
struct Side {
  std::array<Index, kMaxCorners> vertices;  // ascending, -1 for none
  Index cell;
  std::uint16_t corners, part;
};

Side make_side(const Cells& cells, Index cell, std::size_t number, const NodeLattice::Part& part) {
  Side side{{},
            cell,
            static_cast<std::uint16_t>(part.corners.size()),
            static_cast<std::uint16_t>(number)};
  side.vertices.fill(-1);
  for (std::size_t k = 0; k < side.corners; ++k) {  // insertion sort
    const Index v = cells(cell, part.corners[k]);
    std::size_t at = k;
    for (; at > 0 && side.vertices[at - 1] > v; --at) side.vertices[at] = side.vertices[at - 1];
    side.vertices[at] = v;
  }
  return side;
}

enum class SharedEdges { Visited, LeftOut };  // treatment of edges of two cells

// Calls visit(sides) with the sides of each part that cells share, ordered by corners, vertices,
// cell and part.
template <class Visit>
void for_each_part(const NodeLattice& lattice, const Cells& cells, Index vertex_count,
                   SharedEdges shared_edges, const Visit& visit) {
  const std::vector<NodeLattice::Part>& parts = lattice.parts();
  const auto per_cell = static_cast<Index>(parts.size());
  const auto count = per_cell * static_cast<Index>(cells.rows());
  const auto side = [&](Index k) {
    return make_side(cells, k / per_cell, to_size(k % per_cell), parts[k % per_cell]);
  };
  std::vector<Side> sides;
  for (std::size_t corners = 1; corners <= kMaxCorners; ++corners) {
    if (std::none_of(parts.begin(), parts.end(),
                     [&](const auto& part) { return part.corners.size() == corners; }))
      continue;
    const auto pair_of = [&](Index cell, Index part) {
      const std::vector<int>& of_part = parts[part].corners;
      if (of_part.size() != corners) return std::pair(Index{-1}, Index{-1});
      if (corners == 2) {
        const auto [low, high] = std::minmax({cells(cell, of_part[0]), cells(cell, of_part[1])});
        return std::pair(low, high);
      }
      const Side s = make_side(cells, cell, to_size(part), parts[part]);
      return std::pair(s.vertices[0], s.vertices[1]);
    };
    // For triangles the divisor is a constant, so that dividing is cheap.
    const PairOrder order =
        per_cell == 3
            ? PairOrder(vertex_count, count, [&](Index k) { return pair_of(k / 3, k % 3); })
            : PairOrder(vertex_count, count,
                        [&](Index k) { return pair_of(k / per_cell, k % per_cell); });
    order.for_each_run([&](std::span<const PairOrder::Entry> run) {
      if (corners == 2 && run.size() == 2 && shared_edges == SharedEdges::LeftOut) return;
      sides.clear();
      for (const auto& [ignored, k] : run) sides.push_back(side(k));
      if (corners > 2)
        std::stable_sort(sides.begin(), sides.end(),
                         [](const Side& a, const Side& b) { return a.vertices < b.vertices; });
      for (std::span<const Side> left = sides; !left.empty();) {
        std::size_t size = 1;
        while (size < left.size() && left[size].vertices == left[0].vertices) ++size;
        visit(left.first(size));
        left = left.subspan(size);
      }
    });
  }
}

// Returns the nodes inside a part in the order that its corners give: large weights on the first
// corners first.
std::vector<int> ordered_nodes(const NodeLattice& lattice, const NodeLattice::Part& part,
                               const std::vector<int>& corners) {
  std::vector<int> nodes = part.nodes;
  std::sort(nodes.begin(), nodes.end(), [&](int a, int b) {
    for (const int c : corners)
      if (lattice.weight(a, c) != lattice.weight(b, c))
        return lattice.weight(a, c) > lattice.weight(b, c);
    return false;
  });
  return nodes;
}

// The order of the nodes of each part when its corners are in the order of their vertices. The
// orders of edges are computed once.
class NodeOrder {
 public:
  NodeOrder(const NodeLattice& lattice, const Cells& cells) : lattice_(lattice), cells_(cells) {
    for (const NodeLattice::Part& part : lattice.parts()) {
      auto& [forward, backward] = of_edges_.emplace_back();
      if (part.corners.size() != 2) continue;
      forward = ordered_nodes(lattice, part, part.corners);
      backward = ordered_nodes(lattice, part, {part.corners[1], part.corners[0]});
    }
  }

  const std::vector<int>& of(const Side& side) {
    const NodeLattice::Part& part = lattice_.parts()[side.part];
    const auto vertex = [&](int corner) { return cells_(side.cell, corner); };
    const auto& [forward, backward] = of_edges_[side.part];
    if (part.corners.size() == 2)
      return vertex(part.corners[0]) < vertex(part.corners[1]) ? forward : backward;
    std::vector<int> corners = part.corners;
    std::sort(corners.begin(), corners.end(), [&](int a, int b) { return vertex(a) < vertex(b); });
    return last_ = ordered_nodes(lattice_, part, corners);
  }

 private:
  const NodeLattice& lattice_;
  const Cells& cells_;
  // The nodes of each part for its two corners in their order, and reversed.
  std::vector<std::array<std::vector<int>, 2>> of_edges_;
  std::vector<int> last_;
};

void check_cells(const NodeLattice& lattice, const Cells& cells, Index vertex_count,
                 std::string_view name) {
  if (cells.cols() != lattice.corner_count())
    throw InvalidArgument(fmt::format("{}: cells have {} columns, expected {}", name, cells.cols(),
                                      lattice.corner_count()));
  for (Index e = 0; e < cells.rows(); ++e)
    for (int k = 0; k < lattice.corner_count(); ++k) {
      const Index v = cells(e, k);
      if (v < 0 || v >= vertex_count)
        throw InvalidArgument(fmt::format("{}: cell {} has vertex {}, there are {} vertices", name,
                                          e, v, vertex_count));
      for (int j = 0; j < k; ++j)
        if (cells(e, j) == v)
          throw InvalidArgument(fmt::format("{}: cell {} has vertex {} twice", name, e, v));
    }
}

}  // namespace

NodeLattice::NodeLattice(const BernsteinBasis& nodes) {
  int corners = 0;
  while (corners < nodes.count() && nodes.is_corner(corners)) ++corners;
  weights_.resize(nodes.count(), corners);
  const auto size = to_size(nodes.coordinate_count());
  for (int l = 0; l < nodes.count(); ++l)
    for (int c = 0; c < corners; ++c) {
      int weight = 1;
      for (std::size_t k = 0; k < size; ++k)
        if (nodes.exponents(c)[k] > 0) weight *= nodes.exponents(l)[k];
      weights_(l, c) = weight;
    }
  for (std::size_t k = 0; k < size; ++k) {  // facets: one coordinate is zero
    std::vector<int> facet, closure;
    for (int l = 0; l < nodes.count(); ++l)
      if (nodes.exponents(l)[k] == 0) (l < corners ? facet : closure).push_back(l);
    Part& part = part_of(facet);
    part.closure = facet;
    part.closure.insert(part.closure.end(), closure.begin(), closure.end());
  }
  for (int l = corners; l < nodes.count(); ++l) {
    std::vector<int> support;
    for (int c = 0; c < corners; ++c)
      if (weights_(l, c) > 0) support.push_back(c);
    (static_cast<int>(support.size()) == corners ? interior_ : part_of(support).nodes).push_back(l);
  }
}

NodeLattice::Part& NodeLattice::part_of(const std::vector<int>& corners) {
  for (Part& part : parts_)
    if (part.corners == corners) return part;
  return parts_.emplace_back(Part{corners, {}, {}});
}

Index with_more_nodes(Index nodes, std::size_t more) {
  return counted("nodes", to_size(nodes) + more, 3);
}

NodeNumbering number_nodes(const NodeLattice& lattice, const Cells& cells, Index vertex_count,
                           std::string_view name) {
  require_at_least(fmt::format("{}: the number of vertices", name), vertex_count, 0);
  check_cells(lattice, cells, vertex_count, name);
  NodeNumbering out;
  out.cells.resize(cells.rows(), lattice.node_count());
  out.cells.leftCols(cells.cols()) = cells;
  out.node_count = with_more_nodes(0, to_size(vertex_count));
  NodeOrder order(lattice, cells);
  std::vector<Side> outer;
  // Edges that are shared by two cells need a visit only if they have nodes to be numbered.
  const bool has_nodes = std::ranges::any_of(
      lattice.parts(), [](const NodeLattice::Part& part) { return !part.nodes.empty(); });
  const SharedEdges shared = has_nodes ? SharedEdges::Visited : SharedEdges::LeftOut;
  for_each_part(lattice, cells, vertex_count, shared, [&](std::span<const Side> sides) {
    const Side& first = sides.front();
    const NodeLattice::Part& part = lattice.parts()[first.part];
    const bool facet = !part.closure.empty();
    if (facet && sides.size() > 2)
      throw InvalidArgument(
          fmt::format("{}: facet ({}) has {} cells, at most 2 are possible", name,
                      fmt::join(first.vertices.begin(),
                                first.vertices.begin() + static_cast<long>(first.corners), ", "),
                      sides.size()));
    if (facet && sides.size() == 1) outer.push_back(first);
    const Index before = out.node_count;
    out.node_count = with_more_nodes(before, part.nodes.size());
    if (part.nodes.empty()) return;
    for (const Side& side : sides) {
      Index node = before;
      for (const int l : order.of(side)) out.cells(side.cell, l) = node++;
    }
  });
  Index node = out.node_count;
  out.node_count =
      with_more_nodes(node, static_cast<std::size_t>(cells.rows()) * lattice.interior().size());
  for (Index e = 0; e < cells.rows(); ++e)
    for (const int l : lattice.interior()) out.cells(e, l) = node++;
  for (const Side& side : outer)
    for (const int l : lattice.parts()[side.part].closure)
      out.boundary_nodes.push_back(out.cells(side.cell, l));
  std::vector<Index>& boundary = out.boundary_nodes;
  std::sort(boundary.begin(), boundary.end());
  boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
