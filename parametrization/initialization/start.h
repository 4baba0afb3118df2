// Initial maps: Tutte's map of disks, maps read from texture coordinates, and seamless maps.
//
//   const Start start{BezierMap::linear(mesh, tutte_map(*mesh))};
//   const Start old_seams = seamless_from_texture(*mesh);       // closed or bounded, of any genus
//   RunRecord record;
//   const Start made = make_seamless(*mesh, {}, record);        // the start of `majorant seamless`
//   ParametrizationResult result = parametrize(made.map, options, record);
//
// An initial map is valid but not optimal; parametrize() optimizes it. For a disk without a given
// start parametrize() computes one (initial_map() in parametrize.h).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/fields/cross_field.h"

namespace majorant {

// The construction of a seamless map.
// * Field: a cross field is integrated.
// * ScaledField: a cross field is integrated with the lengths of the conformal metric with the same
//  cones.
// * Conformal: that metric is laid out, for spheres and disks only, where the cones determine all
//  transitions.
// * Automatic: the first of these whose result can be untangled.
enum class SeamlessMethod { Automatic, Field, ScaledField, Conformal };
// "automatic", "field", "scaled-field", "conformal".
std::string_view method_name(SeamlessMethod method);

struct Start {
  BezierMap map;  // of degree 1, of the surface cut along its seams, which hold up to rounding
  // For maps assembled from corner coordinates, in uv units: the largest mismatch along a seam
  // edge, and the largest displacement of a corner by the projection that removes it.
  double residual = 0, moved = 0;
  // For constructed maps: the triangles inverted at first, the Newton steps to repair them, and the
  // method of the map (Automatic: none).
  Index inverted = 0;
  int untangling_steps = 0;
  SeamlessMethod method = SeamlessMethod::Automatic;
};

// Returns Tutte's embedding [Tut63] with uniform weights, u, v per vertex, model units. The
// boundary lies on the circle of the surface's area (radius sqrt(area / pi), centre 0),
// counterclockwise, spaced by arc length, with the first boundary vertex in file order at angle 0.
// Of several boundary loops the longest goes to the circle; each other one is filled with a vertex,
// so that the image has a hole there.
//
// Faces of narrow tubes or next to tiny boundary edges may be too small for doubles; exact signs
// decide. Then vertices are drawn towards the boundary, which is spaced less unevenly if need be,
// so that every face is positive except on extreme meshes. Needs a disk, possibly with holes.
// Throws Error(Infeasible) if the linear system cannot be solved; Stopped.
Vec tutte_map(const SurfaceMesh& mesh, const StopCheck& stop = {});

// Returns the boundary of that map spaced by arc length; other vertices are at 0.
Vec tutte_boundary(const SurfaceMesh& mesh);

// Returns the file's texture coordinates as u, v per vertex, for `--init input`. Throws
// Error(Unsupported) if a corner has none or a vertex has several.
Vec texture_map(const SurfaceMesh& mesh);

// Returns flags of the half-edges (3 #F, both sides) along which the file's texture coordinates are
// cut, since the two faces use different coordinates. In files whose faces share no coordinates,
// cuts are edges where the values differ. Throws Error(Unsupported) if a corner has no texture
// coordinate.
std::vector<char> texture_cuts(const SurfaceMesh& mesh);

// Returns the seamless map that the file's texture coordinates describe: cuts, transitions, cones
// and their angles. Rotations between the sides of a seam are snapped to multiples of 90 degrees,
// translations are fitted, and the remaining mismatch is projected out exactly.
//
// Throws Error(Unsupported) as texture_cuts() does. Throws it also if the surface is closed and has
// no seams, if the mismatch of a seam exceeds kSeamTolerance (naming the edge), or if the angles
// around a vertex add up to no multiple of 90 degrees. Throws Error(Infeasible) naming a face that
// is not positively oriented.
Start seamless_from_texture(const SurfaceMesh& mesh);

// Returns the seamless map of any cut (3 #F flags) and coordinates of the corners.
Start seamless_from_corners(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                            const CornerPoints& corners);

// Returns the seamless map of a layout whose faces may be inverted: angle sums are given (per
// vertex of `mesh`, 0 on its boundary), not measured.
Start seamless_from_layout(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                           const CornerPoints& corners, std::vector<int> quarter_turns);

struct SeamlessOptions {
  SeamlessMethod method = SeamlessMethod::Automatic;
  // Edges that the field follows lie along axes of the map, up to rounding; not with Conformal.
  CrossFieldOptions field = {};
  // Vertices of the mesh with their turns; all others are regular, so an empty list means no cones.
  // None: the field's cones. Excludes edges to follow.
  std::optional<std::vector<Cone>> cones = {};
  int threads = 0;  // as in SolveOptions
};

// Computes a seamless, locally injective map of degree 1. mesh: connected, closed or bounded, any
// genus.
//
// Cones, those of a cross field unless given -> cut graph through them -> a map with these seams:
// the field integrated, or a conformal metric laid out -> untangling, until every triangle is
// positively oriented and no vertex is covered twice.
//
// Throws Error(Invalid) naming the cones around which triangles could not be untangled,
// Error(Usage) for Conformal on surfaces of other kinds, and the errors of cross_field.h for
// impossible cones. Throws Stopped if the record's start_stop() ends the run first.
Start make_seamless(const SurfaceMesh& mesh, const SeamlessOptions& options,
                    const RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
