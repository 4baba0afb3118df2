#include "majorant/parametrization/scaffold/internal/edge_flip.h"

#include <fmt/format.h>

#include <array>
#include <deque>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/element_space.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/half_edge_flip.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/scaffold/internal/moving_barrier.h"
#include "majorant/parametrization/scaffold/internal/quadrilateral.h"

namespace majorant {
namespace {

// The tables shared by all flips of one degree.
class FlipTables {
 public:
  static const FlipTables& of_degree(int n) {
    static const std::vector<FlipTables> tables = [] {
      std::vector<FlipTables> all;
      for (int degree = 1; degree <= BezierTriangleSpace::kMaxDegree; ++degree)
        all.push_back(FlipTables(degree));
      return all;
    }();
    return tables[n - 1];
  }

  // The points of one half of the grid: its corners (0,0) (n,n) (0,n) are corners slot, slot + 1,
  // slot + 2 of the triangle (moving_barrier.h).
  struct Place {
    int row, local;
  };
  const std::vector<Place>& half(int slot) const { return half_[slot]; }

  bool is_injective(const RowMatrix& points) const {
    Vec x(points.size());
    for (int l = 0; l < triangle_.nodes_per_element(); ++l)
      x.segment<2>(2 * triangle_.cells()(0, l)) = points.block<1, 2>(0, 2 * l);
    return triangle_.certify(0, x, ProofDepth::kStart).result == ProofStatus::Proven;
  }

 private:
  explicit FlipTables(int n) : triangle_((Cells(1, 3) << 0, 1, 2).finished(), 3, n) {
    const TriangleIndices& indices = TriangleIndices::of_degree(n);
    for (Index slot = 0; slot < 3; ++slot)
      for (int local = 0; local < indices.count(); ++local) {
        const MultiIndex& m = indices.multi(local);
        const int to = m[next(slot)], apex = m[previous(slot)];
        half_[slot].push_back({(to + apex) * (n + 1) + to, local});
      }
  }

  BezierTriangleSpace triangle_;
  std::array<std::vector<Place>, 3> half_;
};

void require_degree(const BezierMesh& mesh) {
  if (mesh.degree < 1 || mesh.degree > BezierTriangleSpace::kMaxDegree)
    throw InvalidArgument(fmt::format("edge flips: degree must be 1..{}, is {}",
                                      BezierTriangleSpace::kMaxDegree, mesh.degree));
}

// Returns whether an edge joins these vertices, by going around v from the half-edge that leaves
// it.
bool are_joined(const BezierMesh& mesh, Index leaving, Index other) {
  Index h = leaving;
  do {
    if (mesh.to_vertex(h) == other || mesh.from_vertex(previous(h)) == other) return true;
    h = mesh.opposite[previous(h)];
  } while (h >= 0 && h != leaving);
  if (h == leaving) return false;
  for (h = mesh.opposite[leaving]; h >= 0; h = mesh.opposite[next(h)])
    if (mesh.to_vertex(next(h)) == other) return true;
  return false;
}

// Returns whether the half-edge lies between two triangles whose third corners are not joined yet.
bool has_free_diagonal(const BezierMesh& mesh, Index h) {
  const Index o = mesh.opposite[h];
  if (o < 0 || face_of(o) == face_of(h)) return false;
  const Index c = mesh.from_vertex(previous(h)), d = mesh.from_vertex(previous(o));
  return c != d && !are_joined(mesh, previous(h), d);
}

// Returns the grid of the two triangles of an edge; the half-edge is the diagonal of the upper
// half.
Points2 read_grid(const BezierMesh& mesh, Index h) {
  const FlipTables& tables = FlipTables::of_degree(mesh.degree);
  const Index o = mesh.opposite[h];
  const int count = (mesh.degree + 1) * (mesh.degree + 1);
  Points2 grid(count, 2);
  for (const auto& [row, local] : tables.half(corner_of(o)))
    grid.row(count - 1 - row) = mesh.point(face_of(o), local);
  for (const auto& [row, local] : tables.half(corner_of(h)))
    grid.row(row) = mesh.point(face_of(h), local);
  return grid;
}

// Returns the same points with the other diagonal as p = q: rotated by a quarter, so that (0,0) is
// the former (n,0).
Points2 turned(const Points2& grid, int n) {
  Points2 out(grid.rows(), 2);
  for (int q = 0; q <= n; ++q)
    for (int p = 0; p <= n; ++p) out.row(q * (n + 1) + p) = grid.row(p * (n + 1) + n - q);
  return out;
}

// Returns the control points of the upper half, in the order of a triangle.
RowMatrix upper_half(const Points2& grid, const std::vector<FlipTables::Place>& places) {
  RowMatrix points(1, 2 * static_cast<Index>(places.size()));
  for (const auto& [row, local] : places) points.block<1, 2>(0, 2 * local) = grid.row(row);
  return points;
}

Quadrilateral corners(const BezierMesh& mesh, Index h) {
  const Index o = mesh.opposite[h];
  const auto corner = [&](Index side) { return mesh.point(face_of(side), corner_of(side)); };
  return {corner(h), corner(previous(o)), corner(next(h)), corner(previous(h))};
}

bool wants_delaunay_flip(const Quadrilateral& quad) {
  return quad.is_strictly_convex(Quadrilateral::kRounding) &&
         quad.wants_delaunay_flip(Quadrilateral::kRounding);
}

}  // namespace

bool flip_edge(BezierMesh& mesh, Index half_edge) {
  require_degree(mesh);
  if (half_edge < 0 || to_size(half_edge) >= mesh.opposite.size())
    throw InvalidArgument(fmt::format("flip_edge: no half-edge {}", half_edge));
  if (!has_free_diagonal(mesh, half_edge)) return false;
  if (!corners(mesh, half_edge).flips_to_positive(Quadrilateral::kRounding)) return false;

  const int n = mesh.degree;
  const Index h = half_edge, o = mesh.opposite[h];
  const FlipTables& tables = FlipTables::of_degree(n);
  Points2 grid = turned(read_grid(mesh, h), n);
  const auto corner_determinant = [&](int corner, int out, int in) {
    return cross(grid.row(out) - grid.row(corner), grid.row(in) - grid.row(corner));
  };
  // At these two corners two angles merge into one, so det J of the old triangles says nothing
  // there.
  const int first = n * (n + 1), last = n;
  if (!(corner_determinant(first, first - (n + 1), first + 1) > 0) ||
      !(corner_determinant(last, last + (n + 1), last - 1) > 0))
    return false;
  MovingBarrier::of_degree(n).minimize(grid);
  const RowMatrix upper = upper_half(grid, tables.half(corner_of(h)));
  const RowMatrix lower = upper_half(grid.colwise().reverse(), tables.half(corner_of(o)));
  if (!tables.is_injective(upper) || !tables.is_injective(lower)) return false;
  mesh.points.row(face_of(h)) = upper;
  mesh.points.row(face_of(o)) = lower;
  flip_half_edge(mesh.faces, mesh.opposite, h);
  return true;
}

FlipCounts make_delaunay(BezierMesh& mesh, std::vector<char>& is_fixed) {
  require_degree(mesh);
  const std::size_t count = mesh.opposite.size();
  if (!is_fixed.empty() && is_fixed.size() != count)
    throw InvalidArgument(
        fmt::format("edge flips: {} flags for {} half-edges", is_fixed.size(), count));
  std::deque<Index> queue;
  std::vector<char> queued(count, 0), failed(count, 0);
  const auto push = [&](Index h) {
    if (mesh.opposite[h] < 0 || queued[h]) return;
    queued[h] = 1;
    queue.push_back(h);
  };
  for (std::size_t h = 0; h < count; ++h)
    if (static_cast<Index>(h) < mesh.opposite[h]) push(static_cast<Index>(h));

  FlipCounts counts;
  while (!queue.empty()) {
    const Index h = queue.front(), o = mesh.opposite[h];
    queue.pop_front();
    queued[h] = 0;
    if (o < 0 || failed[h]) continue;
    if (!is_fixed.empty() && (is_fixed[h] || is_fixed[o])) continue;
    if (!wants_delaunay_flip(corners(mesh, h))) continue;
    ++counts.intended;
    if (!flip_edge(mesh, h)) {
      failed[h] = failed[o] = 1;
      continue;
    }
    ++counts.performed;
    // Sides get other numbers, so flags are moved with them.
    const FlippedSides moves = flipped_sides(h, o);
    std::array<char, 4> fixed{};
    for (std::size_t k = 0; k < 4 && !is_fixed.empty(); ++k) fixed[k] = is_fixed[moves.from[k]];
    for (std::size_t k = 0; k < 4; ++k) {
      if (!is_fixed.empty()) is_fixed[moves.to[k]] = fixed[k];
      const Index outside = mesh.opposite[moves.to[k]];
      failed[moves.to[k]] = 0;
      if (outside >= 0) failed[outside] = 0;
      push(moves.to[k]);
    }
  }
  return counts;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
