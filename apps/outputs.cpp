#include "apps/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "majorant/framework/error.h"
#include "majorant/io/vtu.h"
#include "majorant/io/write_obj.h"
#include "majorant/io/write_svg.h"

namespace majorant::app {

std::string extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

void require_writable(const std::vector<std::string>& paths,
                      const std::vector<std::string>& allowed) {
  for (const std::string& path : paths) {
    const std::string e = extension(path);
    if (std::find(allowed.begin(), allowed.end(), e) == allowed.end())
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: cannot write files of type '{}'; use one of {}", path, e,
                              fmt::join(allowed, " ")));
    const auto directory = std::filesystem::path(path).parent_path();
    if (!directory.empty() && !std::filesystem::is_directory(directory))
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: the directory does not exist; create it", path));
  }
}

void write_map(const std::string& path, const MapFile& map, const PolygonMesh* input, int refine) {
  const std::string e = extension(path);
  const int pieces = refine > 0 ? refine : (map.degree == 1 ? 1 : 3);
  if (e == ".vtu") write_vtu(path, map);
  if (e == ".obj") write_obj(path, map, input, pieces);
  if (e == ".svg") write_svg(path, map);
}

}  // namespace majorant::app
