// Rest shapes of a surface: the shapes of its faces against which its maps are measured.
//
//   const RestShapes rest = rest_shapes(*mesh);          // model units
//   const RestShapes small = rest_shapes(*mesh, 1e-3);   // of the mesh scaled by 1e-3
//
// They are those of its flat triangles (elements/rest_shapes.h), except for faces with a rest
// triangle (SurfaceMesh::rest_triangles(), made by repair(), mesh/repair.h). These have no area or
// almost none, and their distortion would be infinite for any map, so they are measured against
// their rest triangle. Energies weight faces by the areas of the rest shapes: such a face with
// longest edge L has a weight of about 1e-6 L^2 / 2.
//
// For other elements use curved_shapes() and the other functions of elements/rest_shapes.h.
#pragma once

#include "majorant/elements/rest_shapes.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns a rest shape for each face of the mesh scaled by `scale`. Positions are scaled first,
// then subtracted.
RestShapes rest_shapes(const SurfaceMesh& mesh, double scale = 1);

// Returns the rest shape of one face alone, as element 0.
RestShapes rest_shape(const SurfaceMesh& mesh, Index face);

// Returns the components of vectors in space, one a face (#F by 3), in the frames of these rest
// shapes, as in_frames() of elements/rest_shapes.h does; along() of energies/energy_factory.h takes
// them. A face with a rest triangle has no plane in space and gets (1, 0). Throws InvalidArgument
// for another number of vectors, and for a vector without a part tangent to its face.
RowMatrix in_frames(const SurfaceMesh& mesh, const Points3& vectors);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
