#include "majorant/mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

std::vector<Index> used_vertices(const PolygonMesh& mesh) {
  std::vector<char> is_used(mesh.positions.size(), 0);
  for (const Index v : mesh.polygons.indices()) is_used[v] = 1;
  std::vector<Index> used;
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) used.push_back(static_cast<Index>(v));
  return used;
}

// Sorts vertices into cells as wide as the distance, and joins each with those of its own cell and
// of 13 of the 26 neighbouring cells.
void join_near(const PolygonMesh& mesh, const std::vector<Index>& used, double distance,
               const StopCheck& stop, UnionFind& sets) {
  const auto place = [&](Index v) -> const Vector3& { return mesh.positions[v]; };
  using Cell = std::array<double, 3>;
  struct Entry {
    Cell cell;
    Index vertex;
    bool operator<(const Entry& e) const {
      return cell != e.cell ? cell < e.cell : vertex < e.vertex;
    }
  };
  std::vector<Entry> entries;
  for (const Index v : used) {
    const Vector3 c = (place(v) / distance).array().floor();
    entries.push_back({{c.x(), c.y(), c.z()}, v});
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    stop.poll_at(k);
    for (int dx = 0; dx <= 1; ++dx)
      for (int dy = dx == 0 ? 0 : -1; dy <= 1; ++dy) {
        // The cells with dz = -1, 0, 1 follow each other in the list; pairs before k are already
        // joined.
        Cell low = entries[k].cell, high;
        low[0] += dx;
        low[1] += dy;
        high = low;
        low[2] -= 1;
        high[2] += 1;
        auto e = std::lower_bound(entries.begin() + static_cast<std::ptrdiff_t>(k), entries.end(),
                                  Entry{low, -1});
        for (; e != entries.end() && e->cell <= high; ++e)
          if ((place(e->vertex) - place(entries[k].vertex)).norm() <= distance)
            sets.join(e->vertex, entries[k].vertex);
      }
  }
}

void join_equal(const PolygonMesh& mesh, std::vector<Index> order, UnionFind& sets) {
  const auto less = [&](Index a, Index b) {
    const Vector3 &p = mesh.positions[a], &q = mesh.positions[b];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (mesh.positions[order[k]] == mesh.positions[order[k - 1]]) sets.join(order[k], order[k - 1]);
}

// Returns the length of the shortest edge of every polygon that has an edge of positive length.
std::vector<double> shortest_edges(const PolygonMesh& mesh) {
  std::vector<double> shortest;
  for (const auto polygon : mesh.polygons) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector3 &a = mesh.positions[polygon[k]],
                    &b = mesh.positions[polygon[(k + 1) % polygon.size()]];
      const double length = (b - a).stableNorm();
      if (length > 0) least = std::min(least, length);
    }
    if (std::isfinite(least)) shortest.push_back(least);
  }
  return shortest;
}

// Separates the corners of each polygon. In a set with two corners of one polygon, every vertex
// goes to the first part of the set with which it shares no polygon. Each part is named by its
// first vertex.
void part_corners(const PolygonMesh& mesh, std::vector<Index>& welded) {
  std::vector<std::pair<Index, Index>> apart;  // corners of a polygon in one set, both ways
  for (const auto polygon : mesh.polygons) {
    std::vector<std::pair<Index, Index>> corners;  // set, vertex
    for (const Index v : polygon) corners.emplace_back(welded[v], v);
    std::sort(corners.begin(), corners.end());
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = a + 1; b < corners.size() && corners[b].first == corners[a].first; ++b) {
        if (corners[a].second == corners[b].second) continue;
        apart.emplace_back(corners[a].second, corners[b].second);
        apart.emplace_back(corners[b].second, corners[a].second);
      }
  }
  if (apart.empty()) return;
  std::sort(apart.begin(), apart.end());
  std::vector<char> is_torn(welded.size(), 0);  // by the name of the set
  for (const auto& [a, unused] : apart) is_torn[welded[a]] = 1;
  std::vector<std::pair<Index, Index>> members;  // set, vertex
  for (std::size_t v = 0; v < welded.size(); ++v)
    if (is_torn[welded[v]]) members.emplace_back(welded[v], static_cast<Index>(v));
  std::sort(members.begin(), members.end());
  std::vector<Index> parts;  // names of the parts of the present set
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (k == 0 || members[k].first != members[k - 1].first) parts.clear();
    const Index v = members[k].second;
    const auto first = std::lower_bound(apart.begin(), apart.end(), std::pair<Index, Index>(v, -1));
    const auto is_free = [&](Index part) {
      for (auto a = first; a != apart.end() && a->first == v; ++a)
        if (a->second < v && welded[a->second] == part) return false;
      return true;
    };
    const auto part = std::find_if(parts.begin(), parts.end(), is_free);
    welded[v] = part != parts.end() ? *part : v;
    if (part == parts.end()) parts.push_back(v);
  }
}

}  // namespace

bool is_soup(const PolygonMesh& mesh) {
  std::vector<Index> polygon_of(mesh.positions.size(), -1);
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
    for (const Index v : mesh.polygons[p]) {
      const auto here = static_cast<Index>(p);
      if (polygon_of[v] >= 0 && polygon_of[v] != here) return false;
      polygon_of[v] = here;
    }
  return mesh.polygons.size() > 1;
}

std::vector<Index> first_at_place(const PolygonMesh& mesh) {
  UnionFind sets(static_cast<Index>(mesh.positions.size()));
  join_equal(mesh, used_vertices(mesh), sets);
  std::vector<Index> first(mesh.positions.size());
  for (std::size_t v = 0; v < first.size(); ++v) first[v] = sets.find(static_cast<Index>(v));
  return first;
}

std::vector<Index> coincident_vertices(const PolygonMesh& mesh) {
  const std::vector<Index> first = first_at_place(mesh);
  std::vector<Index> vertices;
  for (std::size_t v = 0; v < first.size(); ++v)
    if (first[v] != static_cast<Index>(v)) vertices.push_back(static_cast<Index>(v));
  return vertices;
}

bool has_corners_at_one_place(const PolygonMesh& mesh, Index polygon) {
  const auto& corners = mesh.polygons[polygon];
  const auto at = [&](std::size_t k) -> const Vector3& { return mesh.positions[corners[k]]; };
  if (corners.size() == 3) return at(0) == at(1) || at(1) == at(2) || at(2) == at(0);
  std::vector<std::array<double, 3>> places;
  for (const Index v : corners) {
    const Vector3& p = mesh.positions[v];
    places.push_back({p.x(), p.y(), p.z()});
  }
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) != places.end();
}

double usable_weld_distance(const PolygonMesh& mesh) {
  std::vector<double> shortest = shortest_edges(mesh);
  if (shortest.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = shortest.begin() + static_cast<std::ptrdiff_t>(shortest.size() / 2);
  std::nth_element(shortest.begin(), middle, shortest.end());
  return *middle;
}

std::vector<Index> weld(const PolygonMesh& mesh, double distance, const StopCheck& stop) {
  UnionFind sets(static_cast<Index>(mesh.positions.size()));
  if (distance > 0)
    join_near(mesh, used_vertices(mesh), distance, stop, sets);
  else
    join_equal(mesh, used_vertices(mesh), sets);
  std::vector<Index> welded(mesh.positions.size());
  for (std::size_t v = 0; v < welded.size(); ++v) welded[v] = sets.find(static_cast<Index>(v));
  part_corners(mesh, welded);
  return welded;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
