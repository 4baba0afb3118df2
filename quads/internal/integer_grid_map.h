// Integer-grid maps: seamless maps whose cones, corners and translations are at integer multiples
// of an edge length, so that integer lines are edges of quads [BZK09].
//
//   const ResolvedSurface resolved = resolve_feature_edges(*mesh);
//   SeamlessLattice lattice(resolved.mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice, stop);
//   const std::vector<Index> edges(t_mesh.arcs.size(), 2);   // by arc, as Quantization has them
//   const GridTranslations grid(map, lattice, t_mesh, edges, 0.125);
//   if (const auto whole = integer_grid_map(map, lattice, grid, {}, stop)) {
//     const IntegerGrid quads(resolved, *whole, grid.edge_length(), stop);
//     ExtractedQuads extracted(quads.lattice(), quads.t_mesh(), quads.edges());
//   }
//
// Springs of increasing stiffness pull a seamless map to its integers. As soon as all can be set
// exactly along a path with det J > 0 on every triangle, they are, and the map is optimized again.
// If triangles with straight edges block the path, the degree is raised, since curved edges may
// free them.
//
// Only for integers that are a quantization of the map's own T-mesh.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/quads/internal/grid_translations.h"
#include "majorant/quads/internal/resolved_surface.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// The degrees of maps that are tried in order.
struct GridDegrees {
  int first = 1;
  // The benchmark needs at most degree 2 (bench/results/integer_grid_maps.txt).
  int last = 3;
};

// Returns a map with the least symmetric Dirichlet energy that was reached, and with det J > 0
// proven; nothing if no degree succeeds. map: that of the lattice, of degree 1. Throws Stopped.
std::optional<BezierMap> integer_grid_map(const BezierMap& map, const SeamlessLattice& lattice,
                                          const GridTranslations& grid, GridDegrees degrees,
                                          const StopCheck& stop);

// The T-mesh of an integer-grid map with the numbers of edges of its arcs, from their lengths.
class IntegerGrid {
 public:
  // map: of the surface cut open, with the same faces. A curved map is replaced by one that is
  // linear on so many parts of each face that it is injective, too. The surface must outlive this.
  // Throws Error(Infeasible) if there is none; Stopped.
  IntegerGrid(const ResolvedSurface& surface, const BezierMap& map, double edge_length,
              const StopCheck& stop);

  const SeamlessLattice& lattice() const { return *lattice_; }
  const TMesh& t_mesh() const { return mesh_; }
  const std::vector<Index>& edges() const { return edges_; }  // by arc

 private:
  std::unique_ptr<const SurfaceMesh> parts_;  // the subdivided surface; null: the surface itself
  std::unique_ptr<SeamlessLattice> lattice_;
  TMesh mesh_;
  std::vector<Index> edges_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
