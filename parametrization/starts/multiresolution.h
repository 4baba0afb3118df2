// The start of large disks: solved where the surface has few triangles, refined vertex by vertex.
//
//   MapObjective asked;                                // symmetric Dirichlet, free boundary
//   std::optional<Vec> uv = multiresolution_map(mesh, asked);
//   if (!uv) uv = tutte_map(mesh);
//
// Vertices are moved onto neighbours until a few hundred triangles are left; Tutte's map of those
// is optimized; then the vertices come back in reverse order, each at the place that is best for
// the triangles around it. At sizes that grow by a constant ratio the whole map is improved, vertex
// by vertex and by steps of Newton's method on the mesh of that size. The last size, the surface
// itself, is left to the caller: what it gets is usually within 1e-3 of the minimum, often within
// 1e-4, whatever the number of triangles, and costs about what three to six factorizations on the
// surface do. Not for small meshes, where a few steps from Tutte's map cost less.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/maps/map_objective.h"

namespace majorant {

// Whether the energy and the boundary that are asked for are ones that multiresolution_map() knows:
// energies with a barrier; sector sums at boundary vertices may not be held.
bool suits_multiresolution(const SurfaceMesh& mesh, const MapObjective& asked);

// How multiresolution_map() works. Nobody but measurements changes this.
struct MultiresolutionRules {
  // Triangles of the coarsest mesh. Origin: bench/multiresolution.
  Index coarsest = 400;
  // Of the numbers of triangles of two levels. Origin: bench/multiresolution.
  double ratio = 4;
  // Newton steps of a vertex when it comes back. Origin: bench/multiresolution.
  int insertion_steps = 4;
  // Of the mean energy of a vertex' triangles to that of the level before: above, its neighbours
  // give way. Origin: bench/multiresolution.
  double hot = 2;
  int hot_rounds = 6;
  // Rounds over all vertices when a level is complete. Origin: bench/multiresolution.
  int sweeps = 4;
  // Relative decrease that ends a level, at most `coarse_part` of the faces, and above.
  double coarse_part = 1.0 / 8;
  double coarse_decrease = 1e-5;
  double decrease = 1e-4;
  int least_steps = 2, most_steps = 30;
};

// What a level cost: for measurements.
struct LevelRecord {
  Index faces = 0;
  int steps = 0;                               // of Newton's method
  double inserted = 0, swept = 0, energy = 0;  // mean energy, after each of the three
  double insert_seconds = 0, sweep_seconds = 0, newton_seconds = 0;
  Index hot = 0, squeezed = 0;  // vertices with hot stars; put near the one they had collapsed onto
};
struct MultiresolutionRecord {
  double decimation_seconds = 0;
  std::vector<LevelRecord> levels;  // the coarsest first
};

// u, v per vertex, model units; every face positive with room (Tutte's boundary where
// asked.boundary is fixed). Deterministic, whatever the number of threads. None where the surface
// is too small or unsuited, or doubles have no room. Needs a disk, possibly with holes; throws
// Error as tutte_map(); Stopped.
std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapObjective& asked,
                                       const StopCheck& stop = {},
                                       const MultiresolutionRules& rules = {},
                                       MultiresolutionRecord* record = nullptr);

}  // namespace majorant
