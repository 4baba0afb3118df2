// The main job: a low-distortion, certified locally injective, piecewise degree-n map of a disk, or
// of a surface cut open along seams.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//   ParametrizationOptions options;
//   options.degree = 3;
//   ParametrizationResult result = parametrize(mesh, options);
//   Vector2 uv = result.map->evaluate(12, {0.2, 0.3, 0.5});
//
// Tutte start (or the caller's), Newton on the energy with det J > 0 held by the line search, the
// degree raised step by step. [MC20], method.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "majorant/energies/named_energies.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/run_record.h"
#include "majorant/parametrization/maps/bezier_map.h"
#include "majorant/parametrization/maps/map_problem.h"
#include "majorant/parametrization/maps/measure.h"
#include "majorant/parametrization/scaffold/edge_flip.h"

namespace majorant {

enum class Elevation { Incremental, Direct };

// Local: det J > 0 and angle sums; Global: no overlaps either, held by a scaffold (scaffold.h).
enum class MapInjectivity { Local, Global };

// Omitted: for comparison only; the scaffold's shape suffers.
enum class ScaffoldFlips { Performed, Omitted };

struct Pin {
  Index vertex;                   // of the mesh
  std::optional<Vector2> target;  // model units; none: where the initial map has the vertex
};

struct ParametrizationOptions {
  int degree = 3;  // 1..8
  EnergySum energy{{symmetric_dirichlet(), 1.0}};
  Vec face_weight;  // #F positive factors of the energy's density, empty = all 1
  Curvature curvature = Curvature::Projected;
  BoundaryCondition boundary = BoundaryCondition::Free;
  BoundaryAngles boundary_angles = BoundaryAngles::Free;
  Elevation elevation = Elevation::Incremental;
  MapInjectivity injectivity = MapInjectivity::Local;
  ScaffoldFlips scaffold_flips = ScaffoldFlips::Performed;
  std::vector<Pin> pins;       // hard
  std::vector<Index> aligned;  // half-edges of the start's mesh that stay parallel to an axis
  std::vector<Pin> handles;    // soft
  double handle_weight = 1e3;  // w: mean density + w * sum |x - target|^2 / area
  std::optional<Vec> initial;  // u, v per vertex; none: Tutte's map
  int quadrature_points = 0;   // lattice points per triangle; 0: our own rule
  double tolerance = 1e-6;     // relative energy decrease per iteration
  double elevation_tolerance = 1e-4;  // the degree is raised below this decrease
  int injectivity_depth = 5;          // of bisection; deeper when a run is held back
};

struct ParametrizationResult {
  Status status = Status::Failed;
  std::string message;
  std::optional<BezierMap> map;    // absent only when status is Infeasible or Failed
  double initial_value = 0;        // mean density of the start
  double value_quadrature = 0;     // the optimizer's own energy at the end
  double newton_decrement = 0;     // relative to the energy
  double constraint_residual = 0;  // model units
  double start_moved = 0;          // by aligning edges, largest distance, model units
  double handle_distance = 0;      // largest distance of a soft handle from its target, model units
  Index variables = 0;
  MapMeasures measures;
  std::vector<long> injectivity_tests;  // elements certified, by bisection depth
  FlipCounts flips;                     // of the scaffold's edges
  bool other_triangles = false;         // the map's faces are not those of the input (improve_mesh)
  std::optional<BezierMesh> scaffold;   // around the map, model units; of MapInjectivity::Global
  double initialize_seconds = 0, optimize_seconds = 0, measure_seconds = 0;
};

// The start that `options` ask for: Tutte's map or the given one, u, v per vertex. Throws
// Error(Unsupported) when the mesh is no disk (for MapInjectivity::Global: no disk with or without
// holes), Error(Usage) when the given one has the wrong size; Stopped.
Vec initial_map(const SurfaceMesh& mesh, const ParametrizationOptions& options,
                const StopCheck& stop = {});

// Throws Error as initial_map; Error(Infeasible) when the start is not locally injective, does not
// meet the pins or has an aligned edge off its axis by more than kSeamTolerance (texture_seams.h);
// Error(Unsupported) when a vertex is pinned twice or pinned and a handle; Error(Usage) when the
// energy does not support the curvature or would shrink the map to a point (free_scale.h), or
// options are out of range; Stopped before there is a
// start. From then on a stop ends the run with the best map so far.
ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options, RunRecord& record);
ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options);
// From a map of degree 1 instead, of a disk or of any cut surface whose seams then hold exactly
// (texture_seams.h); options.initial is ignored. The start must satisfy its seams to rounding.
ParametrizationResult parametrize(const BezierMap& start, const ParametrizationOptions& options,
                                  RunRecord& record);

}  // namespace majorant
