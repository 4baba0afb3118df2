#include "majorant/io/internal/input_file.h"
#include "majorant/io/map_file.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/vtu.h"

namespace majorant {

MapFile read_map(const std::string& path, const StopCheck& stop) {
  return format_of(path) == ".vtu" ? read_vtu(path, stop) : to_map_file(read_mesh(path, stop));
}

}  // namespace majorant
