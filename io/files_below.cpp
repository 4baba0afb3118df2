#include "majorant/io/files_below.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "majorant/framework/error.h"

namespace majorant {

bool is_below(const std::string& path, const std::string& name) {
  namespace fs = std::filesystem;
  if (name.empty() || name.find('\0') != std::string::npos) return false;
  if (name.substr(0, name.find('/')).find(':') != std::string::npos) return false;
  const fs::path relative(name);
  if (relative.is_absolute() ||
      std::any_of(relative.begin(), relative.end(), [](const fs::path& p) { return p == ".."; }))
    return false;
  std::error_code failed;
  const fs::path folder = fs::weakly_canonical(fs::absolute(path, failed).parent_path(), failed);
  const fs::path way = fs::weakly_canonical(folder / relative, failed).lexically_relative(folder);
  return !way.empty() && *way.begin() != "..";
}

void require_materials_below(const PolygonMesh& mesh) {
  for (const auto& [polygon, line] : mesh.directives) {
    if (!line.starts_with("mtllib")) continue;
    std::istringstream words(line.substr(0, line.find(" #")));
    std::string name;
    for (words >> name; words >> name;) {
      std::replace(name.begin(), name.end(), '\\', '/');
      if (!is_below(mesh.file, name))
        throw Error(ErrorKind::Unsupported,
                    fmt::format("{}: mtllib names the file '{}', and files are read from its own "
                                "folder and those below alone; copy it there",
                                mesh.file, name));
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
