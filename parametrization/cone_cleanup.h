// Fewer and better cones, by integer changes of the matching of a cross field.
//
// A smoothest field on a coarse mesh has cones that only reflect its triangles: pairs of opposite
// index next to each other, and vertices with more quarter turns than their faces can hold.
#pragma once

#include "majorant/parametrization/field_connection.h"

namespace majorant {

// Cancels cones of opposite sign on adjacent vertices, and moves cones next to the boundary into
// it; then moves quarter turns away from vertices that would have none, or triangles with a mean
// angle above 120 degrees. Edges with is_fixed faces on both sides keep their matching (may be
// empty). Throws Error(Infeasible) when no place is found for a cone.
// Returns the number of quarter turns moved; relax() the field afterwards when it is not 0.
int clean_up_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                   const std::vector<char>& is_fixed, FieldConnection& field);

}  // namespace majorant
