// Rest shapes of a surface: the shapes of its faces that its maps are measured against.
//
//   const RestShapes rest = rest_shapes(*mesh);          // model units
//   const RestShapes small = rest_shapes(*mesh, 1e-3);   // of the mesh scaled by 1e-3
//
// They are those of its flat triangles (elements/rest_shapes.h), but for faces that have a rest
// triangle because they have no area of their own, or hardly one (SurfaceMesh::rest_triangles(),
// made by repair(), mesh/repair.h): these are measured against that, so that a map of them has a
// distortion at all. Their own would be infinite whatever the map. Energies weigh faces by the
// areas of the shapes at rest: a regularized face of longest edge L counts with some 1e-6 L^2 / 2.
//
// Not for elements other than the triangles of a surface: curved_shapes() and the others of
// elements/rest_shapes.h.
#pragma once

#include "majorant/elements/rest_shapes.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns a rest shape for each face of the mesh scaled by `scale`: positions first, then their
// differences.
RestShapes rest_shapes(const SurfaceMesh& mesh, double scale = 1);

// The rest shape of one face alone, as element 0.
RestShapes rest_shape(const SurfaceMesh& mesh, Index face);

// Vectors in space, one a face (#F by 3), in the frames of these rest shapes: in_frames() of
// elements/rest_shapes.h; along() of energies/energy_factory.h takes them. (1, 0) where a rest
// triangle stands for the face: it has no plane in space. Throws InvalidArgument for
// another number of vectors, and for one that has no part tangent to its face.
RowMatrix in_frames(const SurfaceMesh& mesh, const Points3& vectors);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
