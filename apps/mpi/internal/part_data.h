// Distributes numbers for the whole surface from rank 0 to the parts of the ranks, and collects
// them.
//
//     const Vec uv = of_vertices(part, whole_uv, 2);         // whole_uv: rank 0's, empty elsewhere
//     const Vec back = whole_of_vertices(part, uv, 2);       // rank 0's again
//     const std::vector<Pin> pins = pins_of_part(part, whole_pins, Copies::All);
#pragma once

#include <vector>

#include "apps/mpi/mesh_part.h"
#include "majorant/maps/map_options.h"

namespace majorant {

// Returns `width` numbers for each vertex or face of this rank; nothing if rank 0 has none.
Vec of_vertices(const MeshPart& part, const Vec& whole, Index width);
Vec of_faces(const MeshPart& part, const Vec& whole, Index width);

// Collects `width` numbers for each vertex or face of the ranks. Rank 0 gets all, other ranks
// nothing. Copies of a vertex have the same numbers.
Vec whole_of_vertices(const MeshPart& part, const Vec& mine, Index width);
Vec whole_of_faces(const MeshPart& part, const Vec& mine, Index width);

// The ranks that keep points at vertices of the whole surface: all that have the vertex, or its
// owner alone.
enum class Copies { All, Owner };
std::vector<Pin> pins_of_part(const MeshPart& part, const std::vector<Pin>& whole, Copies copies);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
