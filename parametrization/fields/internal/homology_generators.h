// The independent loops of a surface around which a field may turn by more than its cones say: two
// for every handle and one for every boundary loop but one; none on spheres and disks.
//
// A spanning tree of the faces crosses some edges; a spanning tree of the vertices (the boundary
// counted as one vertex) runs along others. Each edge left over closes one loop of faces. [EW05]
#pragma once

#include <vector>

#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

class TurningLoops {
 public:
  TurningLoops(const SurfaceMesh& mesh, const FieldGeometry& geometry);

  // Half-edges of the tree of faces, each from a face met before into a new one; from face 0.
  const std::vector<Index>& face_tree() const { return face_tree_; }
  // One half-edge of every edge that is in no tree: the loops.
  const std::vector<Index>& loops() const { return loops_; }
  // From values on the edges of loops(): values on all edges, 0 across the tree of faces, that add
  // up to 0 around every interior vertex. Opposite half-edges have opposite values. 3 #F.
  Vec close(const Vec& loop_values) const;

 private:
  void grow_face_tree();
  void grow_vertex_tree(const FieldGeometry& geometry);

  const SurfaceMesh& mesh_;
  std::vector<char> used_;  // 3 #F: edges of a tree
  std::vector<Index> face_tree_, loops_;
  std::vector<Index> vertex_tree_;  // half-edges into new vertices, from the root on
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
