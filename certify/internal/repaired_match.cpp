#include "majorant/certify/internal/repaired_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "majorant/certify/internal/match_tolerance.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/weld.h"

namespace majorant {
namespace {

using Corners = std::array<Index, 3>;  // of a cell or face: vertices, or corners of its polygon

bool takes_apart(const RepairedSurface& repaired) {
  return std::any_of(repaired.repairs.begin(), repaired.repairs.end(), [](const Repair& r) {
    return r.kind != RepairKind::RegularizedFace && r.kind != RepairKind::MovedToOrigin;
  });
}

Corners turned(const Corners& corners, std::size_t by) {
  return {corners[by % 3], corners[(by + 1) % 3], corners[(by + 2) % 3]};
}

// Corners of a polygon run as these do, not against them.
bool is_ascending(const Corners& corners) {
  for (std::size_t by = 0; by < 3; ++by) {
    const Corners c = turned(corners, by);
    if (c[0] < c[1] && c[1] < c[2]) return true;
  }
  return false;
}

Vector3 area_vector(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b - a).cross(c - a) / 2;
}

// A triangle in space: what lies in it, and on which of its sides.
class Triangle {
 public:
  Triangle(std::array<Vector3, 3> corners, double close)
      : corners_(std::move(corners)),
        area_(area_vector(corners_[0], corners_[1], corners_[2])),
        close_(close) {}

  const Vector3& area() const { return area_; }
  double length() const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (corners_[(k + 1) % 3] - corners_[k]).norm();
    return sum;
  }

  // Returns whether it has no area, as far as places tell.
  bool is_flat() const { return 2 * area_.norm() <= close_ * length(); }

  bool contains(const Vector3& p) const {
    if (is_flat()) return is_on_a_side(p);
    const Vector3 normal = area_.stableNormalized();
    if (!(std::abs(normal.dot(p - corners_[0])) <= close_)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 side = (corners_[(k + 1) % 3] - corners_[k]).stableNormalized();
      if (!(normal.cross(side).dot(p - corners_[k]) >= -close_)) return false;
    }
    return true;
  }

  // Returns whether one of its sides has both.
  bool has_on_a_side(const Vector3& p, const Vector3& q) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (is_on(k, p) && is_on(k, q)) return true;
    return false;
  }

 private:
  bool is_on(std::size_t k, const Vector3& p) const {
    const Vector3 side = corners_[(k + 1) % 3] - corners_[k], along = side.stableNormalized();
    const double t = std::clamp((p - corners_[k]).dot(along), 0.0, side.norm());
    return (corners_[k] + t * along - p).norm() <= close_;
  }

  bool is_on_a_side(const Vector3& p) const { return is_on(0, p) || is_on(1, p) || is_on(2, p); }

  std::array<Vector3, 3> corners_;
  Vector3 area_;
  double close_;
};

class FaceMatcher {
 public:
  // place: by vertex of the surface, the vertices that are one.
  FaceMatcher(const SurfaceMesh& cells, const PolygonMesh& surface, const RepairedSurface& repaired,
              std::vector<Index> place, const std::vector<Index>& face_of_cell, double rounding,
              const std::vector<char>& unmapped, const std::vector<Index>& polygon_of_cell)
      : cells_(cells),
        surface_(surface),
        repaired_(repaired),
        face_of_cell_(face_of_cell),
        unmapped_(unmapped),
        polygon_of_cell_(polygon_of_cell),
        close_(match_tolerance(box_of(surface)) + rounding),
        place_(std::move(place)) {}

  SurfaceMatch run() {
    SurfaceMatch match;
    match.defect = name_places();
    if (match.defect.empty()) match.defect = wrong_label();
    if (!match.defect.empty()) return match;
    const auto count = surface_.polygons.size();
    std::vector<std::vector<Index>> faces_of(count);
    for (Index f = 0; f < repaired_.mesh->face_count(); ++f)
      faces_of[repaired_.mesh->input_face(f)].push_back(f);
    collect_cells();
    const std::vector<char> is_whole = take_polygons(faces_of);
    match.same += static_cast<Index>(std::count(is_whole.begin(), is_whole.end(), 1));
    std::vector<Index> left;  // polygons without cells of their own, yet
    for (std::size_t p = 0; p < count; ++p) {
      const auto polygon = static_cast<Index>(p);
      if (is_whole[p] || (!unmapped_.empty() && unmapped_[p])) continue;
      if (take_faces(polygon, faces_of[p]) || take_triangulation(polygon, faces_of[p]))
        ++match.same;
      else
        left.push_back(polygon);
    }
    // Pieces last: a whole face may lie in a larger one.
    std::vector<Index> flat;  // faces without area
    for (const Index p : left) {
      // Pieces of neighbours have to fit where the surface hangs together: match_surface() asks
      // that.
      if (!face_of_cell_.empty() || !takes_apart(repaired_) || !take_pieces(faces_of[p], flat)) {
        match.defect = lack(p, faces_of[p].size());
        return match;
      }
      ++match.changed;
    }
    if (const Index f = lacking(flat); f >= 0)
      match.defect = lack(repaired_.mesh->input_face(f), 1);
    for (Index c = 0; c < cells_.face_count(); ++c)
      if (!is_taken_[c]) {
        match.defect = fmt::format("cell {} belongs to no face", cells_.input_face(c));
        break;
      }
    return match;
  }

 private:
  static constexpr Index kNew = -1;  // place of a vertex that the surface lacks

  // Returns which vertex of the cells the surface lacks or has elsewhere; empty: none.
  std::string name_places() {
    std::vector<char> is_used(place_.size(), 0);
    for (const Index v : surface_.polygons.indices()) is_used[v] = 1;
    for (Index v = 0; v < cells_.vertex_count(); ++v) {
      const Index name = cells_.input_vertex(v);
      const bool is_known = to_size(name) < place_.size() && is_used[name];
      if (!is_known && !face_of_cell_.empty())
        return fmt::format("the surface has no vertex {}", name);
      if (is_known && !((cells_.input_position(v) - surface_.positions[name]).norm() <= close_))
        return fmt::format("vertex {} is not where the surface has it", name);
      place_of_.push_back(is_known ? place_[name] : kNew);
    }
    return {};
  }

  std::string wrong_label() const {
    for (const Index face : face_of_cell_)
      if (face < 0 || to_size(face) >= surface_.polygons.size())
        return fmt::format("the surface has no face {}", face);
    return {};
  }

  void collect_cells() {
    is_taken_.assign(to_size(cells_.face_count()), 0);
    cells_at_.resize(place_.size());
    for (Index c = 0; c < cells_.face_count(); ++c)
      for (Index k = 0; k < 3; ++k) {
        const Index v = cells_.faces()(c, k), w = cells_.faces()(c, next(k));
        if (place_of_[v] != kNew) cells_at_[place_of_[v]].push_back(c);
        cells_left_of_[{cells_.input_vertex(v), cells_.input_vertex(w)}].push_back(c);
      }
  }

  std::string lack(Index p, std::size_t faces) const {
    const auto cells = std::count(face_of_cell_.begin(), face_of_cell_.end(), p);
    if (!face_of_cell_.empty() && static_cast<std::size_t>(cells) != faces)
      return fmt::format("face {} of the surface has {} cells instead of {}", p, cells, faces);
    return fmt::format("face {} is mapped by cells that are not its own, or turned over", p);
  }

  bool may_be_of(Index c, Index polygon) const {
    return !is_taken_[c] && (face_of_cell_.empty() || face_of_cell_[c] == polygon);
  }

  void take(const std::vector<Index>& cells) {
    for (const Index c : cells) is_taken_[c] = 1;
  }

  Corners polygon_corners(Index face) const {
    const auto row = repaired_.polygon_corner.row(face);
    return {row[0], row[1], row[2]};
  }

  Index place(Index polygon, Index corner) const {
    return place_[surface_.polygons[polygon][corner]];
  }

  Corners places(Index cell) const {
    Corners out;
    for (Index k = 0; k < 3; ++k) out[k] = place_of_[cells_.faces()(cell, k)];
    return out;
  }

  // ---- Polygons of the file ----

  // Directed edges, with how often each is passed more often than its opposite; ascending.
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

  // The places around a polygon of the surface, turned where repair() turns it; empty where its
  // faces do not lie one way round.
  std::vector<Index> places_around(Index p, const std::vector<Index>& faces) const {
    std::vector<Index> around;
    for (Index k = 0; k < static_cast<Index>(surface_.polygons[p].size()); ++k)
      around.push_back(place(p, k));
    const auto ascending = std::count_if(faces.begin(), faces.end(),
                                         [&](Index f) { return is_ascending(polygon_corners(f)); });
    if (ascending == 0) std::reverse(around.begin(), around.end());
    return ascending == 0 || to_size(static_cast<Index>(ascending)) == faces.size()
               ? around
               : std::vector<Index>();
  }

  // Takes the polygons of the file that are polygons of the surface, and returns flags of these. A
  // polygon is known by the chain of its sides: n - 2 cells over its corners whose edges add up to
  // it are a triangulation of it.
  std::vector<char> take_polygons(const std::vector<std::vector<Index>>& faces_of) {
    std::vector<char> is_whole(surface_.polygons.size(), 0);
    if (polygon_of_cell_.empty()) return is_whole;
    std::map<std::pair<std::vector<Index>, Chain>, std::vector<Index>> with;  // corners, sides
    for (std::size_t p = surface_.polygons.size(); p-- > 0;) {
      const auto polygon = static_cast<Index>(p);
      if (surface_.polygons[p].size() == 3 || (!unmapped_.empty() && unmapped_[p])) continue;
      std::vector<Index> around = places_around(polygon, faces_of[p]);
      if (around.empty()) continue;
      ChainOfEdges sides;
      for (std::size_t k = 0; k < around.size(); ++k)
        sides.add(around[k], around[(k + 1) % around.size()]);
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
      // The number of cells tells polygons apart that pass a place several times.
      around.push_back(static_cast<Index>(surface_.polygons[p].size()) - 2);
      with[{around, sides.take()}].push_back(polygon);
    }
    std::map<Index, std::vector<Index>> cells_of;  // by polygon of the file
    for (Index c = 0; c < cells_.face_count(); ++c)
      cells_of[polygon_of_cell_[cells_.input_face(c)]].push_back(c);
    for (const auto& [ignored, cells] : cells_of) {
      if (cells.size() < 2) continue;
      std::vector<Index> corners;
      ChainOfEdges sides;
      for (const Index c : cells) {
        const Corners at = places(c);
        corners.insert(corners.end(), at.begin(), at.end());
        for (Index k = 0; k < 3; ++k) sides.add(at[k], at[next(k)]);
      }
      std::sort(corners.begin(), corners.end());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      if (corners.front() == kNew) continue;
      corners.push_back(static_cast<Index>(cells.size()));
      const auto found = with.find({corners, sides.take()});
      if (found == with.end() || found->second.empty()) continue;
      is_whole[to_size(found->second.back())] = 1;
      found->second.pop_back();
      take(cells);
    }
    return is_whole;
  }

  // ---- Whole faces ----

  // Every face that repair() makes of the polygon is a cell.
  bool take_faces(Index p, const std::vector<Index>& faces) {
    std::vector<Index> found;
    for (const Index f : faces) {
      Corners wanted = polygon_corners(f);
      for (Index& corner : wanted) corner = place(p, corner);
      const std::vector<Index>& candidates = cells_at_[wanted[0]];
      const auto it = std::find_if(candidates.begin(), candidates.end(), [&](Index c) {
        const Corners has = places(c);
        return may_be_of(c, p) && std::find(found.begin(), found.end(), c) == found.end() &&
               (has == wanted || turned(has, 1) == wanted || turned(has, 2) == wanted);
      });
      if (it == candidates.end()) return false;
      found.push_back(*it);
    }
    take(found);
    return true;
  }

  // Accepts a triangulation of a polygon whose corners are at different places: n - 2 triangles
  // whose edges are those of the polygon, once each, and pairs that cancel are a disk; none faces
  // the other way.
  bool take_triangulation(Index p, const std::vector<Index>& faces) {
    const auto size = static_cast<Index>(surface_.polygons[p].size());
    if (size == 3) return false;
    const bool is_turned = !is_ascending(polygon_corners(faces.front()));
    for (const Index f : faces)
      if (is_ascending(polygon_corners(f)) == is_turned) return false;
    std::set<Index> corners;
    std::set<std::pair<Index, Index>> border;
    for (Index k = 0; k < size; ++k) {
      const Index a = place(p, k), b = place(p, (k + 1) % size);
      corners.insert(a);
      border.insert(is_turned ? std::pair(b, a) : std::pair(a, b));
    }
    if (static_cast<Index>(corners.size()) != size) return false;
    Vector3 side = Vector3::Zero();
    for (const Index f : faces) side += face_triangle(f).area();
    const Region region{[&](Index c) {
                          const Corners has = places(c);
                          return may_be_of(c, p) && area_of(c).dot(side) > 0 &&
                                 std::all_of(has.begin(), has.end(),
                                             [&](Index v) { return corners.contains(v); });
                        },
                        [&](Index v, Index w) {
                          return border.contains({place_of_[v], place_of_[w]});
                        },
                        [&](const std::vector<Index>& cells) {
                          return cells.size() == faces.size() && edges_are(border, cells);
                        }};
    return take_region(region, place(p, 0));
  }

  // Once each, but for pairs that cancel.
  bool edges_are(const std::set<std::pair<Index, Index>>& border,
                 const std::vector<Index>& cells) const {
    std::set<std::pair<Index, Index>> edges;
    for (const Index c : cells) {
      const Corners corners = places(c);
      for (Index k = 0; k < 3; ++k)
        if (!edges.emplace(corners[k], corners[next(k)]).second) return false;
    }
    std::erase_if(edges, [edges](const auto& e) { return edges.contains({e.second, e.first}); });
    return edges == border;
  }

  // ---- Pieces ----

  // Cells that hang together across edges that are not on the sides of the triangle, lie in it, all
  // face its side and have its area: they cover it once. Notes faces without area, which are not
  // looked at.
  bool take_pieces(const std::vector<Index>& faces, std::vector<Index>& flat) {
    return std::all_of(faces.begin(), faces.end(), [&](Index f) {
      const Triangle triangle = face_triangle(f);
      if (triangle.is_flat()) {
        flat.push_back(f);
        return true;
      }
      const double close_area = close_ * triangle.length();
      const Region region{[&](Index c) {
                            if (is_taken_[c] || !(area_of(c).dot(triangle.area()) > 0))
                              return false;
                            for (Index k = 0; k < 3; ++k)
                              if (!triangle.contains(cells_.input_position(cells_.faces()(c, k))))
                                return false;
                            return true;
                          },
                          [&](Index v, Index w) {
                            return triangle.has_on_a_side(cells_.input_position(v),
                                                          cells_.input_position(w));
                          },
                          [&](const std::vector<Index>& cells) {
                            double area = 0;
                            for (const Index c : cells) area += area_of(c).norm();
                            return std::abs(area - triangle.area().norm()) <= close_area;
                          }};
      return take_region(region, place(repaired_.mesh->input_face(f), polygon_corners(f)[0]));
    });
  }

  // Takes the cells that are left and lie in one of these faces. What covers a face without area is
  // not decided: it has cells at its corners. The first that has none at one; -1.
  Index lacking(const std::vector<Index>& flat) {
    std::set<Index> covered;
    for (Index c = 0; c < cells_.face_count() && !flat.empty(); ++c) {
      if (is_taken_[c]) continue;
      is_taken_[c] = std::any_of(flat.begin(), flat.end(), [&](Index f) {
        const Triangle triangle = face_triangle(f);
        for (Index k = 0; k < 3; ++k)
          if (!triangle.contains(cells_.input_position(cells_.faces()(c, k)))) return false;
        return true;
      });
      const Corners here = places(c);
      if (is_taken_[c]) covered.insert(here.begin(), here.end());
    }
    for (const Index f : flat)
      for (const Index corner : polygon_corners(f))
        if (!covered.contains(place(repaired_.mesh->input_face(f), corner))) return f;
    return -1;
  }

  Triangle face_triangle(Index f) const {
    const auto& polygon = surface_.polygons[repaired_.mesh->input_face(f)];
    const Corners corners = polygon_corners(f);
    const auto corner = [&](std::size_t k) { return surface_.positions[polygon[corners[k]]]; };
    return {{corner(0), corner(1), corner(2)}, close_};
  }

  Vector3 area_of(Index c) const {
    const auto corner = [&](Index k) { return cells_.input_position(cells_.faces()(c, k)); };
    return area_vector(corner(0), corner(1), corner(2));
  }

  // ---- Cells that hang together ----

  struct Region {
    std::function<bool(Index cell)> has;
    std::function<bool(Index v, Index w)> is_border;  // vertices of the cells
    std::function<bool(const std::vector<Index>&)> is_covered;
  };

  bool take_region(const Region& region, Index corner) {
    for (const Index seed : cells_at_[corner]) {
      const std::vector<Index> cells = region_of(region, seed);
      if (cells.empty() || !region.is_covered(cells)) continue;
      take(cells);
      return true;
    }
    return false;
  }

  // Goes from the cell across all edges that are no border; empty if one of these has no other
  // side.
  std::vector<Index> region_of(const Region& region, Index seed) const {
    if (!region.has(seed)) return {};
    std::vector<Index> cells{seed};
    std::set<Index> known{seed};
    for (std::size_t k = 0; k < cells.size(); ++k)
      for (Index corner = 0; corner < 3; ++corner) {
        const Index v = cells_.faces()(cells[k], corner),
                    w = cells_.faces()(cells[k], next(corner));
        if (region.is_border(v, w)) continue;
        const Index beyond = across(region, 3 * cells[k] + corner, known);
        if (beyond < 0) return {};
        if (known.insert(beyond).second) cells.push_back(beyond);
      }
    return cells;
  }

  // Returns the cell across a half-edge, also of an edge inside of a face that was opened because
  // the same pieces are there twice; -1: none of the region.
  Index across(const Region& region, Index h, const std::set<Index>& known) const {
    if (const Index o = cells_.opposite(h); o >= 0) {
      const bool is_in = known.contains(face_of(o)) || region.has(face_of(o));
      return is_in ? face_of(o) : -1;
    }
    const auto found = cells_left_of_.find(
        {cells_.input_vertex(cells_.to_vertex(h)), cells_.input_vertex(cells_.from_vertex(h))});
    if (found == cells_left_of_.end()) return -1;
    const auto it = std::find_if(found->second.begin(), found->second.end(),
                                 [&](Index c) { return known.contains(c) || region.has(c); });
    return it == found->second.end() ? -1 : *it;
  }

  const SurfaceMesh& cells_;
  const PolygonMesh& surface_;
  const RepairedSurface& repaired_;
  const std::vector<Index>& face_of_cell_;
  const std::vector<char>& unmapped_;  // polygons without cells
  const std::vector<Index>& polygon_of_cell_;
  double close_;
  std::vector<Index> place_;     // by vertex of the surface: the one that stands for it
  std::vector<Index> place_of_;  // by vertex of the cells: the same, or kNew
  std::vector<std::vector<Index>> cells_at_;                             // by place
  std::map<std::pair<Index, Index>, std::vector<Index>> cells_left_of_;  // by vertices of the file
  std::vector<char> is_taken_;                                           // by cell
};

}  // namespace

std::optional<SurfaceMatch> match_repaired(const SurfaceMesh& cells, const PolygonMesh& surface,
                                           const std::vector<Index>& face_of_cell,
                                           Orientation orientation, double rounding,
                                           const std::vector<char>& unmapped,
                                           const std::vector<Index>& polygon_of_cell) {
  if (surface.polygons.empty()) return {};
  const RepairedSurface repaired =
      repair(surface, {.orientation = orientation, .numerics = Numerics::AsGiven});
  // Only where repair() opens the surface may another vertex at the same place stand for one.
  const bool is_open = takes_apart(repaired);
  std::vector<Index> place(surface.positions.size());
  std::iota(place.begin(), place.end(), 0);
  if (is_open) place = weld(surface, 0);
  SurfaceMatch match = FaceMatcher(cells, surface, repaired, std::move(place), face_of_cell,
                                   rounding, unmapped, polygon_of_cell)
                           .run();
  if (!is_open && !match.defect.empty()) return {};
  return match;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
