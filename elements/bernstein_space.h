// The element space of any BernsteinElement: everything but the description of the element.
//
// Derived classes add a constructor that describes it, and what only they have.
#pragma once

#include <memory>
#include <vector>

#include "majorant/elements/bernstein_element.h"
#include "majorant/elements/element_space.h"

namespace majorant {

// Vertices keep their numbers, then come edges (from the smaller to the larger vertex), then faces,
// then the interiors of cells.
struct NodeNumbering {
  Cells cells;  // #E by nodes per cell
  Index node_count = 0;
  std::vector<Index> boundary_nodes;  // on facets of one cell, sorted
};

class BernsteinSpace : public ElementSpace {
 public:
  int degree() const { return element_.degree; }
  int reference_dim() const final { return element_.dim(); }
  double reference_measure() const final { return element_.measure(); }
  const Cells& cells() const final { return numbering_.cells; }
  Index node_count() const final { return numbering_.node_count; }
  // Vertices are the first nodes, in the order they were given.
  Index vertex_count() const { return vertex_count_; }
  // Nodes on facets that only one cell has, sorted.
  const std::vector<Index>& boundary_nodes() const { return numbering_.boundary_nodes; }
  // Bernstein polynomials of the nodes of a cell, to evaluate a map.
  const BernsteinBasis& basis() const { return basis_; }
  const BernsteinElement& element() const { return element_; }

  // Control points of the map that takes vertex v to row v and is linear (on squares: bilinear) on
  // every cell. vertices: #V by d; returns #N by d. Throws InvalidArgument for another #V.
  RowMatrix node_positions(const RowMatrix& vertices) const;

  // These throw InvalidArgument for the rule of another cell, an element that does not exist and
  // fewer unknowns than the space has.
  ContractionTable tabulate(const Quadrature& rule) const final;
  // Exact for |J|^2 where M is constant, so that no map but a constant one has a J of 0 at all of
  // its points: one point where J is constant, else exact_rule() for twice the degree of J, and for
  // the rest determinant where M varies; as exact as there are rules.
  Quadrature default_rule(RestJacobian rest) const final;
  PositivityProof certify(Index e, VecIn x, int max_depth) const final;
  double largest_step(Index e, VecIn x, VecIn d, double s, int max_depth) const final;

 protected:
  // cells: #E by corners, positively oriented. Throws InvalidArgument for a degree outside
  // 1..max_degree, a description that is wrong, vertex numbers outside 0..vertex_count-1, a vertex
  // twice in a cell and facets of more than two cells.
  BernsteinSpace(const BernsteinElement& element, const Cells& cells, Index vertex_count);
  // With nodes numbered by the caller: any node may be a vertex.
  BernsteinSpace(const BernsteinElement& element, NodeNumbering numbering);

 private:
  void require_element(Index e, VecIn x) const;
  struct Tables;  // of the element, whatever its cells

  BernsteinElement element_;
  Index vertex_count_;
  BernsteinBasis basis_;
  std::shared_ptr<const Tables> tables_;
  NodeNumbering numbering_;
};

// First-order and product tables of an element on a rule, from its exponents (method.md section 4):
// a derivative lowers one exponent, a product adds exponents. Directions: the barycentric ones of
// a simplex, the reference ones of a product of simplices. Throws InvalidArgument for the
// rule of another cell.
ContractionTable contraction_table(const BernsteinElement& element, const Quadrature& rule);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
