// A finished map from a file: .vtu, or a triangle .obj with texture coordinates (degree 1).
#pragma once

#include <string>

#include "majorant/io/map_file.h"

namespace majorant {

// Throws Error(Unreadable) when the file cannot be read or holds no map.
MapFile read_map(const std::string& path);

}  // namespace majorant
