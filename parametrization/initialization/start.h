// Maps to start from: Tutte's of disks, maps read from texture coordinates, and seamless maps that
// are made.
//
//   const Start start{BezierMap::linear(mesh, tutte_map(*mesh))};
//   const Start old_seams = seamless_from_texture(*mesh);       // closed or bounded, of any genus
//   RunRecord record;
//   const Start made = make_seamless(*mesh, {}, record);        // the start of `majorant seamless`
//   ParametrizationResult result = parametrize(made.map, options, record);
//
// Not for results: a start is valid, not good. parametrize() makes it good, and finds a start
// itself for a disk that is given none (initial_map() in parametrize.h).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/fields/cross_field.h"

namespace majorant {

// The way in which a seamless map is made. Field: a cross field is integrated. ScaledField:
// likewise, with the lengths of the conformal metric that has the field's cones. Conformal: that
// metric is laid out; for spheres and disks only, where the cones determine all transitions.
// Automatic: the first of these that can be untangled.
enum class SeamlessMethod { Automatic, Field, ScaledField, Conformal };
// "automatic", "field", "scaled-field", "conformal".
std::string_view method_name(SeamlessMethod method);

struct Start {
  BezierMap map;  // of degree 1, of the surface cut open where it has seams, which hold to rounding
  // For maps put together from corner coordinates, in uv units: the largest mismatch found along a
  // seam edge, and the largest distance by which projecting it out moved a corner.
  double residual = 0, moved = 0;
  // For maps that were made: triangles inverted at first, Newton steps to repair them, and the
  // method that gave the map (Automatic: none).
  Index inverted = 0;
  int untangling_steps = 0;
  SeamlessMethod method = SeamlessMethod::Automatic;
};

// Tutte's embedding [Tut63] with uniform weights: boundary on the circle of the surface's area
// (radius sqrt(area / pi), centre 0), counterclockwise, spaced by arc length, the first boundary
// vertex in file order at angle 0. Returns u, v per vertex, model units. Of several boundary loops
// the longest goes to the circle; the others are filled with a vertex each, so that the image has
// holes there.
//
// Faces may be left without room in doubles (narrow tubes, boundaries of tiny edges: exact signs
// decide); then vertices lean towards the boundary, which is spaced less unevenly if need be. So
// every face is positive, but for meshes beyond all of these. Needs a disk, possibly with holes;
// throws Error(Infeasible) when the linear system cannot be solved; Stopped.
Vec tutte_map(const SurfaceMesh& mesh, const StopCheck& stop = {});

// The boundary of that map where it is spaced by arc length; other vertices at 0.
Vec tutte_boundary(const SurfaceMesh& mesh);

// The file's texture coordinates as u, v per vertex, for `--init input`. Throws Error(Unsupported)
// when a corner has none or a vertex has several.
Vec texture_map(const SurfaceMesh& mesh);

// Half-edges (3 #F flags, both sides) along which the file's texture coordinates are cut: where the
// two faces use different coordinates. Files that share none, a soup, are cut where the values
// differ. Throws Error(Unsupported) when a corner has no texture coordinate.
std::vector<char> texture_cuts(const SurfaceMesh& mesh);

// The seamless map that the texture coordinates of the file describe: cuts, transitions, cones and
// their angles. Rotations between the sides of a seam are snapped to multiples of 90 degrees,
// translations are fitted, and the mismatch that remains is projected out exactly. Throws
// Error(Unsupported) as texture_cuts does, when the surface has no seams and is not bounded, when a
// seam's mismatch exceeds kSeamTolerance (naming the edge), or when the angles around a vertex add
// up to no multiple of 90 degrees; Error(Infeasible) naming a face that is not positively oriented.
Start seamless_from_texture(const SurfaceMesh& mesh);

// The same for any cut (3 #F flags) and coordinates of the corners.
Start seamless_from_corners(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                            const CornerPoints& corners);

// The same where faces may be inverted: angle sums are given (per vertex of `mesh`, 0 on its
// boundary), not measured.
Start seamless_from_layout(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                           const CornerPoints& corners, std::vector<int> quarter_turns);

struct SeamlessOptions {
  SeamlessMethod method = SeamlessMethod::Automatic;
  // Edges that the field follows lie along axes of the map, to rounding: not by Conformal.
  CrossFieldOptions field = {};
  // Vertices of the mesh; all others are regular, an empty list has no cones. Nothing: the field's.
  // Not together with edges to follow.
  std::optional<std::vector<Cone>> cones = {};
  int threads = 0;  // as SolveOptions has it
};

// From a plain mesh to a seamless, locally injective map of degree 1. Cones, those of a cross field
// unless they are given -> cut graph through them -> a map with these seams: the field integrated,
// or a conformal metric laid out -> untangling, until every triangle is positively oriented and no
// vertex is covered twice. mesh: connected, closed or bounded, any genus. Throws Error(Invalid)
// naming the cones around
// which triangles could not be untangled, Error(Usage) for Conformal on surfaces of other kinds,
// and as cross_field.h has it for cones that cannot be; Stopped when the record's start_stop() says
// so first.
Start make_seamless(const SurfaceMesh& mesh, const SeamlessOptions& options,
                    const RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
