// Output files by extension: .vtu .obj .svg hold a map, .json a report, .csv an iteration trace.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "majorant/io/map_file.h"
#include "majorant/io/tessellate_map.h"
#include "majorant/io/write_svg.h"
#include "majorant/parametrization/polygon_mesh.h"

namespace majorant::app {

// Lower case, with the dot.
std::string extension(const std::string& path);

// Throws Error(Usage) for an extension that is none of `allowed` or a directory that does not
// exist, before any work is done.
void require_writable(const std::vector<std::string>& paths,
                      const std::vector<std::string>& allowed);

// How single formats are written, as said.
struct FormatOptions {
  TessellationOptions tessellation;  // of OBJ
  SvgOptions svg;

  void add_to(CLI::App& verb);  // --refine --grid
};

// Writes one of the map formats. input may be null.
void write_map(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const FormatOptions& options);

}  // namespace majorant::app
