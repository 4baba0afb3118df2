#include <algorithm>

#include "majorant/io/claims.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/pvtu.h"
#include "majorant/io/read_mesh.h"

namespace majorant {

MapFile read_map(const std::string& path, const StopCheck& stop, Strictness strictness) {
  const std::string format = format_of(path);
  if (format == ".vtu") {
    MapFile map = read_vtu(path, stop);
    map.is_complete = readable_claims(map.claims).complete.value_or(true);
    return map;
  }
  if (format == ".pvtu") return read_pvtu(path, stop);
  if (format == ".msh") return read_msh(path, stop);
  return to_map_file(read_mesh(path, stop, std::max(strictness, Strictness::Texcoords)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
