// The last stages of a quad mesh: the quads of one quantization are extracted, placed on the
// surface, smoothed and judged.
//
//   const PlacedQuads placed = place_quads(*mesh, features, traced, edges, record, seconds);
//   std::cout << placed.check.count << " quads\n";
#pragma once

#include <array>
#include <vector>

#include "majorant/quads/internal/traced_map.h"

namespace majorant {

struct PlacedQuads {
  PolygonMesh quads;
  std::vector<Index> patch_of;
  std::vector<std::array<Index, 2>> feature_edges;
  QuadCheck check;
  Index patches = 0;
};

// edges: by arc, as Quantization has them; features: 3 #F of `mesh`, or empty. Throws
// Error(Infeasible) where the quads are not valid; Stopped.
PlacedQuads place_quads(const SurfaceMesh& mesh, const std::vector<char>& features,
                        const TracedMap& traced, const std::vector<Index>& edges,
                        const RunRecord& record, QuadSeconds& seconds);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
