// What `check` demands of maps with seams: that they fit, that cones and cuts are those that were
// claimed or given.
#pragma once

#include "apps/check_claims.h"

namespace majorant::app {

// Mismatch of the sides of a seam, in sizes of the layout, beyond which a map is not seamless. The
// optimizer holds seams to some 1e-15; a coordinate printed with fewer than 10 digits shows.
inline constexpr double kSeamClose = 1e-9;

// Whether the cut of the map should be that of the texture coordinates of --surface: results of
// `parametrize --seamless`, and files that do not say where they come from. Those of `seamless`
// name the method that made their start as `init`.
bool keeps_texture_cuts(const Json& claims);

// For maps with seams: residual, cones, marks; the cut, if --surface has texture coordinates.
void check_seams(const CheckedMap& checked, Findings& findings);

// The boundary of the uncut surface is where the texture of --surface has it.
void check_fixed_texture_boundary(const CheckedMap& checked, Findings& findings);

}  // namespace majorant::app
