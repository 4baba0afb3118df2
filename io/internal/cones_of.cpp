#include "majorant/io/internal/cones_of.h"

#include <algorithm>

namespace majorant {

std::map<Index, int> cones_of(const MapFile& map) {
  std::map<Index, int> cones;
  for (Index p = 0; p < std::min(map.cone.size(), map.input_vertex.size()); ++p)
    if (map.cone[p] != 0 && map.input_vertex[p] >= 0) cones[map.input_vertex[p]] = map.cone[p];
  return cones;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
