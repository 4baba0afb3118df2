// Converts vertices of the input, which users name, to vertices of maps, which may have several
// copies of one.
//
//   const std::vector<Pin> pins = pins_at(*mesh, {{12, Vector2(0.5, 1)}}, "pins.json");
#pragma once

#include <string>
#include <vector>

#include "majorant/io/read_vertex_lists.h"
#include "majorant/maps/map_options.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the vertex of the mesh for a vertex of its input. Throws Error(Unsupported) if no face
// uses it; source: the origin of the name, for the message.
Index used_vertex(const std::string& source, const SurfaceMesh& mesh, Index input_vertex);

// Returns points of the input as pins. Every copy of a vertex is held, whether it lies on a cut or
// where sheets were split. names: the name in the mesh of each vertex of the input
// (RepairedSurface::welded); empty: the same. Throws the errors of used_vertex().
std::vector<Pin> pins_at(const SurfaceMesh& mesh, const std::vector<Handle>& handles,
                         const std::string& source, const std::vector<Index>& names = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
