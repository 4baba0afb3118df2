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
// The field is to be relaxed afterwards.
void clean_up_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<char>& is_fixed, FieldConnection& field);

// Lowers energy (cone_potential.h) + cone_cost * sum |quarter_turns - 4|: cancels pairs of cones of
// opposite sign, and cones into the boundary, however far apart, the best first; and moves cones
// along edges.
void lower_cone_energy(const SurfaceMesh& mesh, const FieldGeometry& geometry, double cone_cost,
                       FieldConnection& field);

}  // namespace majorant
