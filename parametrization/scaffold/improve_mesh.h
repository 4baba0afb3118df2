// Better triangles for a map where the surface does not care: edges inside flat parts are flipped.
//
//   ParametrizationResult first = parametrize(mesh, options);
//   ImprovedMap better = improve_mesh(*first.map, options.map.energy);
//   better.map.mesh();   // the same surface with other triangles; as injective as before
//
// Two faces in one plane may be any two triangles of their quadrilateral: the surface stays what it
// is, and so does everything outside the quadrilateral. Its image gets the other diagonal
// (edge_flip.h), and the control points that only the two new triangles have are those of least
// energy.
#pragma once

#include "majorant/energies/energy_factory.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/scaffold/internal/edge_flip.h"

namespace majorant {

struct ImprovedMap {
  BezierMap map;
  FlipCounts flips;  // intended: pairs of which the other diagonal was tried
};

// Flips inner edges, one by one, whose faces lie in one plane (up to 1e-12 of the edges' lengths)
// and form a strictly convex quadrilateral, where
//     the energy of the two new images is smaller than that of the two old ones, or
//     it is the same up to rounding and the quadrilateral on the surface is not Delaunay;
// both compared with the inner control points of the pair where its energy is least, while those of
// pairs that are not flipped stay.
// Seams, cuts and boundaries stay. The energy never grows beyond rounding, every face stays
// certified, angle sums at vertices do not change, and the map is continuous as before. Only the
// pairs' own inner control points move, so a following parametrize() or Newton step gains more;
// best done with a map that is a minimum already.
//
// The result's mesh has the same vertices in the same order and as many faces; both faces of a
// flipped pair count as the smaller of the two polygons of the file that they were part of
// (SurfaceMesh::input_face). It has no texture coordinates. The map itself is returned when nothing
// was flipped. energy: of the map as it is, in model units. Throws InvalidArgument when it is
// empty or when a face of the map is not certified to be injective.
// After a stop no further pair is tried.
ImprovedMap improve_mesh(const BezierMap& map, const EnergySum& energy, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
