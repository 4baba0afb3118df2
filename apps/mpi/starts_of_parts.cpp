#include "apps/mpi/starts_of_parts.h"

#include <optional>
#include <utility>
#include <vector>

#include "apps/mpi/internal/part_data.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/initialization/area_margin.h"
#include "majorant/parametrization/initialization/filled_holes.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/initialization/tutte_system.h"
#include "majorant/parametrization/solve/free_scale.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "majorant/parametrization/solve/pin_homotopy.h"

namespace majorant {
namespace {

// The requested residual. With it no face of the benchmarks is turned over, and energies agree with
// those of a factorization to 5e-7.
constexpr double kTutteTolerance = 1e-12;

[[noreturn]] void refuse() {
  throw Error(ErrorKind::Infeasible, "the system of the initial map cannot be solved");
}

// boundary: on rank 0, 2 numbers for each vertex of the whole surface; `part` must have the same
// boundary.
Vec mean_map(const MeshPart& part, const Vec& boundary, LinearSolver& solver) {
  Vec x = of_vertices(part, boundary, 2);
  std::vector<char> held(to_size(part.mesh->vertex_count()), 0);
  for (const Index v : part.boundary_vertices) held[v] = 1;
  const MeanOfNeighbours means(part.mesh->faces(), held);
  const Partition partition = part.vertices().part(means.vertices());
  if (partition.global_size() == 0) return x;
  const EdgeLaplacian laplacian = means.laplacian();
  analyze_shared(solver, laplacian.pattern(), partition);
  if (solver.factorize(means.values(laplacian), 0) != FactorStatus::Ok) refuse();
  for (const int c : {0, 1}) {
    Vec solution;
    Vec rhs = means.right_hand_side(x, c);
    partition.add_to_owners(rhs);
    if (solver.solve(rhs, solution, kTutteTolerance).status == SolveStatus::Indefinite) refuse();
    for (std::size_t r = 0; r < means.vertices().size(); ++r)
      x[2 * means.vertices()[r] + c] = solution[static_cast<Index>(r)];
  }
  return x;
}

// Returns the map of the surface with filled holes, for which it is partitioned anew.
Vec mean_map_around_holes(const MeshPart& part, const SurfaceMesh* whole, const Vec& boundary,
                          LinearSolver& solver) {
  std::optional<SurfaceMesh> filled;
  std::vector<int> rank_of_face;
  Vec filled_boundary;
  if (whole) {
    filled = filled_surface(*whole);
    rank_of_face = face_ranks(*filled, part.ranks().count());
    filled_boundary = Vec::Zero(2 * filled->vertex_count());
    filled_boundary.head(boundary.size()) = boundary;
  }
  const MeshPart around = distributed(filled ? &*filled : nullptr, rank_of_face, part.shared_ranks);
  const Vec x = whole_of_vertices(around, mean_map(around, filled_boundary, solver), 2);
  return of_vertices(part, x.head(boundary.size()), 2);
}

}  // namespace

TutteOfParts tutte_of_parts(const MeshPart& part, const SurfaceMesh* whole,
                            const SolverFactory& solver) {
  TutteOfParts result;
  const bool holes = part.ranks().of_first(whole && whole->boundary_loops().size() > 1);
  const Vec boundary = whole ? tutte_boundary(*whole) : Vec();
  result.uv = holes ? mean_map_around_holes(part, whole, boundary, *solver())
                    : mean_map(part, boundary, *solver());
  const Cells& faces = part.mesh->faces();
  result.on_one_rank =
      part.ranks().any(faces.rows() > 0 && faces_without_area_margin(faces, result.uv) > 0);
  if (result.on_one_rank) result.uv = of_vertices(part, whole ? tutte_map(*whole) : Vec(), 2);
  return result;
}

bool led_to_pins(const MeshPart& part, const std::shared_ptr<const SurfaceMesh>& whole, Vec& uv,
                 ParametrizationOptions& options, RunRecord& record) {
  const Ranks& ranks = part.ranks();
  if (ranks.of_first(options.map.pins.empty() && options.map.handles.empty())) return false;
  const Vec of_all = whole_of_vertices(part, uv, 2);
  bool moves = false;
  Vec led;
  if (ranks.rank() == 0) {
    const BezierMap start = BezierMap::linear(whole, of_all);
    options.map = with_targets(start, std::move(options.map));
    require_pinned_once(*whole, options.map.pins);
    moves = !meets_pins(start, options.map.pins);
    if (moves) {
      require_scale(options.map, start);
      led = pin_homotopy(start, options.map, options.solve, pin_solver(record), record)
                .control_points();
    }
  }
  if (!ranks.of_first(moves)) return false;
  uv = of_vertices(part, led, 2);
  return true;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
