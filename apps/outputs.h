// Output files by extension: .vtu .obj .svg hold a map, .json a report, .csv an iteration trace.
#pragma once

#include <string>
#include <vector>

#include "majorant/io/map_file.h"
#include "majorant/parametrization/polygon_mesh.h"

namespace majorant::app {

// Lower case, with the dot.
std::string extension(const std::string& path);

// Throws Error(Usage) for an extension that is none of `allowed` or a directory that does not
// exist, before any work is done.
void require_writable(const std::vector<std::string>& paths,
                      const std::vector<std::string>& allowed);

// Writes one of the map formats. refine 0: 1 for degree 1, else 3. input may be null.
void write_map(const std::string& path, const MapFile& map, const PolygonMesh* input, int refine);

}  // namespace majorant::app
