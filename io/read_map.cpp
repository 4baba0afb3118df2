#include <algorithm>

#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/read_mesh.h"

namespace majorant {

MapFile read_map(const std::string& path, const StopCheck& stop, Strictness strictness) {
  if (const Format* known = find_format(format_of(path)); known && known->read_map)
    return known->read_map(path, stop);
  return to_map_file(read_mesh(path, stop, std::max(strictness, Strictness::Texcoords)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
