// A finished map from a file: .vtu, or a triangle .obj with texture coordinates (degree 1).
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/io/map_file.h"

namespace majorant {

// Throws Error(Unreadable) when the file cannot be read or holds no map; Stopped.
MapFile read_map(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant
