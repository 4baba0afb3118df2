#include "distributed/starts_of_parts.h"

#include <optional>
#include <utility>

#include "distributed/internal/part_data.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/internal/free_scale.h"
#include "majorant/parametrization/drive/internal/reach_pins.h"
#include "majorant/parametrization/fields/internal/edge_laplacian.h"
#include "majorant/parametrization/starts/internal/filled_holes.h"
#include "majorant/parametrization/starts/internal/room.h"
#include "majorant/parametrization/starts/tutte.h"

namespace majorant {
namespace {

// Residual asked for. Origin: no face of 13 disks of 10,000 faces was turned over, energies were
// those of a factorization to 5e-7 (measured once; no command).
constexpr double kTutteTolerance = 1e-12;

// Every vertex inside is the mean of its neighbours: the rows that this rank's faces give.
class Means {
 public:
  explicit Means(const MeshPart& part) : faces_(part.mesh->faces()) {
    row_of_.assign(at(part.mesh->vertex_count()), 0);
    for (const Index v : part.boundary_vertices) row_of_[at(v)] = -1;
    for (std::size_t v = 0; v < row_of_.size(); ++v) {
      if (row_of_[v] < 0) continue;
      row_of_[v] = static_cast<Index>(inside_.size());
      inside_.push_back(static_cast<Index>(v));
    }
    partition_ = part.vertices().part(inside_);
  }

  void solve(LinearSolver& solver, Vec& x) const {
    if (partition_.global_size() == 0) return;
    const EdgeLaplacian laplacian(faces_, row_of_);
    solver.analyze_shared(laplacian.pattern(), partition_);
    // An edge counts once, its two half-edges half each, on whichever ranks they are.
    const Vec values = laplacian.values(Vec::Constant(3 * faces_.rows(), 0.5));
    if (solver.factorize(values, 0) != FactorStatus::Ok) refuse();
    for (const int c : {0, 1}) {
      Vec solution;
      Vec rhs = right_hand_side(x, c);
      partition_.add_to_owners(rhs);
      if (solver.solve(rhs, solution, kTutteTolerance).status == SolveStatus::Indefinite) refuse();
      for (std::size_t r = 0; r < inside_.size(); ++r)
        x[2 * inside_[r] + c] = solution[static_cast<Index>(r)];
    }
  }

 private:
  [[noreturn]] static void refuse() {
    throw Error(ErrorKind::Infeasible, "the system of the initial map cannot be solved");
  }

  Vec right_hand_side(const Vec& x, int c) const {
    Vec rhs = Vec::Zero(static_cast<Index>(inside_.size()));
    for (Index h = 0; h < 3 * static_cast<Index>(faces_.rows()); ++h) {
      const Index row = row_of_[at(from_vertex(faces_, h))], other = to_vertex(faces_, h);
      if (row >= 0 && row_of_[at(other)] < 0) rhs[row] += x[2 * other + c];
    }
    return rhs;
  }

  const Cells& faces_;
  std::vector<Index> row_of_, inside_;
  Partition partition_;
};

// boundary: rank 0's, 2 numbers per vertex of the whole surface, that of `part`.
Vec means(const MeshPart& part, const Vec& boundary, LinearSolver& solver) {
  Vec x = of_vertices(part, boundary, 2);
  Means(part).solve(solver, x);
  return x;
}

// The same of the surface with its holes filled, which is divided by itself.
Vec means_around_holes(const MeshPart& part, const SurfaceMesh* whole, const Vec& boundary,
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
  const Vec x = whole_of_vertices(around, means(around, filled_boundary, solver), 2);
  return of_vertices(part, x.head(boundary.size()), 2);
}

}  // namespace

TutteOfParts tutte_of_parts(const MeshPart& part, const SurfaceMesh* whole,
                            const SolverFactory& solver) {
  TutteOfParts result;
  const bool holes = part.ranks().of_first(whole && whole->boundary_loops().size() > 1);
  const Vec boundary = whole ? tutte_boundary(*whole) : Vec();
  result.uv = holes ? means_around_holes(part, whole, boundary, *solver())
                    : means(part, boundary, *solver());
  const Cells& faces = part.mesh->faces();
  result.on_one_rank =
      part.ranks().any(faces.rows() > 0 && faces_without_room(faces, result.uv) > 0);
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
    options = with_targets(start, std::move(options));
    require_pinned_once(*whole, options.map.pins);
    moves = !meets_pins(start, options.map.pins);
    if (moves) {
      require_scale(options.map, start);
      led = reach_pins(start, options, record).control_points();
    }
  }
  if (!ranks.of_first(moves)) return false;
  uv = of_vertices(part, led, 2);
  return true;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
