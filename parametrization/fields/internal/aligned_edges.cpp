#include "majorant/parametrization/fields/internal/aligned_edges.h"

#include <algorithm>
#include <cmath>

#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// The largest planned corner of a quad, in quarter turns. Fields that follow edges are made for
// quads, whose corners must be below 180 degrees.
constexpr double kLargestCorner = 160.0 / 90;

bool is_parallel(const FieldGeometry& geometry, const Vec& fixed, Index h) {
  constexpr double kTolerance = 1e-6;  // radians
  const double off = fixed[face_of(h)] - geometry.edge_direction[h];
  return std::abs(std::remainder(off, kQuarter)) < kTolerance;
}

// Returns flags of the half-edges that the fixed faces on both sides follow (3 #F).
std::vector<char> followed_edges(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                 const std::vector<char>& is_aligned, const Vec& fixed) {
  std::vector<char> followed(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < 0)
      followed[h] = is_aligned[h] && is_parallel(geometry, fixed, h);
    else
      followed[h] = (is_aligned[h] || is_aligned[o]) && is_parallel(geometry, fixed, h) &&
                    is_parallel(geometry, fixed, o);
  }
  return followed;
}

// Returns for each vertex a followed half-edge that starts there, at the boundary the boundary one,
// or -1 (#V).
std::vector<Index> first_bounds(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                const std::vector<char>& is_bound) {
  const auto size = to_size(mesh.vertex_count());
  std::vector<int> border_edges(size, 0);
  std::vector<Index> first(size, -1);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (!is_bound[h]) continue;
    Index& of_vertex = first[mesh.from_vertex(h)];
    if (mesh.opposite(h) < 0) {
      ++border_edges[mesh.from_vertex(h)];
      ++border_edges[mesh.to_vertex(h)];
      of_vertex = h;
    } else if (!geometry.is_boundary[mesh.from_vertex(h)]) {
      of_vertex = h;
    }
  }
  for (std::size_t v = 0; v < size; ++v)
    if (geometry.is_boundary[v] && border_edges[v] < 2) first[v] = -1;
  return first;
}

// Adds the sectors around the vertex where a half-edge starts. Returns for each sector the
// half-edge that bounds it, with the sector's faces on its left.
std::vector<Index> add_sectors(const SurfaceMesh& mesh, Index first, AlignedSectors& sectors) {
  std::vector<Index> bounds;
  Index h = first;
  do {
    if (h == first || sectors.is_bound[h]) {
      bounds.push_back(h);
      sectors.at[mesh.from_vertex(h)].push_back(static_cast<Index>(sectors.faces.size()));
      sectors.vertex.push_back(mesh.from_vertex(h));
      sectors.faces.push_back(0);
    }
    sectors.of_corner[h] = static_cast<Index>(sectors.faces.size()) - 1;
    ++sectors.faces.back();
    h = mesh.opposite(previous(h));
  } while (h >= 0 && h != first);
  return bounds;
}

// Returns the angle sums of the sectors, radians.
Vec sector_angles(const SurfaceMesh& mesh, const AlignedSectors& sectors) {
  Vec angle = Vec::Zero(static_cast<Index>(sectors.faces.size()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (const Index s = sectors.of_corner[h]; s >= 0) angle[s] += corner_angle(mesh, h).radians();
  return angle;
}

std::vector<int> sector_turns(const SurfaceMesh& mesh, const AlignedSectors& sectors,
                              const Vec& angle, const Vec& rotation) {
  Vec left = angle;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o >= 0 && sectors.of_corner[o] >= 0 && !sectors.is_bound[h])
      left[sectors.of_corner[o]] -= rotation[h];
  }
  std::vector<int> turns;
  for (const double sum : left) turns.push_back(static_cast<int>(std::lround(sum / kQuarter)));
  return turns;
}

// Rounds the angles of sectors. angle: by sector, in quarter turns.
std::vector<int> rounded_turns(const Vec& angle) {
  std::vector<int> rounded;
  for (const double turns : angle) {
    // An angle halfway between two numbers counts as straight.
    constexpr double kTie = 1e-3;
    rounded.push_back(
        std::abs(turns - 2) < 0.5 + kTie ? 2 : std::max(1, static_cast<int>(std::lround(turns))));
  }
  return rounded;
}

// Lowers the targets of reflex sectors beside tips along the border of a region. A tip of less than
// half a quarter turn still has a whole one, and the sectors before and after it make up for half
// of the difference each. Otherwise a cone inside the region would be needed for every such tip.
// angle: by sector, in quarter turns. bounds: by sector, the half-edge that bounds it.
void lower_beside_tips(const Vec& angle, const std::vector<Index>& bounds,
                       AlignedSectors& sectors) {
  const std::size_t count = bounds.size();
  std::vector<Index> after(count, -1), before(count, -1);
  for (std::size_t s = 0; s < count; ++s) {
    after[s] = sectors.of_corner[next(bounds[s])];
    if (after[s] >= 0) before[after[s]] = static_cast<Index>(s);
  }
  std::vector<int>& target = sectors.target;
  Vec lacking = Vec::Zero(angle.size());
  for (std::size_t s = 0; s < count; ++s) {
    const Index tip = static_cast<Index>(s);
    if (angle[tip] >= 0.5) continue;
    for (const std::vector<Index>* beside : {&after, &before}) {
      Index t = (*beside)[s];
      while (t >= 0 && t != tip && target[t] == 2) t = (*beside)[t];
      if (t >= 0 && target[t] > 2) lacking[t] += (1 - angle[tip]) / 2;
    }
  }
  for (Index s = 0; s < lacking.size(); ++s)
    if (lacking[s] > 0 && angle[s] - lacking[s] < target[s] - 0.5) --target[s];
}

}  // namespace

Vec fixed_angles(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                 const std::vector<char>& is_aligned) {
  Vec angle = Vec::Constant(mesh.face_count(), kNotAligned);
  if (is_aligned.empty()) return angle;
  Vec longest = Vec::Zero(mesh.face_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (!is_aligned[h] && (o < 0 || !is_aligned[o])) continue;
    const double length =
        (mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h)))
            .norm();
    if (length <= longest[face_of(h)]) continue;
    longest[face_of(h)] = length;
    angle[face_of(h)] = std::remainder(geometry.edge_direction[h], 4 * kQuarter);
  }
  return angle;
}

int least_turns_at(double angle, int regular) {
  return std::min(regular, static_cast<int>(std::ceil(angle / kLargestCorner)));
}

AlignedSectors aligned_sectors(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                               const std::vector<char>& is_aligned, const Vec& fixed,
                               const Vec& rotation) {
  AlignedSectors sectors;
  sectors.is_bound = followed_edges(mesh, geometry, is_aligned, fixed);
  sectors.of_corner.assign(sectors.is_bound.size(), -1);
  sectors.at.resize(to_size(mesh.vertex_count()));
  std::vector<Index> bounds;
  for (const Index h : first_bounds(mesh, geometry, sectors.is_bound)) {
    if (h < 0) continue;
    const std::vector<Index> around = add_sectors(mesh, h, sectors);
    bounds.insert(bounds.end(), around.begin(), around.end());
  }
  const Vec angle = sector_angles(mesh, sectors);
  sectors.turns = sector_turns(mesh, sectors, angle, rotation);
  const Vec quarters = angle / kQuarter;
  sectors.target = rounded_turns(quarters);
  lower_beside_tips(quarters, bounds, sectors);
  for (Index s = 0; s < quarters.size(); ++s)
    sectors.least.push_back(std::max(1, least_turns_at(quarters[s], sectors.target[s])));
  return sectors;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
