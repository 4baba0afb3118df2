// Rest shapes: the shapes of the elements that a map is measured against.
//
//   auto flat = flat_triangles(mesh->positions(), mesh->faces());   // a surface of flat triangles
//   const RowMatrix nodes = space->node_positions(mesh->positions());
//   auto curved = curved_shapes(*space, nodes, rule);               // nodes of any element space
//
// J = (d image / d reference) M, M the inverse Jacobian of the rest shape (reference coordinates ->
// orthonormal frame of the rest shape).
//
// Not for surfaces that repair() made, whose faces may have no area: rest_shapes()
// (maps/rest_shapes_of.h) knows these.
#pragma once

#include <optional>

#include "majorant/elements/element_space.h"

namespace majorant {

struct RestShapes {
  int dim = 2;        // D, the reference dimension
  RowMatrix inverse;  // #E by D^2: M row by row, constant on each element; no rows: see nodes
  Vec measure;        // #E: area or volume, model units
  RowMatrix nodes;    // #N by d >= D: rest position of every node, where M varies; else no rows
  bool curved() const { return nodes.rows() > 0; }
  RestJacobian jacobian() const {
    return curved() ? RestJacobian::Varying : RestJacobian::Constant;
  }

  // M of element e as a D by D matrix; only where it is constant.
  Eigen::Map<const RowMatrix> inverse_of(Index e) const {
    return {inverse.row(e).data(), dim, dim};
  }
};

// Flat simplices, one per row of D+1 vertex numbers: triangles in the plane or in space (D = 2),
// tetrahedra in space (D = 3), reference coordinates as in their spaces: tangents p0 - p2 and p1 -
// p2 of a triangle, p1 - p0, p2 - p0, p3 - p0 of a tetrahedron. positions: #V by d. Where d = D the
// frame is that of the positions, else p0 - p2 along the first axis ([MC20] Eq. 5 and 6). A cell
// without a measure has measure 0 and an inverse that is not finite; terms refuse it. Throws
// InvalidArgument for vertices that do not exist and positions that are not finite.
RestShapes flat_simplices(const RowMatrix& positions, const Cells& cells);

// flat_simplices of triangles in space: positions #V by 3, faces #F by 3.
RestShapes flat_triangles(const Points3& positions, const Cells& faces);

// The components of a vector in space in the frame of a triangle, as flat_triangles() has it: none
// for a vector that is not finite or along the normal, and for a triangle without a plane.
std::optional<Eigen::RowVector2d> tangent_part(const Points3& positions, const Cells& faces,
                                               Index face, const Vector3& vector);

// Vectors in space, one a triangle, as the frames of flat_triangles() see them: #F by 2; what they
// have along the normal is left out. vectors: #F by 3. Throws InvalidArgument unless there is
// one a triangle, and for a triangle without a plane or a vector without a tangent part.
RowMatrix in_frames(const Points3& positions, const Cells& faces, const Points3& vectors);

// The same shapes in other frames: the first axis along first_axes (#E by D, of any length, in the
// frames of `rest`), the others normal to it; in three dimensions any two. How an energy of J is
// told of fibres: column 0 of J is their image. Throws InvalidArgument for curved shapes, for
// other sizes, and for axes that are zero or not finite.
//
//   const RowMatrix fibres = in_frames(mesh->positions(), mesh->faces(), directions);
//   auto term = make_energy(space, turned(rest, fibres), shear);
RestShapes turned(RestShapes rest, const RowMatrix& first_axes);

// Rest shapes that are themselves images of the reference element: positions #N by d of the space's
// nodes, d >= D. `rule` integrates the measures. Where d > D, frames are made from the tangents by
// Gram-Schmidt, the first tangent along the first axis. Throws InvalidArgument unless there is a
// finite position for every node, and for the rule of another cell.
RestShapes curved_shapes(const ElementSpace& space, const RowMatrix& positions,
                         const Quadrature& rule);

// M (D by D) and det of the rest shape of element e at every point of a tabulated rule, M first,
// row by row: D^2 + 1 numbers per point. Points where the rest shape is degenerate give inf or NaN.
RowMatrix tabulate_rest(const RestShapes& rest, const ElementSpace& space,
                        const ContractionTable& table, Index e);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
