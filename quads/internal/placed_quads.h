// The last stages of a quad mesh: extracts the quads of a quantization, places them on the surface,
// smooths and judges them.
//
//   QuadSeconds seconds;
//   const auto traced = traced_map(*mesh, {}, {}, record, seconds);
//   const QuadPlacer placer(*mesh, {}, *traced, {}, record, seconds);
//   const std::vector<Index> edges(traced->t_mesh.arcs.size(), 1);
//   const PlacedQuads placed = placer.place(edges, 1);
//   std::cout << placed.check.count << " quads\n";
#pragma once

#include <array>
#include <vector>

#include "majorant/quads/internal/traced_map.h"

namespace majorant {

// Placed quads. If they form no surface they are not smoothed or judged further.
struct PlacedQuads {
  PolygonMesh quads;
  std::vector<Index> patch_of;
  std::vector<std::array<Index, 2>> feature_edges;
  QuadCheck check;
  Index patches = 0;
  QuadPlacing placed = QuadPlacing::Rectangles;
  int degree = 1;
};

class QuadPlacer {
 public:
  // The arguments must outlive this. features: 3 #F of `mesh`, or empty.
  QuadPlacer(const SurfaceMesh& mesh, const std::vector<char>& features, const TracedMap& traced,
             const QuadMeshOptions& options, const RunRecord& record, QuadSeconds& seconds)
      : mesh_(mesh),
        features_(features),
        traced_(traced),
        options_(options),
        record_(record),
        seconds_(seconds) {}

  // Returns the valid quads of both placements with the smaller angle deviation. edges: by arc.
  // degree: the highest degree of an integer-grid map if the rectangles' quads are valid. Throws
  // Error(Infeasible) if none are valid.
  PlacedQuads place(const std::vector<Index>& edges, int degree) const;

 private:
  PlacedQuads smoothed(const SeamlessLattice& lattice, const TMesh& t_mesh,
                       const std::vector<Index>& edges) const;
  PlacedQuads on_integer_grid(const std::vector<Index>& edges, int last_degree) const;

  const SurfaceMesh& mesh_;
  const std::vector<char>& features_;
  const TracedMap& traced_;
  const QuadMeshOptions& options_;
  const RunRecord& record_;
  QuadSeconds& seconds_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
