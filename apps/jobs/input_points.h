// Vertices that users name are those of their input; maps have others, some of them several times.
//
//   const std::vector<Pin> pins = pins_at(*mesh, {{12, Vector2(0.5, 1)}}, "pins.json");
#pragma once

#include <string>
#include <vector>

#include "majorant/io/read_vertex_lists.h"
#include "majorant/maps/map_options.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Vertex of the mesh for one of its input. Throws Error(Unsupported) when no face uses it; source:
// who names it, for the message.
Index used_vertex(const std::string& source, const SurfaceMesh& mesh, Index input_vertex);

// Points of the input as pins: every copy of a vertex is held, on a cut or where sheets were split.
// names: by vertex of the input, the name that the mesh has for it (RepairedSurface::welded);
// empty: its own. Throws as used_vertex().
std::vector<Pin> pins_at(const SurfaceMesh& mesh, const std::vector<Handle>& handles,
                         const std::string& source, const std::vector<Index>& names = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
