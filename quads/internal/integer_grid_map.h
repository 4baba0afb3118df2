// Integer-grid maps: seamless maps with all cones, corners and translations at whole multiples of
// an edge length, so that the lines of whole numbers are edges of quads [BZK09].
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
// A seamless map is led to its whole numbers by springs that get stiffer; as soon as all can be set
// exactly, they are, along a path with det J > 0 on every triangle, and the map is optimized again.
// Triangles that straight edges hold back are freed by curved ones: the degree is raised then.
//
// Not for numbers that are no quantization of the map's own T-mesh.
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

// Degrees of maps that are tried, one after the other.
struct GridDegrees {
  int first = 1;
  // Degree 2 has freed all that degree 1 did not, on public meshes
  // (bench/results/integer_grid_maps.txt).
  int last = 3;
};

// map: that of the lattice, of degree 1. The result has the symmetric Dirichlet energy's least
// value that is reached, and det J > 0 proven; nothing where no degree gets there. Throws Stopped.
std::optional<BezierMap> integer_grid_map(const BezierMap& map, const SeamlessLattice& lattice,
                                          const GridTranslations& grid, GridDegrees degrees,
                                          const StopCheck& stop);

// The T-mesh of an integer-grid map, and the edges that its arcs have by their lengths.
class IntegerGrid {
 public:
  // map: of the surface cut open, faces as there. Of a curved map that which is linear on so many
  // parts of each face that it is injective, too, the nearer the more. The surface outlives this.
  // Throws Error(Infeasible) where there is none; Stopped.
  IntegerGrid(const ResolvedSurface& surface, const BezierMap& map, double edge_length,
              const StopCheck& stop);

  const SeamlessLattice& lattice() const { return *lattice_; }
  const TMesh& t_mesh() const { return mesh_; }
  const std::vector<Index>& edges() const { return edges_; }  // by arc

 private:
  std::unique_ptr<const SurfaceMesh> parts_;  // the surface in parts; null: as it is
  std::unique_ptr<SeamlessLattice> lattice_;
  TMesh mesh_;
  std::vector<Index> edges_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
