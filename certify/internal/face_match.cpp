#include "majorant/certify/internal/face_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "majorant/certify/internal/cell_pool.h"
#include "majorant/certify/internal/polygon_match.h"
#include "majorant/certify/internal/repaired_faces.h"
#include "majorant/mesh/weld.h"

namespace majorant {
namespace {

bool takes_apart(const RepairedSurface& repaired) {
  return std::any_of(repaired.repairs.begin(), repaired.repairs.end(), [](const Repair& r) {
    return r.kind != RepairKind::RegularizedFace && r.kind != RepairKind::MovedToOrigin;
  });
}

CellCorners rotated(const CellCorners& corners, std::size_t by) {
  return {corners[by % 3], corners[(by + 1) % 3], corners[(by + 2) % 3]};
}

// Takes a cell for every face that repair() makes of the polygon. Returns whether all were found.
bool take_faces(const RepairedFaces& faces, Index polygon, CellPool& pool) {
  std::vector<Index> found;
  for (const Index f : faces.faces_of[polygon]) {
    CellCorners places = faces.corners(f);
    for (Index& corner : places) corner = faces.place(polygon, corner);
    const std::vector<Index>& candidates = pool.at(places[0]);
    const auto it = std::find_if(candidates.begin(), candidates.end(), [&](Index c) {
      const CellCorners has = pool.places(c);
      return pool.may_be_of(c, polygon) &&
             std::find(found.begin(), found.end(), c) == found.end() &&
             (has == places || rotated(has, 1) == places || rotated(has, 2) == places);
    });
    if (it == candidates.end()) return false;
    found.push_back(*it);
  }
  pool.take(found);
  return true;
}

// Returns whether the edges of the cells are these, once each, except for pairs that cancel.
bool edges_are(const std::set<std::pair<Index, Index>>& border, const std::vector<Index>& cells,
               const CellPool& pool) {
  std::set<std::pair<Index, Index>> edges;
  for (const Index c : cells) {
    const CellCorners corners = pool.places(c);
    for (Index k = 0; k < 3; ++k)
      if (!edges.emplace(corners[k], corners[next(k)]).second) return false;
  }
  std::erase_if(edges, [edges](const auto& e) { return edges.contains({e.second, e.first}); });
  return edges == border;
}

// Accepts a triangulation of a polygon whose corners are at different places. It has n - 2
// triangles, none of which faces the other way. Its edges are those of the polygon, once each, and
// pairs that cancel; so it is a disk.
bool take_triangulation(const RepairedFaces& faces, Index polygon, double close, CellPool& pool) {
  const std::vector<Index>& own = faces.faces_of[polygon];
  const auto size = static_cast<Index>(faces.surface.polygons[polygon].size());
  if (size == 3) return false;
  const bool is_turned = !faces.is_ascending(own.front());
  for (const Index f : own)
    if (faces.is_ascending(f) == is_turned) return false;
  std::set<Index> corners;
  std::set<std::pair<Index, Index>> border;
  for (Index k = 0; k < size; ++k) {
    const Index a = faces.place(polygon, k), b = faces.place(polygon, (k + 1) % size);
    corners.insert(a);
    border.insert(is_turned ? std::pair(b, a) : std::pair(a, b));
  }
  if (static_cast<Index>(corners.size()) != size) return false;
  Vector3 side = Vector3::Zero();
  for (const Index f : own) side += faces.triangle(f, close).area();
  const CellRegion region{[&](Index c) {
                            const CellCorners has = pool.places(c);
                            return pool.may_be_of(c, polygon) && pool.area_of(c).dot(side) > 0 &&
                                   std::all_of(has.begin(), has.end(),
                                               [&](Index v) { return corners.contains(v); });
                          },
                          [&](Index v, Index w) {
                            return border.contains({pool.place_of(v), pool.place_of(w)});
                          },
                          [&](const std::vector<Index>& cells) {
                            return cells.size() == own.size() && edges_are(border, cells, pool);
                          }};
  return pool.take_region(region, faces.place(polygon, 0));
}

bool lies_in(const TriangleInSpace& triangle, Index cell, const CellPool& pool) {
  for (Index k = 0; k < 3; ++k)
    if (!triangle.contains(pool.position(cell, k))) return false;
  return true;
}

// Takes cells that are connected across edges off the sides of the triangle, lie in it, face its
// side and have its area in all. Such cells cover it once. Faces without area are recorded for
// later.
bool take_pieces(const RepairedFaces& faces, Index polygon, double close, CellPool& pool,
                 std::vector<Index>& flat) {
  const std::vector<Index>& own = faces.faces_of[polygon];
  return std::all_of(own.begin(), own.end(), [&](Index f) {
    const TriangleInSpace triangle = faces.triangle(f, close);
    if (triangle.is_flat()) {
      flat.push_back(f);
      return true;
    }
    const double close_area = close * triangle.length();
    const SurfaceMesh& cells = pool.mesh();
    const CellRegion region{
        [&](Index c) {
          return !pool.is_taken(c) && pool.area_of(c).dot(triangle.area()) > 0 &&
                 lies_in(triangle, c, pool);
        },
        [&](Index v, Index w) {
          return triangle.has_on_a_side(cells.input_position(v), cells.input_position(w));
        },
        [&](const std::vector<Index>& region_cells) {
          double area = 0;
          for (const Index c : region_cells) area += pool.area_of(c).norm();
          return std::abs(area - triangle.area().norm()) <= close_area;
        }};
    return pool.take_region(region, faces.place(polygon, faces.corners(f)[0]));
  });
}

// Takes the remaining cells that lie in one of these faces. A face without area needs a cell at
// each corner; how it is covered is not decided. Returns the first face that lacks one; -1 if there
// is none.
Index lacking(const RepairedFaces& faces, const std::vector<Index>& flat, double close,
              CellPool& pool) {
  std::set<Index> covered;
  for (Index c = 0; c < pool.mesh().face_count() && !flat.empty(); ++c) {
    if (pool.is_taken(c)) continue;
    if (!std::any_of(flat.begin(), flat.end(),
                     [&](Index f) { return lies_in(faces.triangle(f, close), c, pool); }))
      continue;
    pool.take({c});
    const CellCorners here = pool.places(c);
    covered.insert(here.begin(), here.end());
  }
  for (const Index f : flat)
    for (const Index corner : faces.corners(f))
      if (!covered.contains(faces.place(faces.polygon_of(f), corner))) return f;
  return -1;
}

std::string lack(const ShownCells& cells, Index polygon, std::size_t faces) {
  const auto count = std::count(cells.face.begin(), cells.face.end(), polygon);
  if (!cells.face.empty() && static_cast<std::size_t>(count) != faces)
    return fmt::format("face {} of the surface has {} cells instead of {}", polygon, count, faces);
  return fmt::format("face {} is mapped by cells that are not its own, or turned over", polygon);
}

// Returns the defect of names and labels, and the place of each vertex of the cells.
NamedVertices name_places(const ShownCells& cells, const RepairedFaces& faces, double close) {
  std::vector<char> is_used(faces.surface.positions.size(), 0);
  for (const Index v : faces.surface.polygons.indices()) is_used[v] = 1;
  NamedVertices names = name_vertices(cells, faces.surface, is_used, close);
  for (Index& name : names.of_cells)
    if (name != NamedVertices::kNew) name = faces.first_at_place[name];
  for (const Index face : cells.face)
    if (names.defect.empty() && (face < 0 || to_size(face) >= faces.surface.polygons.size()))
      names.defect = fmt::format("the surface has no face {}", face);
  return names;
}

SurfaceMatch match_each_face(const ShownCells& cells, const RepairedFaces& faces) {
  const double close = match_distance(cells, faces.surface);
  SurfaceMatch match;
  NamedVertices names = name_places(cells, faces, close);
  match.defect = names.defect;
  if (!match.defect.empty()) return match;
  CellPool pool(cells, std::move(names.of_cells), faces.surface.positions.size());
  const std::vector<char> is_whole = take_polygons(cells, faces, pool);
  match.same += static_cast<Index>(std::count(is_whole.begin(), is_whole.end(), 1));
  std::vector<Index> left;  // polygons without cells of their own so far
  for (std::size_t p = 0; p < is_whole.size(); ++p) {
    const auto polygon = static_cast<Index>(p);
    if (is_whole[p] || !cells.is_mapped(polygon)) continue;
    if (take_faces(faces, polygon, pool) || take_triangulation(faces, polygon, close, pool))
      ++match.same;
    else
      left.push_back(polygon);
  }
  // Pieces come last, since a whole face may lie in a larger one.
  std::vector<Index> flat;  // faces without area
  for (const Index p : left) {
    // Pieces of neighbouring faces must fit where the surface is connected; match_along_edges()
    // decides that.
    if (!cells.face.empty() || !takes_apart(faces.repaired) ||
        !take_pieces(faces, p, close, pool, flat)) {
      match.defect = lack(cells, p, faces.faces_of[p].size());
      return match;
    }
    ++match.changed;
  }
  if (const Index f = lacking(faces, flat, close, pool); f >= 0)
    match.defect = lack(cells, faces.polygon_of(f), 1);
  for (Index c = 0; c < cells.mesh.face_count(); ++c)
    if (!pool.is_taken(c)) {
      match.defect = fmt::format("cell {} belongs to no face", cells.mesh.input_face(c));
      break;
    }
  return match;
}

}  // namespace

std::optional<SurfaceMatch> match_faces(const ShownCells& cells, const PolygonMesh& surface,
                                        Orientation orientation) {
  if (surface.polygons.empty()) return {};
  const RepairedSurface repaired =
      repair(surface, {.orientation = orientation, .numerics = Numerics::AsGiven});
  // Another vertex at the same place is accepted only where repair() opens the surface.
  const bool is_open = takes_apart(repaired);
  RepairedFaces faces{surface, repaired, {}, {}};
  faces.first_at_place.resize(surface.positions.size());
  std::iota(faces.first_at_place.begin(), faces.first_at_place.end(), 0);
  if (is_open) faces.first_at_place = weld(surface, 0);
  faces.faces_of.resize(surface.polygons.size());
  for (Index f = 0; f < repaired.mesh->face_count(); ++f)
    faces.faces_of[faces.polygon_of(f)].push_back(f);
  SurfaceMatch match = match_each_face(cells, faces);
  if (!is_open && !match.defect.empty()) return {};
  return match;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
