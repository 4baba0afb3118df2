#include <algorithm>
#include <cctype>
#include <filesystem>

#include "majorant/io/map_file.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/vtu.h"

namespace majorant {

MapFile read_map(const std::string& path, const StopCheck& stop) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e == ".vtu" ? read_vtu(path, stop) : to_map_file(read_mesh(path, stop));
}

}  // namespace majorant
