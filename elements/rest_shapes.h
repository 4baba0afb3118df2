// Rest shapes: the shapes of the elements against which distortion is measured.
//
//   auto flat = flat_triangles(mesh->positions(), mesh->faces());   // a surface of flat triangles
//   const RowMatrix nodes = space->node_positions(mesh->positions());
//   auto curved = curved_shapes(*space, nodes, rule);               // nodes of any element space
//
// J = (d image / d reference) M, where M is the inverse Jacobian of the rest shape (reference
// coordinates -> orthonormal frame of the rest shape).
//
// For surfaces from repair(), whose faces may have no area, use rest_shapes()
// (maps/rest_shapes_of.h).
#pragma once

#include <optional>

#include "majorant/elements/element_space.h"

namespace majorant {

struct RestShapes {
  int dim = 2;        // D, the reference dimension
  RowMatrix inverse;  // #E by D^2: M row by row, constant on each element; no rows: see nodes
  Vec measure;        // #E: area or volume, model units
  RowMatrix nodes;    // #N by d >= D: rest position of every node if M varies; else no rows
  bool curved() const { return nodes.rows() > 0; }
  RestJacobian jacobian() const {
    return curved() ? RestJacobian::Varying : RestJacobian::Constant;
  }

  // Returns M of element e as a D by D matrix; only if it is constant.
  Eigen::Map<const RowMatrix> inverse_of(Index e) const {
    return {inverse.row(e).data(), dim, dim};
  }
};

// Returns the shapes of flat simplices, one per row of D+1 vertex numbers: triangles in the plane
// or in space (D = 2), tetrahedra in space (D = 3). positions: #V by d.
//
// Reference coordinates are those of the spaces: tangents p0 - p2 and p1 - p2 of a triangle, p1 -
// p0, p2 - p0, p3 - p0 of a tetrahedron. If d = D the frame is that of the positions, else p0 - p2
// lies along the first axis ([MC20] Eq. 5 and 6).
//
// A cell without a measure has measure 0 and an inverse that is not finite; terms refuse it. Throws
// InvalidArgument for vertices that do not exist and positions that are not finite.
RestShapes flat_simplices(const RowMatrix& positions, const Cells& cells);

// Returns flat_simplices() of triangles in space: positions #V by 3, faces #F by 3.
RestShapes flat_triangles(const Points3& positions, const Cells& faces);

// Returns the components of a vector in space in the frame of a triangle of flat_triangles(). None
// for a vector that is not finite or normal to the triangle, and for a triangle without a plane.
std::optional<Eigen::RowVector2d> tangent_part(const Points3& positions, const Cells& faces,
                                               Index face, const Vector3& vector);

// Returns the components of vectors in space, one per triangle, in the frames of flat_triangles():
// #F by 2, without their normal parts. vectors: #F by 3. Throws InvalidArgument for another number
// of vectors, a triangle without a plane, or a vector without a tangent part.
RowMatrix in_frames(const Points3& positions, const Cells& faces, const Points3& vectors);

// Returns the same shapes in other frames. The first axis is along first_axes (#E by D, of any
// length, in the frames of `rest`); the others are normal to it, in three dimensions any two. An
// energy of J sees fibres this way: column 0 of J is their image. Throws InvalidArgument for curved
// shapes, for other sizes, and for axes that are zero or not finite.
//
//   const RowMatrix fibres = in_frames(mesh->positions(), mesh->faces(), directions);
//   auto term = make_energy(space, turned(rest, fibres), shear);
RestShapes turned(RestShapes rest, const RowMatrix& first_axes);

// Returns rest shapes that are themselves images of the reference element. positions: #N by d, of
// the space's nodes, d >= D. rule: integrates the measures. If d > D, frames are made from the
// tangents by Gram-Schmidt, the first tangent along the first axis. Throws InvalidArgument unless
// there is a finite position for every node, and for the rule of another cell.
RestShapes curved_shapes(const ElementSpace& space, const RowMatrix& positions,
                         const Quadrature& rule);

// Returns M (D by D) and det of the rest shape of element e at every point of a tabulated rule, M
// first, row by row: D^2 + 1 numbers per point. Points at which the rest shape is degenerate give
// inf or NaN.
RowMatrix tabulate_rest(const RestShapes& rest, const ElementSpace& space,
                        const ContractionTable& table, Index e);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
