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

#include <limits>
#include <optional>
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
  // L-BFGS on a level: pairs that are kept, steps for a factorization, steps. Origin:
  // bench/multiresolution.
  int history = 8, metric_every = 10, most_steps = 30;
  // Relative decrease that ends a level of at most `coarse_part` of all triangles, and a finer one.
  // Origin: bench/multiresolution.
  double coarse_part = 1.0 / 8, coarse_decrease = 1e-5, decrease = 1e-4;
  // Of the energy, from one level to the next: a larger drop gives the start up, since what is
  // coarse says nothing of what is fine. Infinite: never.
  double largest_drop = std::numeric_limits<double>::infinity();
};

// What a level cost: for measurements.
struct LevelRecord {
  Index faces = 0;
  Index hot = 0;      // vertices whose neighbours gave way
  int steps = 0;      // of all vertices together
  double energy = 0;  // mean, after these
  double insert_seconds = 0, sweep_seconds = 0, solve_seconds = 0;  // CPU time of the process
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
