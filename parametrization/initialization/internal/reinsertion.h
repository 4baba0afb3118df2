// Where a vertex that comes back to a map is put: always a place that leaves its triangles
// positive.
//
//     const auto back = mesh.restore();
//     descent.measure_star(back.vertex);
//     if (put_back(mesh, positions, descent, back)) descent.improve(back.vertex, 4);
#pragma once

#include "majorant/parametrization/initialization/internal/vertex_descent.h"

namespace majorant {

// From the neighbours in the map: the mean of them by mean value coordinates of the star in space
// [Flo03], of a boundary vertex the similarity that fits the unfolded star best; where that leaves
// a triangle of the star without room, a point so near to the vertex that it had collapsed onto
// that all have some: the triangles that were there before are positive, and the new ones are when
// it lies between them. False where doubles have no such point.
bool put_back(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
              const CollapsingMesh::Restored& back);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
