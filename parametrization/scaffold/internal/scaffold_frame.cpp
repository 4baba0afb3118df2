#include "majorant/parametrization/scaffold/internal/scaffold_triangulation.h"

namespace majorant {

ScaffoldTriangulation enlarge_frame(const Points2& frame, double margin) {
  return triangulate_scaffold({frame}, {.margin = margin});
}

bool frame_is_tight(const Points2& frame, const Points2& image, double clearance) {
  const double extent = (frame.colwise().maxCoeff() - frame.colwise().minCoeff()).minCoeff();
  for (Index k = 0; k < frame.rows(); ++k) {
    const Vector2 from = frame.row(k);
    const Vector2 side = frame.row((k + 1) % frame.rows()).transpose() - from;
    const double least = clearance * extent * side.norm();  // distances come times this length
    for (Index p = 0; p < image.rows(); ++p)
      if (!(cross(side, image.row(p).transpose() - from) >= least)) return true;
  }
  return false;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
