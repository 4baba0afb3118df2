// A seamless map to start from: read from texture coordinates, or assembled from a cut surface
// whose images nearly fit.
//
//   SeamlessStart start = seamless_from_texture(*mesh);   // closed or bounded, of any genus
//   ParametrizationResult result = parametrize(start.map, options, record);
//
// Rotations between the sides of a seam are snapped to multiples of 90 degrees, translations are
// fitted, and the remaining mismatch is projected out exactly before anything is optimized.
#pragma once

#include <vector>

#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

struct SeamlessStart {
  BezierMap map;        // of degree 1, of the cut surface; seams hold to rounding
  double residual = 0;  // largest mismatch found along a seam edge, uv units
  double moved = 0;     // largest distance by which the projection moved a corner, uv units
  // Of maps that were made (seamless_map.h): triangles inverted at first, Newton steps to repair.
  Index inverted = 0;
  int untangling_steps = 0;
};

// Mismatch along a seam edge beyond which coordinates are not taken for seamless, in mean lengths
// of edges in uv. Files with 6 digits stay well below it.
inline constexpr double kSeamTolerance = 1e-3;

// Half-edges (3 #F flags, both sides) along which the file's texture coordinates are cut: where the
// two faces use different coordinates. Files that share none, a soup, are cut where the values
// differ. Throws Error(Unsupported) when a corner has no texture coordinate.
std::vector<char> texture_cuts(const SurfaceMesh& mesh);

// The seamless map that the texture coordinates of the file describe: cuts, transitions, cones and
// their angles. Throws Error(Unsupported) as texture_cuts does, when the surface has no seams and
// is not bounded, when a seam's mismatch exceeds kSeamTolerance (naming the edge), or when the
// angles around a vertex add up to no multiple of 90 degrees; Error(Infeasible) naming a face that
// is not positively oriented.
SeamlessStart seamless_from_texture(const SurfaceMesh& mesh);

// The same for any cut (3 #F flags) and coordinates of the corners.
SeamlessStart seamless_from_corners(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                                    const CornerPoints& corners);

// The same where faces may be inverted: angle sums are given (per vertex of `mesh`, 0 on its
// boundary), not measured.
SeamlessStart seamless_from_layout(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                                   const CornerPoints& corners, std::vector<int> quarter_turns);

// The cut surface with these transitions: turns (3 #F) on both sides of every cut edge, that on the
// opposite side its negative, uv of h = i^turns[h] uv of opposite(h) + t; quarter_turns per vertex
// of `mesh`, 0 on its boundary.
struct CutSurface {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const Seams> seams;
};
CutSurface cut_open(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                    const std::vector<int>& turns, std::vector<int> quarter_turns);

// u, v per vertex of the cut surface, closest in the free unknowns to `uv`, that satisfy the seams;
// *moved (may be null) receives the largest change.
Vec project_to_seams(const CutSurface& surface, VecIn uv, double* moved);

}  // namespace majorant
