#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "majorant/framework/sparse_spd.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/initialization/area_margin.h"
#include "majorant/parametrization/initialization/filled_holes.h"
#include "majorant/parametrization/initialization/internal/weighted_tutte.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/initialization/tutte_system.h"

namespace majorant {
namespace {

// The spacing of the boundary on its circle: by arc length on the surface, or halfway between that
// and equal angles, which gives tiny edges room.
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
  return message_prefix(file) +
         "the Laplacian of the initial map cannot be factorized; check the mesh for defects";
}

// Returns flags of the vertices of the outer loop. Vertices that fill holes follow those of the
// mesh.
std::vector<char> on_outer_loop(const SurfaceMesh& mesh) {
  std::vector<char> held(to_size(mesh.vertex_count()) + mesh.boundary_loops().size() - 1, 0);
  for (const Index v : outer_loop(mesh)) held[v] = 1;
  return held;
}

// Returns Tutte's map, up to the resolution of doubles.
Vec mean_map(const SurfaceMesh& mesh, const StopCheck& stop) {
  Vec x = tutte_boundary(mesh);
  const MeanOfNeighbours means(filled_faces(mesh), on_outer_loop(mesh));
  if (means.vertices().empty()) return x;
  const EdgeLaplacian laplacian = means.laplacian();
  const Vec values = means.values(laplacian);
  stop.poll();
  const SparseSpd matrix(laplacian.pattern(), values, no_solution(mesh.file()), stop);
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

// Tries other convex combinations if the means of neighbours leave faces without a margin of area.
// Returns the first map that gives all faces a margin, else the one that does for most.
Vec map_with_area_margin(const SurfaceMesh& mesh, Vec best, const StopCheck& stop) {
  Index least = faces_without_area_margin(mesh.faces(), best);
  if (least == 0) return best;
  const Cells faces = filled_faces(mesh);
  const std::vector<char> held = on_outer_loop(mesh);
  for (const Spacing spacing : {Spacing::ArcLength, Spacing::Halfway})
    for (const double leaning : kLeanings) {
      Vec x = Vec::Zero(2 * static_cast<Index>(held.size()));
      place_boundary(mesh, spacing, x);
      x = weighted_tutte(faces, held, x, leaning, no_solution(mesh.file()), stop)
              .head(2 * mesh.vertex_count())
              .eval();
      const Index without = faces_without_area_margin(mesh.faces(), x);
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
  return map_with_area_margin(mesh, mean_map(mesh, stop), stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
