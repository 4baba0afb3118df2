// Elements whose maps are Bernstein polynomials: polynomials on a cell (BernsteinBasis), the
// description of an element (BernsteinElement), and the space derived from it (BernsteinSpace).
//
// To add an element, describe it and derive its space from BernsteinSpace, like the tetrahedra,
// squares and triangles here (docs/elements.md). The constructor of the space checks the
// description.
//
//   Cells cells(1, 3);
//   cells << 0, 1, 2;
//   const BezierTriangleSpace triangles(cells, 3, 2);                    // of degree 2
//   const RowMatrix nodes = triangles.node_positions(RowMatrix::Random(3, 2));
//
// Rational functions, splines and other bases derive from ElementSpace instead.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "majorant/elements/element_space.h"
#include "majorant/framework/types.h"

namespace majorant {

using Exponents = std::array<int, 6>;  // of the homogeneous coordinates; unused ones are 0
using Degrees = std::vector<int>;      // of a polynomial space, one per factor

// Bernstein polynomials on any cell that is a simplex or a product of simplices.
//
// A cell has homogeneous coordinates: the barycentric ones of a triangle or a tetrahedron; 1-s, s,
// 1-t, t of a square. A basis function is weight * product of coordinates^exponents, where the
// weight is a product of one multinomial coefficient per factor simplex. The product of two
// functions is therefore a multiple of one function, and so is the derivative by a coordinate:
// every table of elements/ follows from lists of exponents.
class BernsteinBasis {
 public:
  // functions: in the given order; several polynomial spaces may follow each other. Throws
  // InvalidArgument for more than 6 coordinates and for weights beyond 2^53, which a double would
  // round.
  BernsteinBasis(Factors factors, std::vector<Exponents> functions);

  const Factors& factors() const { return factors_; }
  int coordinate_count() const { return coordinates_; }
  int count() const { return static_cast<int>(functions_.size()); }
  const Exponents& exponents(int k) const { return functions_[k]; }
  double weight(int k) const { return weights_[k]; }
  int find(const Exponents& e) const;  // -1 when no function has these exponents
  // Returns whether the function is 1 at a corner of the cell, so that its coefficient is the value
  // there.
  bool is_corner(int k) const;

  // Returns the values of all functions. point: barycentric coordinates of a simplex, (s, t) of a
  // square.
  Vec values(VecIn point) const;

 private:
  Factors factors_;
  int coordinates_;
  std::vector<Exponents> functions_;
  std::vector<double> weights_;
  std::map<Exponents, int> lookup_;
};

// A cut of a cell at the midpoint of the edge between homogeneous coordinates a and b. `first` is
// the child with vertex a, `second` the one with b. Their entries map each coordinate of the child
// to one of the parent, or to kMidpoint.
struct EdgeBisection {
  static constexpr int kMidpoint = -1;
  int a, b;
  std::vector<int> first, second;
};

// The data that distinguish one element type from another; it has no algorithms.
struct BernsteinElement {
  std::string_view name;  // of its space, for messages
  int degree;             // of the map
  int max_degree;
  Factors factors;  // 2 or 3 dimensions together
  // Returns the exponents of a polynomial space in the element's node order (VTK's), corners first,
  // each once, also for degrees that are 0 or differ between the factors.
  std::vector<Exponents> (*lattice)(const Degrees& degrees);
  // Pairs of homogeneous coordinates: the derivative by reference coordinate d is that by
  // coordinate [0] minus that by coordinate [1].
  std::vector<std::array<int, 2>> derivatives;
  std::vector<EdgeBisection> bisections;  // applied cyclically

  int dim() const { return static_cast<int>(derivatives.size()); }
  int corner_count() const;
  int coordinate_count() const;  // homogeneous ones
  double measure() const;        // of the reference cell

  Degrees degrees() const { return Degrees(factors.size(), degree); }
  // Returns lattice(of), which must name every function of the space once. Throws InvalidArgument.
  std::vector<Exponents> functions(const Degrees& of) const;
  BernsteinBasis basis(const Degrees& of) const { return {factors, functions(of)}; }
  // Returns the factor to which a homogeneous coordinate belongs.
  int factor_of(int coordinate) const;
  // Returns the degrees of the map's derivative by a coordinate of this factor.
  Degrees lowered(int factor) const;
};

// A numbering of nodes: vertices keep their numbers, followed by edges (from the smaller to the
// larger vertex), faces, and the interiors of cells.
struct NodeNumbering {
  Cells cells;  // #E by nodes per cell
  Index node_count = 0;
  std::vector<Index> boundary_nodes;  // on facets of only one cell, sorted
};

// The element space of any BernsteinElement. Derived classes add a constructor that describes the
// element, and members that only this element has.
class BernsteinSpace : public ElementSpace {
 public:
  int degree() const { return element_.degree; }
  int reference_dim() const final { return element_.dim(); }
  double reference_measure() const final { return element_.measure(); }
  const Cells& cells() const final { return numbering_.cells; }
  Index node_count() const final { return numbering_.node_count; }
  // Returns the number of vertices, which are the first nodes in the given order.
  Index vertex_count() const { return vertex_count_; }
  // Returns the nodes on facets that only one cell has, sorted.
  const std::vector<Index>& boundary_nodes() const { return numbering_.boundary_nodes; }
  // Returns the Bernstein polynomials of the nodes of a cell, to evaluate a map.
  const BernsteinBasis& basis() const { return basis_; }
  const BernsteinElement& element() const { return element_; }

  // Returns the control points of the map that takes vertex v to row v and is linear (on squares:
  // bilinear) on every cell. vertices: #V by d; returns #N by d. Throws InvalidArgument for another
  // #V.
  RowMatrix node_positions(const RowMatrix& vertices) const;

  // The following members throw InvalidArgument for the rule of another cell, an element out of
  // range, and fewer unknowns than the space has.
  ContractionTable tabulate(const Quadrature& rule) const final;
  // Returns a rule that is exact for |J|^2 where M is constant, so that only a constant map has J =
  // 0 at all of its points: one point if J is constant, otherwise exact_rule() for twice the degree
  // of J. If M varies, the rule is also exact for the rest determinant, as far as such rules exist.
  Quadrature default_rule(RestJacobian rest) const final;
  PositivityProof certify(Index e, VecIn x, int max_depth) const final;
  double largest_step(Index e, VecIn x, VecIn d, double s, int max_depth) const final;

 protected:
  // cells: #E by corners, positively oriented. Throws InvalidArgument for a degree outside
  // 1..max_degree, an invalid description, vertex numbers outside 0..vertex_count-1, a vertex twice
  // in a cell and facets of more than two cells.
  BernsteinSpace(const BernsteinElement& element, const Cells& cells, Index vertex_count);
  // Uses the caller's numbering of nodes, in which any node may be a vertex.
  BernsteinSpace(const BernsteinElement& element, NodeNumbering numbering);

 private:
  void require_element(Index e, VecIn x) const;
  struct Tables;  // of the element, independent of its cells

  BernsteinElement element_;
  Index vertex_count_;
  BernsteinBasis basis_;
  std::shared_ptr<const Tables> tables_;
  NodeNumbering numbering_;
};

// Returns first-order and product tables of an element on a rule, from its exponents (method.md
// section 4): a derivative lowers one exponent, a product adds exponents. Directions are the
// barycentric ones of a simplex, the reference ones of a product of simplices. Throws
// InvalidArgument for the rule of another cell.
ContractionTable contraction_table(const BernsteinElement& element, const Quadrature& rule);

// Continuous piecewise polynomial maps: a Bezier triangle of degree n on every face of a mesh.
//
// Faces share control points around a vertex or an edge, so every assignment of positions is a C0
// map; cuts are edges of the mesh that faces do not share. Nodes are numbered: vertices, then edges
// (n-1 each, from the smaller to the larger vertex), then faces. [MC20] Sec. 4.

using LatticeNumbering = NodeNumbering;
// Returns a shared numbering of the points (i,j,k)/n of every face, for any n >= 1: vertices keep
// their numbers, then edges, then face interiors; local order is VTK's. Throws InvalidArgument if
// an edge has more than two faces.
LatticeNumbering number_lattice(const Cells& faces, Index vertex_count, int n);

class BezierTriangleSpace final : public BernsteinSpace {
 public:
  // The highest degree of any map. Chosen, not tuned.
  static constexpr int kMaxDegree = 8;

  // faces: #F by 3 vertex numbers, counterclockwise, consistently oriented and edge-manifold;
  // vertices 0..vertex_count-1. Throws InvalidArgument if the degree is not 1..8, for other vertex
  // numbers, or if an edge has more than two faces.
  BezierTriangleSpace(const Cells& faces, Index vertex_count, int degree);

  // Takes faces whose nodes the caller has numbered (#F by (n+1)(n+2)/2, corners first), as part of
  // a larger numbering, such as that of a map and its scaffold. Vertices are not the first nodes
  // then, so functions that refer to vertices of a space do not apply. Throws InvalidArgument for a
  // wrong number of columns.
  BezierTriangleSpace(NodeNumbering numbering, int degree);

  const Cells& faces() const { return degree() == 1 ? cells() : faces_; }

  // Returns the control points of the same map in `higher`, a space of degree + 1 over the same
  // faces. x: 2 numbers per node.
  Vec elevate(VecIn x, const BezierTriangleSpace& higher) const;

 private:
  Cells faces_;  // empty at degree 1, where they are the cells
};

// Returns the degree + 1 nodes of the space along a half-edge, from its start to its end. Half-edge
// 3 f + k runs from corner k of face f to its corner k + 1 (mod 3), as in mesh/surface_mesh.h.
std::vector<Index> edge_nodes(const BezierTriangleSpace& space, Index half_edge);

// Continuous piecewise polynomial maps of space: a Bezier tetrahedron of degree n on every cell.
//
//   Cells cells(1, 4);
//   cells << 0, 1, 2, 3;
//   RowMatrix vertices = RowMatrix::Random(4, 3);
//   BezierTetrahedronSpace space(cells, 4, 2);
//   RowMatrix start = space.node_positions(vertices);     // the identity, one row per node
//
// Nodes are numbered: vertices, edges, faces, interiors. det J has degree 3(n-1).

class BezierTetrahedronSpace final : public BernsteinSpace {
 public:
  // The highest degree, at which det J has degree 15, as on squares of degree 8. Chosen, not tuned.
  static constexpr int kMaxDegree = 6;

  // cells: #E by 4 vertex numbers, positively oriented: det(p1 - p0, p2 - p0, p3 - p0) > 0, also
  // the reference coordinates. Nodes of a cell are in VTK's order; quadrature points barycentric.
  // Throws InvalidArgument when degree is not 1..6, for vertex numbers outside
  // 0..vertex_count-1 and when a face has more than two cells.
  BezierTetrahedronSpace(const Cells& cells, Index vertex_count, int degree);
};

// Continuous piecewise polynomial maps of tensor-product patches: Bernstein polynomials of degree n
// in each of s, t in [0, 1] on every quadrilateral.
//
//   Cells cells(1, 4);
//   cells << 0, 1, 2, 3;
//   RowMatrix vertices(4, 2);
//   vertices << 0, 0, 1, 0, 0, 1, 1, 1;
//   BezierQuadSpace space(cells, 4, 1);                   // bilinear
//   RestShapes rest = curved_shapes(space, space.node_positions(vertices), tensor_gauss_rule(3));
//
// Nodes are numbered: vertices, edges, interiors. det J has degree 2n-1 in s and in t.

class BezierQuadSpace final : public BernsteinSpace {
 public:
  static constexpr int kMaxDegree = BezierTriangleSpace::kMaxDegree;

  // cells: #E by 4 vertex numbers, counterclockwise: (s,t) = (0,0), (1,0), (1,1), (0,1). Nodes of a
  // cell are in VTK's order; quadrature points are (s, t), which are the reference coordinates.
  // Throws InvalidArgument when degree is not 1..8, for vertex numbers outside
  // 0..vertex_count-1 and when an edge has more than two cells.
  BezierQuadSpace(const Cells& cells, Index vertex_count, int degree);
};

// Continuous piecewise polynomial maps of space: Bernstein polynomials of degree n in each of r, s,
// t in [0, 1] on every hexahedron.
//
//   Cells cells(1, 8);
//   cells << 0, 1, 3, 2, 4, 5, 7, 6;
//   RowMatrix vertices(8, 3);
//   for (Index v = 0; v < 8; ++v) vertices.row(v) << v % 2, v / 2 % 2, v / 4;
//   const BezierHexahedronSpace space(cells, 8, 2);                     // of degree 2
//   const RowMatrix start = space.node_positions(vertices);             // trilinear, a row a node
//
// Nodes are numbered: vertices, edges, faces, interiors. det J has degree 3n-1 in each of r, s, t.

class BezierHexahedronSpace final : public BernsteinSpace {
 public:
  // The highest degree, at which det J has 1728 coefficients. Chosen, not tuned.
  static constexpr int kMaxDegree = 4;

  // cells: #E by 8 vertex numbers: (r,s,t) = (0,0,0), (1,0,0), (1,1,0), (0,1,0), then the same at
  // t = 1. Nodes of a cell are in VTK's order (of 9.1 and later); quadrature points are (r, s, t),
  // which are the reference coordinates. Throws InvalidArgument when degree is not 1..4, for
  // vertex numbers outside 0..vertex_count-1 and when a face has more than two cells.
  BezierHexahedronSpace(const Cells& cells, Index vertex_count, int degree);
};

// Continuous piecewise polynomial maps of space: on every wedge, Bernstein polynomials of degree n
// on the triangle times those of degree n in t in [0, 1]. Nodes are numbered as those of hexahedra.
// det J has degree 3n-2 on the triangle and 3n-1 in t.

class BezierWedgeSpace final : public BernsteinSpace {
 public:
  static constexpr int kMaxDegree = BezierHexahedronSpace::kMaxDegree;

  // cells: #E by 6 vertex numbers: corners 0, 1, 2 of the triangle at t = 0, then at t = 1;
  // det(p1 - p0, p2 - p0, p3 - p0) > 0, also the reference coordinates. Nodes of a cell are in
  // VTK's order; quadrature points are the barycentric ones of the triangle, then t. Throws
  // InvalidArgument when degree is not 1..4, for vertex numbers outside 0..vertex_count-1 and when
  // a face has more than two cells.
  BezierWedgeSpace(const Cells& cells, Index vertex_count, int degree);
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
