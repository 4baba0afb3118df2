// The functions of scaffold_triangulation.h in builds without CGAL.
#include "majorant/framework/error.h"
#include "majorant/parametrization/scaffold/internal/scaffold_triangulation.h"

namespace majorant {

ScaffoldTriangulation triangulate_scaffold(const std::vector<Points2>&, const ScaffoldOptions&) {
  throw Error(ErrorKind::Usage,
              "a map without overlaps needs CGAL's triangulations, which this majorant was built "
              "without (MAJORANT_GPL=OFF)");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
