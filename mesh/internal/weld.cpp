#include "majorant/mesh/internal/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "majorant/mesh/internal/union_find.h"

namespace majorant {
namespace {

std::vector<Index> used_vertices(const PolygonMesh& mesh) {
  std::vector<char> is_used(mesh.positions.size(), 0);
  for (const auto& polygon : mesh.polygons)
    for (const Index v : polygon) is_used[at(v)] = 1;
  std::vector<Index> used;
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) used.push_back(static_cast<Index>(v));
  return used;
}

// By x, so that who is near is near in the list.
void join_near(const PolygonMesh& mesh, std::vector<Index> order, double distance,
               const StopCheck& stop, UnionFind& sets) {
  const auto place = [&](Index v) -> const Vector3& { return mesh.positions[at(v)]; };
  // Cells as wide as the distance; a vertex meets those of its own cell and of the 13 behind it.
  using Cell = std::array<double, 3>;
  struct Entry {
    Cell cell;
    Index vertex;
    bool operator<(const Entry& e) const {
      return cell != e.cell ? cell < e.cell : vertex < e.vertex;
    }
  };
  std::vector<Entry> entries;
  for (const Index v : order) {
    const Vector3 c = (place(v) / distance).array().floor();
    entries.push_back({{c.x(), c.y(), c.z()}, v});
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    stop.poll_at(k);
    for (int dx = 0; dx <= 1; ++dx)
      for (int dy = dx == 0 ? 0 : -1; dy <= 1; ++dy) {
        // The cells with dz = -1, 0, 1 are a run of the list; before k all pairs are met already.
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
    const Vector3 &p = mesh.positions[at(a)], &q = mesh.positions[at(b)];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (mesh.positions[at(order[k])] == mesh.positions[at(order[k - 1])])
      sets.join(order[k], order[k - 1]);
}

}  // namespace

bool is_soup(const PolygonMesh& mesh) {
  std::vector<Index> polygon_of(mesh.positions.size(), -1);
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
    for (const Index v : mesh.polygons[p]) {
      const auto here = static_cast<Index>(p);
      if (polygon_of[at(v)] >= 0 && polygon_of[at(v)] != here) return false;
      polygon_of[at(v)] = here;
    }
  return mesh.polygons.size() > 1;
}

std::vector<Index> weld(const PolygonMesh& mesh, double distance, const StopCheck& stop) {
  UnionFind sets(static_cast<Index>(mesh.positions.size()));
  if (distance > 0)
    join_near(mesh, used_vertices(mesh), distance, stop, sets);
  else
    join_equal(mesh, used_vertices(mesh), sets);
  std::vector<Index> welded(mesh.positions.size());
  for (std::size_t v = 0; v < welded.size(); ++v) welded[v] = sets.find(static_cast<Index>(v));
  return welded;
}

}  // namespace majorant
