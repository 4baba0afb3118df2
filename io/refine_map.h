// A map sampled on a regular subdivision of its cells. For writers of formats without curved cells.
#pragma once

#include "majorant/io/map_file.h"
#include "majorant/parametrization/polygon_mesh.h"

namespace majorant {

// Every cell becomes refine x refine triangles, in the order of mesh_from_map; see write_obj for
// what is shared. `input` gives directives and unreferenced vertices and may be null.
// Throws Error(Usage) if refine < 1 or the result needs more than 2^31 vertices.
PolygonMesh refine_map(const MapFile& map, const PolygonMesh* input, int refine);

}  // namespace majorant
