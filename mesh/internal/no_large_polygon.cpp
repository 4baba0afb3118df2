// The functions of large_polygon.h in builds without CGAL.
#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/mesh/internal/large_polygon.h"

namespace majorant {

std::vector<std::array<int, 3>> triangulate_large_polygon(const std::vector<Vector2>& polygon,
                                                          const StopCheck&) {
  throw Error(
      ErrorKind::Unsupported,
      fmt::format("a polygon of {} corners needs CGAL's triangulations, which this majorant "
                  "was built without (MAJORANT_GPL=OFF); triangulate it first",
                  polygon.size()));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
