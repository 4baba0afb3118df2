// Orients faces consistently, and cuts the surface where that is impossible.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/internal/given_triangles.h"

namespace majorant {

struct AgreeingFaces {
  std::vector<char> is_turned;   // by triangle
  std::vector<Index> cut_edges;  // a half-edge of each opened edge
  Index one_sided = 0;           // components that were cut because they have only one side
};

// Turns the minority of faces of each component, and opens edges of components with one side, as
// turned_face and cut_edge (repair.h) say.
AgreeingFaces turn_to_agree(const GivenTriangles& triangles, GluedSides& glued,
                            const StopCheck& stop);

// Turns no face, and opens all edges along which faces disagree.
AgreeingFaces open_disagreeing(const GivenTriangles& triangles, GluedSides& glued);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
