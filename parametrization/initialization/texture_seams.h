// Starts read from texture coordinates: plain ones, and seamless maps, whose seams they tell; also
// seamless maps put together from any corner coordinates that nearly fit.
//
//   Start start = seamless_from_texture(*mesh);   // closed or bounded, of any genus
//   ParametrizationResult result = parametrize(start.map, options, record);
//
// Rotations between the sides of a seam are snapped to multiples of 90 degrees, translations are
// fitted, and the remaining mismatch is projected out exactly before anything is optimized.
#pragma once

#include <vector>

#include "majorant/parametrization/initialization/start.h"

namespace majorant {

// The file's texture coordinates as u, v per vertex, for `--init input`. Throws Error(Unsupported)
// when a corner has none or a vertex has several.
Vec texture_map(const SurfaceMesh& mesh);

// Half-edges (3 #F flags, both sides) along which the file's texture coordinates are cut: where the
// two faces use different coordinates. Files that share none, a soup, are cut where the values
// differ. Throws Error(Unsupported) when a corner has no texture coordinate.
std::vector<char> texture_cuts(const SurfaceMesh& mesh);

// The seamless map that the texture coordinates of the file describe: cuts, transitions, cones and
// their angles. Throws Error(Unsupported) as texture_cuts does, when the surface has no seams and
// is not bounded, when a seam's mismatch exceeds kSeamTolerance (naming the edge), or when the
// angles around a vertex add up to no multiple of 90 degrees; Error(Infeasible) naming a face that
// is not positively oriented.
Start seamless_from_texture(const SurfaceMesh& mesh);

// The same for any cut (3 #F flags) and coordinates of the corners.
Start seamless_from_corners(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                            const CornerPoints& corners);

// The same where faces may be inverted: angle sums are given (per vertex of `mesh`, 0 on its
// boundary), not measured.
Start seamless_from_layout(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                           const CornerPoints& corners, std::vector<int> quarter_turns);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
