#include "majorant/parametrization/starts/tutte.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "majorant/framework/internal/sparse_spd.h"
#include "majorant/mesh/half_edge.h"
#include "majorant/mesh/internal/mesh_words.h"
#include "majorant/parametrization/fields/internal/edge_laplacian.h"
#include "majorant/parametrization/starts/internal/filled_holes.h"
#include "majorant/parametrization/starts/internal/leaning_map.h"
#include "majorant/parametrization/starts/internal/room.h"

namespace majorant {
namespace {

// How the boundary is spaced on its circle: as on the surface, or, halfway to equal angles, so that
// edges that are tiny there get room.
enum class Spacing { ArcLength, Halfway };

void place_boundary(const SurfaceMesh& mesh, Spacing spacing, Vec& x) {
  const std::vector<Index>& loop = outer_loop(mesh);
  const double radius = std::sqrt(mesh.area() / std::numbers::pi);
  std::vector<double> arc{0.0};
  for (std::size_t k = 0; k < loop.size(); ++k)
    arc.push_back(
        arc.back() +
        (mesh.positions().row(loop[(k + 1) % loop.size()]) - mesh.positions().row(loop[k])).norm());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    double angle = 2 * std::numbers::pi * arc[k] / arc.back();
    if (spacing == Spacing::Halfway)
      angle = (angle +
               2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(loop.size())) /
              2;
    x[2 * loop[k]] = radius * std::cos(angle);
    x[2 * loop[k] + 1] = radius * std::sin(angle);
  }
}

std::string no_solution(const std::string& file) {
  return opening(file) +
         "the Laplacian of the initial map cannot be factorized; check the mesh with " +
         std::string(either(file, "`majorant info`", "find_defects()"));
}

// Every vertex but those of the outer loop, whose places are known, is the mean of its neighbours.
class MeanOfNeighbours {
 public:
  explicit MeanOfNeighbours(const SurfaceMesh& mesh) : faces_(filled_faces(mesh)) {
    row_of_.assign(at(mesh.vertex_count()) + mesh.boundary_loops().size() - 1, 0);
    for (const Index v : outer_loop(mesh)) row_of_[at(v)] = -1;
    for (std::size_t v = 0; v < row_of_.size(); ++v) {
      if (row_of_[v] < 0) continue;
      row_of_[v] = static_cast<Index>(vertices_.size());
      vertices_.push_back(static_cast<Index>(v));
    }
  }

  const std::vector<Index>& vertices() const { return vertices_; }  // by row

  SparseSpd matrix(const std::string& file, const StopCheck& stop) const {
    const EdgeLaplacian laplacian(faces_, row_of_);
    // An edge counts once, its two half-edges half each.
    const Vec values = laplacian.values(Vec::Constant(3 * faces_.rows(), 0.5));
    stop.poll();
    return SparseSpd(laplacian.pattern(), values, no_solution(file), stop);
  }

  // Of coordinate c: sums over the neighbours on the outer loop. x: u, v by vertex.
  Vec right_hand_side(const Vec& x, int c) const {
    std::vector<std::pair<Index, Index>> links;  // row, neighbour
    for (Index h = 0; h < 3 * static_cast<Index>(faces_.rows()); ++h) {
      const Index row = row_of_[at(from_vertex(faces_, h))], neighbour = to_vertex(faces_, h);
      if (row >= 0 && row_of_[at(neighbour)] < 0) links.emplace_back(row, neighbour);
    }
    std::sort(links.begin(), links.end());  // sums do not depend on the order of faces
    Vec rhs = Vec::Zero(static_cast<Index>(vertices_.size()));
    for (const auto& [row, neighbour] : links) rhs[row] += x[2 * neighbour + c];
    return rhs;
  }

 private:
  Cells faces_;
  std::vector<Index> row_of_;  // by vertex, -1 on the outer loop
  std::vector<Index> vertices_;
};

// Tutte's map, as far as doubles can tell points apart.
Vec mean_map(const SurfaceMesh& mesh, const StopCheck& stop) {
  Vec x = tutte_boundary(mesh);
  const MeanOfNeighbours means(mesh);
  if (means.vertices().empty()) return x;
  const SparseSpd matrix = means.matrix(mesh.file(), stop);
  const Vec u = matrix.solve(means.right_hand_side(x, 0));
  const Vec v = matrix.solve(means.right_hand_side(x, 1));
  for (std::size_t r = 0; r < means.vertices().size(); ++r) {
    const Index vertex = means.vertices()[r];
    if (vertex >= mesh.vertex_count()) continue;  // in a hole
    x[2 * vertex] = u[static_cast<Index>(r)];
    x[2 * vertex + 1] = v[static_cast<Index>(r)];
  }
  return x;
}

// Other convex combinations, where the means of neighbours left faces no room: the first that
// leaves some to all of them, else what leaves it to most.
Vec map_with_room(const SurfaceMesh& mesh, Vec best, const StopCheck& stop) {
  Index least = faces_without_room(mesh.faces(), best);
  if (least == 0) return best;
  const Cells faces = filled_faces(mesh);
  std::vector<char> held(at(mesh.vertex_count()) + mesh.boundary_loops().size() - 1, 0);
  for (const Index v : outer_loop(mesh)) held[at(v)] = 1;
  for (const Spacing spacing : {Spacing::ArcLength, Spacing::Halfway})
    for (const double leaning : kLeanings) {
      Vec x = Vec::Zero(2 * static_cast<Index>(held.size()));
      place_boundary(mesh, spacing, x);
      x = leaning_map(faces, held, x, leaning, no_solution(mesh.file()), stop)
              .head(2 * mesh.vertex_count())
              .eval();
      const Index without = faces_without_room(mesh.faces(), x);
      if (without >= least) continue;
      least = without;
      best = std::move(x);
      if (least == 0) return best;
    }
  return best;
}

}  // namespace

Vec tutte_boundary(const SurfaceMesh& mesh) {
  mesh.require_planar();
  Vec x = Vec::Zero(2 * mesh.vertex_count());
  place_boundary(mesh, Spacing::ArcLength, x);
  return x;
}

Vec tutte_map(const SurfaceMesh& mesh, const StopCheck& stop) {
  mesh.require_planar();
  return map_with_room(mesh, mean_map(mesh, stop), stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
