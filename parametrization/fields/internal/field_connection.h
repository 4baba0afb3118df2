// A cross field with its matching, in a form that can be edited: the angles of its branches, and a
// rotation for every interior edge. The rotation takes the branch of one face, transported and
// rotated by the quarter turns of the matching, to the branch of the other face.
//
// These rotations determine the topology: the quarter turns of every vertex,
//     (pi / 2) quarter_turns[v] = angle sum of v - sum of the rotations counterclockwise around v,
// and the turning along every loop. move_quarter() changes it by integers. Relaxation makes the
// field as smooth as possible without changing it (a trivial connection, [CDS10]).
#pragma once

#include <optional>
#include <vector>

#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

struct FieldConnection {
  Vec angle;     // #F: as in CrossField
  Vec rotation;  // 3 #F: opposite half-edges have opposite values; 0 at the boundary
  std::vector<int> quarter_turns;  // #V: as in CrossField
};

// Returns a field with these angles in which every branch is matched with the nearest one of the
// neighbour.
FieldConnection nearest_matching(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                 const Vec& angle);

// Returns the quarter turns of every vertex, from angles and rotations. Throws Error(Invalid) if
// they are not integers, so that the rotations belong to no cross field.
std::vector<int> count_quarter_turns(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                     const Vec& rotation);

// Matches the two faces of half-edge h with one more quarter turn. It passes from the vertex where
// h starts to the one where h ends; the boundary holds any number.
void move_quarter(const SurfaceMesh& mesh, const FieldGeometry& geometry, Index half_edge,
                  FieldConnection& field);

// Makes a field as smooth as its topology allows: rotates the branches by the angles a that
// minimize
//     sum over edges weight rotation^2 + sum over faces hold a^2.
// Needs one factorization, and a solve per field.
class Relaxation {
 public:
  // hold: #F, >= 0, infinity for faces that must not turn. If all are 0, the rotation of the whole
  // field is free, and a adds up to 0, weighted by area.
  Relaxation(const SurfaceMesh& mesh, const FieldGeometry& geometry, const Vec& hold);
  void apply(Vec& angle, Vec& rotation) const;  // #F, 3 #F

 private:
  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  bool is_free_;
  std::vector<Index> row_;  // per face, -1 where it must not turn
  std::optional<SparseSpd> system_;
};

CrossField cross_field(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                       const FieldConnection& field);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
