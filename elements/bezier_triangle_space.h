// Continuous piecewise polynomial maps: a Bezier triangle of degree n on every face of a mesh.
//
// Control points are shared by the faces around a vertex or an edge, so every assignment of
// positions is a C0 map; cuts are edges of the mesh that faces do not share. Nodes are numbered:
// vertices, then edges (n-1 each, from the smaller to the larger vertex), then faces. [MC20]
// Sec. 4.
#pragma once

#include <span>

#include "majorant/elements/element_space.h"

namespace majorant {

// Shared numbering of the points (i,j,k)/n of every face: vertices keep their numbers, then edges,
// then face interiors; local order is VTK's. Any n >= 1. Throws std::invalid_argument when an edge
// has more than two faces.
struct LatticeNumbering {
  Cells cells;  // #F by (n+1)(n+2)/2
  Index node_count = 0;
  std::vector<Index> boundary_nodes;  // on edges of one face, ends included, sorted
};
LatticeNumbering number_lattice(const Cells& faces, Index vertex_count, int n);

class BezierTriangleSpace final : public ElementSpace {
 public:
  static constexpr int kMaxDegree = 8;

  // faces: #F by 3 vertex numbers, counterclockwise, consistently oriented and edge-manifold;
  // vertices 0..vertex_count-1. Throws std::invalid_argument when degree is not 1..8 or an edge has
  // more than two faces.
  BezierTriangleSpace(const Cells& faces, Index vertex_count, int degree);

  int degree() const { return degree_; }
  int reference_dim() const override { return 2; }
  double reference_measure() const override { return 0.5; }
  const Cells& cells() const override { return numbering_.cells; }
  Index node_count() const override { return numbering_.node_count; }
  Index vertex_count() const { return vertex_count_; }
  const Cells& faces() const { return faces_; }
  // Nodes on edges that only one face has, ends included, sorted.
  const std::vector<Index>& boundary_nodes() const { return numbering_.boundary_nodes; }

  ContractionTable tabulate(const Quadrature& rule) const override;
  PositivityProof certify(Index e, VecIn x, int max_depth) const override;
  double largest_step(Index e, VecIn x, VecIn d, double s, int max_depth) const override;

  // Control points of the same map in `higher`, a space of degree + 1 over the same faces.
  // x: 2 numbers per node.
  Vec elevate(VecIn x, const BezierTriangleSpace& higher) const;

 private:
  // 2 numbers per local node of element e.
  void gather(Index e, VecIn x, double* local) const;

  Cells faces_;
  Index vertex_count_;
  int degree_;
  LatticeNumbering numbering_;
};

}  // namespace majorant
