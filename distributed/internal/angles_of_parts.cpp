#include "distributed/internal/angles_of_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "majorant/constraints/local_injectivity.h"

namespace majorant {

AnglesOfParts angles_of_parts(const MeshPart& part, const BezierMap& map) {
  Vec sums = vertex_angle_sums(map.space(), map.control_points());
  const Partition vertices = part.vertices();
  vertices.add_to_owners(sums);
  std::vector<char> on_boundary(to_size(part.mesh->vertex_count()), 0);
  for (const Index v : part.boundary_vertices) on_boundary[v] = 1;
  std::array<double, 2> counts{};
  double largest = 0;
  for (Index v = 0; v < sums.size(); ++v) {
    if (!vertices.owns(v)) continue;
    const double beyond = sums[v] - 2 * std::numbers::pi;
    if (on_boundary[v]) {
      largest = std::max(largest, sums[v]);
      counts[1] += beyond > AngleSums::kTolerance;
    } else {
      counts[0] += !(std::abs(beyond) <= AngleSums::kTolerance);
    }
  }
  part.ranks().sum(counts);
  return {static_cast<Index>(counts[0]), static_cast<Index>(counts[1]), part.ranks().max(largest)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
