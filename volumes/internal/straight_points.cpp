#include "majorant/volumes/internal/straight_points.h"

#include <fmt/format.h>

#include <array>
#include <numeric>

#include "majorant/volumes/internal/node_orders.h"

namespace majorant {

void StraightPoints::append_rows(ConstraintRows& rows) const {
  const int dim = net_.dim();
  std::vector<char> is_done(to_size(net_.count()), 0);
  for (const ControlNet::Part& part : net_.parts()) {
    const CellType& type = mesh_.blocks[to_size(part.block)].type;
    const std::vector<std::array<int, 8>> weights = corner_weights(type.shape, type.degree);
    const Cells& cells = part.space->cells();
    const int corners = corner_count(type.shape);
    for (Index e = 0; e < cells.rows(); ++e)
      for (Index k = corners; k < cells.cols(); ++k) {
        const Index point = cells(e, k);
        if (!held_.is_free(point) || is_done[to_size(point)] != 0) continue;
        is_done[to_size(point)] = 1;
        const std::array<int, 8>& of_corners = weights[to_size(k)];
        for (int d = 0; d < dim; ++d) {
          rows.begin_row(fmt::format("straight coordinate {} of control point {}", d, point));
          rows.add(dim * point + d, std::accumulate(of_corners.begin(), of_corners.end(), 0));
          for (int c = 0; c < corners; ++c)
            if (of_corners[to_size(c)] != 0)
              rows.add(dim * cells(e, c) + d, -of_corners[to_size(c)]);
          rows.end_row(0);
        }
      }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
