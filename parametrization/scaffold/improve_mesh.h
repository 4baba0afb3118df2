// Improves the triangulation of a map without changing the surface: flips edges inside flat parts.
//
//   ParametrizationResult first = parametrize(mesh, options);
//   ImprovedMap better = improve_mesh(*first.map, options.map.energy);
//   better.map.mesh();   // the same surface with other triangles; as injective as before
//
// Two faces in one plane may be replaced by the other two triangles of their quadrilateral: the
// surface does not change, nor does anything outside the quadrilateral. The image gets the other
// diagonal (edge_flip.h). The control points that only the two new triangles have are those of
// least energy.
#pragma once

#include "majorant/energies/energy_factory.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/scaffold/internal/edge_flip.h"

namespace majorant {

struct ImprovedMap {
  BezierMap map;
  FlipCounts flips;  // intended: pairs whose other diagonal was tried
};

// Flips inner edges, one by one, whose faces lie in one plane (up to 1e-12 of the edges' lengths)
// and form a strictly convex quadrilateral, if
//     the energy of the two new images is smaller than that of the two old ones, or
//     it is the same up to rounding and the quadrilateral on the surface is not Delaunay;
// Both diagonals are compared with the pair's inner control points at the least energy; pairs that
// are not flipped keep their points. Seams, cuts and boundaries stay. The energy does not grow
// beyond rounding, every face stays certified, angle sums at vertices do not change, and the map
// stays continuous. Only the pairs' own inner control points move, so a following parametrize() or
// Newton step gains more. The input should be a minimum already.
//
// The result's mesh has the same vertices in the same order and as many faces. Both faces of a
// flipped pair count as the smaller of the two polygons of the file that they were part of
// (SurfaceMesh::input_face). It has no texture coordinates. If nothing is flipped, returns the map
// itself.
//
// energy: of the map as it is, in model units. Throws InvalidArgument if it is empty or a face of
// the map is not certified to be injective. After a stop no further pair is tried.
ImprovedMap improve_mesh(const BezierMap& map, const EnergySum& energy, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
