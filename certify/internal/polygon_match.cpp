#include "majorant/certify/internal/polygon_match.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace majorant {
namespace {

// Directed edges with the number of passes in excess of their opposites; ascending.
using Chain = std::vector<std::pair<std::pair<Index, Index>, int>>;

class ChainOfEdges {
 public:
  void add(Index from, Index to) {
    if (from != to) times_[std::minmax(from, to)] += from < to ? 1 : -1;
  }
  Chain take() const {
    Chain chain;
    for (const auto& [edge, times] : times_)
      if (times != 0) chain.emplace_back(edge, times);
    return chain;
  }

 private:
  std::map<std::pair<Index, Index>, int> times_;
};

// Identifies a polygon: its places once each, its number of triangles, and its sides. The number
// tells polygons apart that pass a place several times.
using PolygonKey = std::pair<std::vector<Index>, Chain>;

PolygonKey key_of(std::vector<Index> places, Index triangles, const ChainOfEdges& sides) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  places.push_back(triangles);
  return {std::move(places), sides.take()};
}

// Returns the key of a polygon of the surface, turned over where repair() does that; none if its
// faces are not all oriented alike.
std::optional<PolygonKey> key_in_surface(const RepairedFaces& faces, Index polygon) {
  const auto size = static_cast<Index>(faces.surface.polygons[polygon].size());
  const std::vector<Index>& own = faces.faces_of[polygon];
  const auto ascending = static_cast<std::size_t>(
      std::count_if(own.begin(), own.end(), [&](Index f) { return faces.is_ascending(f); }));
  if (ascending != 0 && ascending != own.size()) return {};
  std::vector<Index> around;
  for (Index k = 0; k < size; ++k) around.push_back(faces.place(polygon, k));
  if (ascending == 0) std::reverse(around.begin(), around.end());
  ChainOfEdges sides;
  for (std::size_t k = 0; k < around.size(); ++k)
    sides.add(around[k], around[(k + 1) % around.size()]);
  return key_of(std::move(around), size - 2, sides);
}

// Returns the key of a polygon of the file with these cells; none if one of its vertices is new.
std::optional<PolygonKey> key_in_file(const CellPool& pool, const std::vector<Index>& cells) {
  std::vector<Index> corners;
  ChainOfEdges sides;
  for (const Index c : cells) {
    const CellCorners at = pool.places(c);
    corners.insert(corners.end(), at.begin(), at.end());
    for (Index k = 0; k < 3; ++k) sides.add(at[k], at[next(k)]);
  }
  if (std::find(corners.begin(), corners.end(), NamedVertices::kNew) != corners.end()) return {};
  return key_of(std::move(corners), static_cast<Index>(cells.size()), sides);
}

}  // namespace

std::vector<char> take_polygons(const ShownCells& cells, const RepairedFaces& faces,
                                CellPool& pool) {
  const IndexLists& polygons = faces.surface.polygons;
  std::vector<char> is_whole(polygons.size(), 0);
  if (cells.polygon.empty()) return is_whole;
  std::map<PolygonKey, std::vector<Index>> polygons_with;  // descending
  for (std::size_t p = polygons.size(); p-- > 0;) {
    const auto polygon = static_cast<Index>(p);
    if (polygons[p].size() == 3 || !cells.is_mapped(polygon)) continue;
    if (std::optional<PolygonKey> key = key_in_surface(faces, polygon))
      polygons_with[std::move(*key)].push_back(polygon);
  }
  std::map<Index, std::vector<Index>> cells_of;  // by polygon of the file
  for (Index c = 0; c < cells.mesh.face_count(); ++c)
    cells_of[cells.polygon[cells.mesh.input_face(c)]].push_back(c);
  for (const auto& [ignored, own] : cells_of) {
    if (own.size() < 2) continue;
    const std::optional<PolygonKey> key = key_in_file(pool, own);
    if (!key) continue;
    const auto found = polygons_with.find(*key);
    if (found == polygons_with.end() || found->second.empty()) continue;
    is_whole[to_size(found->second.back())] = 1;
    found->second.pop_back();
    pool.take(own);
  }
  return is_whole;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
