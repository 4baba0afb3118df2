#include "majorant/certify/internal/surface_match.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "majorant/certify/internal/match_tolerance.h"
#include "majorant/framework/pair_order.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/triangle_list.h"
#include "majorant/mesh/triangulate_polygon.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

// A side of a polygon of the surface, which is on its left.
struct Side {
  Index from, to;  // vertices of the surface
  Index face;
};

struct Mismatch {
  std::string line;
};

template <class... Args>
[[noreturn]] void refuse_match(fmt::format_string<Args...> format, Args&&... args) {
  throw Mismatch{fmt::format(format, std::forward<Args>(args)...)};
}

struct Patch {
  std::span<const Index> faces;  // polygons of the surface
  std::span<const Index> cells;
};

// 0 to count - 1 in groups, ascending; group(k): the one that k is in, below `count_of_groups`.
class Groups {
 public:
  template <class Group>
  Groups(Index count_of_groups, Index count, const Group& group)
      : begin_(to_size(count_of_groups) + 1, 0), members_(to_size(count)) {
    for (Index k = 0; k < count; ++k) ++begin_[group(k)];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    for (Index k = count - 1; k >= 0; --k) members_[--begin_[group(k)]] = k;
  }

  std::span<const Index> operator[](Index group) const {
    return {members_.data() + begin_[group], members_.data() + begin_[group + 1]};
  }

 private:
  std::vector<Index> begin_, members_;
};

class Matcher {
 public:
  Matcher(const SurfaceMesh& cells, const PolygonMesh& surface,
          const std::vector<Index>& face_of_cell, double rounding,
          const std::vector<char>& unmapped)
      : cells_(cells),
        surface_(surface),
        face_of_cell_(face_of_cell),
        rounding_(rounding),
        unmapped_(unmapped),
        sides_(sides_of(surface, unmapped)),
        face_left_(to_size(cells.half_edge_count()), kUnknown) {}

  SurfaceMatch run() {
    find_size();
    check_vertices();
    number_vertices();
    const PairOrder order(static_cast<Index>(surface_.positions.size()),
                          static_cast<Index>(sides_.size()),
                          [&](Index k) { return std::pair(sides_[k].from, sides_[k].to); });
    require_one_direction(order);
    cell_edges_.emplace(cells_.vertex_count(), cells_.half_edge_count(), [&](Index h) {
      return std::pair(cells_.from_vertex(h), cells_.to_vertex(h));
    });
    UnionFind faces(static_cast<Index>(surface_.polygons.size()));
    for (const Index side : sides_to_follow(order)) follow(sides_[side], order, faces);
    compare_patches(faces);
    return match_;
  }

 private:
  static constexpr Index kUnknown = -2, kOutside = -1;  // of face_left_
  static constexpr Index kPiece = 4096;                 // vertices a task: some 0.3 ms

  static std::vector<Side> sides_of(const PolygonMesh& surface, const std::vector<char>& unmapped) {
    std::vector<Side> sides;
    sides.reserve(surface.polygons.indices().size());
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
      if (!unmapped.empty() && unmapped[p]) continue;
      const auto& polygon = surface.polygons[p];
      for (std::size_t k = 0; k < polygon.size(); ++k)
        sides.push_back(
            {polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0], static_cast<Index>(p)});
    }
    return sides;
  }

  const Vector3& place(Index v) const { return surface_.positions[v]; }
  Vector3 cell_place(Index vertex) const { return cells_.positions().row(vertex); }
  // The surface's number of a vertex of the cells, -1 for a new one.
  Index surface_vertex(Index vertex) const {
    const Index v = cells_.input_vertex(vertex);
    return to_size(v) < used_.size() && used_[v] ? v : -1;
  }

  void find_size() {
    used_.assign(surface_.positions.size(), 0);
    for (const Side& side : sides_) used_[side.from] = 1;
    const Eigen::AlignedBox3d box = box_of(surface_);
    size_ = box.sizes().maxCoeff();
    close_ = match_tolerance(box) + rounding_;
  }

  void check_vertices() const {
    for (Index v = 0; v < cells_.vertex_count(); ++v) {
      const Index known = surface_vertex(v);
      if (known >= 0 && !((cell_place(v) - place(known)).norm() <= close_))
        refuse_match("vertex {} is not where the surface has it", known);
      if (known < 0 && !face_of_cell_.empty())
        refuse_match("the surface has no vertex {}", cells_.input_vertex(v));
    }
  }

  void number_vertices() {
    cell_vertex_.assign(surface_.positions.size(), -1);
    for (Index v = cells_.vertex_count() - 1; v >= 0; --v)
      if (const auto known = to_size(cells_.input_vertex(v)); known < cell_vertex_.size())
        cell_vertex_[known] = v;
  }

  void require_one_direction(const PairOrder& order) const {
    auto second = static_cast<Index>(sides_.size());  // the first that runs as one before it
    order.for_each_run([&](std::span<const PairOrder::Entry> run) {
      if (run.size() > 1) second = std::min(second, run[1].number);
    });
    if (to_size(second) < sides_.size())
      refuse_match("two faces of the surface have edge ({}, {}) in the same direction",
                   sides_[second].from, sides_[second].to);
  }

  // The half-edge of the cells; -1 if there is none.
  Index half_edge(Index from, Index to) const { return cell_edges_->find(from, to); }
  bool has_edge(Index a, Index b) const { return half_edge(a, b) >= 0 || half_edge(b, a) >= 0; }

  // The face on the other side of an edge of the surface.
  Index across(const Side& side, const PairOrder& order) const {
    const Index other = order.find(side.to, side.from);
    return other < 0 ? kOutside : sides_[other].face;
  }

  // Returns the sides that are no edge of the cells as they are, in order. For the others it notes
  // which faces lie on both sides: no two have a half-edge in common, nor one with those that
  // follow() goes along.
  std::vector<Index> sides_to_follow(const PairOrder& order) {
    std::vector<char> is_left(sides_.size(), 0);
    parallel_for(static_cast<Index>(surface_.positions.size()), kPiece, [&](Index v) {
      const Index a = cell_vertex_[v];
      for (const auto& [to, side] : order.of(v)) {
        const Index b = cell_vertex_[to], other = across(sides_[side], order);
        if (other != kOutside && to < v) continue;  // once for both sides
        const Index h = a < 0 || b < 0 ? -1 : half_edge(a, b);
        const Index o = h < 0 ? -1 : half_edge(b, a);
        is_left[side] = h < 0 || (o < 0) != (other == kOutside);
        if (is_left[side]) continue;
        face_left_[h] = sides_[side].face;
        if (o >= 0) face_left_[o] = other;
      }
    });
    std::vector<Index> left;
    order.for_each_run([&](std::span<const PairOrder::Entry> run) {
      if (is_left[run[0].number]) left.push_back(run[0].number);
    });
    return left;
  }

  // Returns the vertices of the cells to which edges of the cells lead from `vertex`.
  const std::vector<Index>& neighbours(Index vertex) {
    if (neighbours_.empty()) {
      neighbours_.resize(to_size(cells_.vertex_count()));
      cell_edges_->for_each_run([&](std::span<const PairOrder::Entry> run) {
        const Index from = cells_.from_vertex(run[0].number), to = run[0].second;
        neighbours_[from].push_back(to);
        if (half_edge(to, from) < 0) neighbours_[to].push_back(from);
      });
    }
    return neighbours_[vertex];
  }

  // The vertices of the cells along the straight edge of the surface; empty if the cells lack it.
  // Depth first, every new vertex once: several may be on the edge, since the other side of a slit
  // lies in the same place and ends elsewhere.
  std::vector<Index> chain(const Side& edge) {
    const Index a = cell_vertex_[edge.from], b = cell_vertex_[edge.to];
    if (a < 0 || b < 0) return {};
    if (has_edge(a, b)) return {a, b};
    std::map<Index, Index> before{{a, -1}};  // the vertex that each one was reached from
    std::vector<std::pair<Index, double>> open{{a, 0.0}};
    while (!open.empty()) {
      const auto [from, travelled] = open.back();
      open.pop_back();
      if (from != a && has_edge(from, b)) {
        std::vector<Index> out{b};
        for (Index v = from; v >= 0; v = before.at(v)) out.push_back(v);
        std::reverse(out.begin(), out.end());
        return out;
      }
      for (const Index v : neighbours(from)) {
        const std::optional<double> t = place_along(edge, v);
        if (t && *t > travelled && before.emplace(v, from).second) open.emplace_back(v, *t);
      }
    }
    return {};
  }

  // Returns where a new vertex lies on an edge of the surface, between 0 and 1, if it does.
  std::optional<double> place_along(const Side& edge, Index vertex) const {
    if (surface_vertex(vertex) >= 0) return {};
    const Vector3 start = place(edge.from), step = place(edge.to) - start;
    const Vector3 offset = cell_place(vertex) - start;
    const double t = offset.dot(step) / step.squaredNorm();
    const bool is_on = t > 0 && t < 1 && (offset - t * step).norm() <= close_;
    return is_on ? std::optional(t) : std::nullopt;
  }

  // Notes on which side of the cells' edges the face lies, or joins it with its neighbour where the
  // cells do not have the edge.
  void follow(const Side& edge, const PairOrder& order, UnionFind& faces) {
    const Index other = across(edge, order);
    const std::vector<Index> vertices = chain(edge);
    if (vertices.empty()) {
      if (other == kOutside)
        refuse_match("the cells lack the boundary edge ({}, {}) of the surface", edge.from,
                     edge.to);
      faces.join(edge.face, other);
      return;
    }
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      put(half_edge(vertices[k], vertices[k + 1]), edge.face, edge);
      put(half_edge(vertices[k + 1], vertices[k]), other, edge);
    }
  }

  void put(Index h, Index face, const Side& edge) {
    if (face == kOutside && h >= 0)
      refuse_match("cells lie beyond the boundary edge ({}, {}) of the surface, or are turned over",
                   edge.from, edge.to);
    if (face != kOutside && h < 0)
      refuse_match("face {}: no cell lies at its edge ({}, {}), or it is turned over", face,
                   edge.from, edge.to);
    if (h >= 0) face_left_[h] = face;
  }

  void compare_patches(UnionFind& faces) {
    UnionFind cells(cells_.face_count());
    for (Index h = 0; h < cells_.half_edge_count(); ++h) {
      if (face_left_[h] != kUnknown) continue;
      if (cells_.opposite(h) < 0)
        refuse_match("the cells end at edge ({}, {}), inside the surface",
                     cells_.input_vertex(cells_.from_vertex(h)),
                     cells_.input_vertex(cells_.to_vertex(h)));
      cells.join(face_of(h), face_of(cells_.opposite(h)));
    }
    constexpr Index kNone = -1;
    std::vector<Index> cells_of(surface_.polygons.size(), kNone);
    std::vector<Index> faces_of(to_size(cells_.face_count()), kNone);
    for (Index h = 0; h < cells_.half_edge_count(); ++h) {
      if (face_left_[h] < 0) continue;
      const Index mine = cells.find(face_of(h)), theirs = faces.find(face_left_[h]);
      if (faces_of[mine] == kNone && cells_of[theirs] == kNone) {
        faces_of[mine] = theirs;
        cells_of[theirs] = mine;
      }
      if (faces_of[mine] != theirs || cells_of[theirs] != mine)
        refuse_match("face {} is mapped by cells that are not its own", face_left_[h]);
    }
    const auto count = static_cast<Index>(surface_.polygons.size());
    for (Index p = 0; p < count; ++p)
      if (is_mapped(p) && cells_of[faces.find(p)] == kNone)
        refuse_match("face {} is mapped by no cell", p);
    for (Index c = 0; c < cells_.face_count(); ++c)
      if (faces_of[cells.find(c)] == kNone)
        refuse_match("cell {} belongs to no face", cells_.input_face(c));
    // Patches are named by the smallest of their faces.
    const Groups of_faces(count, count, [&](Index p) { return faces.find(p); });
    const Groups of_cells(count, cells_.face_count(),
                          [&](Index c) { return faces_of[cells.find(c)]; });
    for (Index p = 0; p < count; ++p)
      if (is_mapped(p) && !of_faces[p].empty()) compare({of_faces[p], of_cells[p]});
  }

  bool is_mapped(Index p) const { return unmapped_.empty() || !unmapped_[p]; }

  void compare(const Patch& patch) {
    for (const Index c : patch.cells) {
      if (face_of_cell_.empty()) break;
      if (std::find(patch.faces.begin(), patch.faces.end(), face_of_cell_[c]) == patch.faces.end())
        refuse_match("cell {} is said to belong to face {} of the surface and lies in face {}",
                     cells_.input_face(c), face_of_cell_[c], patch.faces.front());
    }
    if (is_triangulated_polygon(patch)) {
      if (!is_unfolded(patch))
        refuse_match("a cell is turned over in face {} of the surface", patch.faces.front());
      ++match_.same;
      return;
    }
    match_.changed += static_cast<Index>(patch.faces.size());
    require_same_plane(patch);
  }

  static double size_of(const std::vector<std::vector<Vector3>>& faces) {
    Eigen::AlignedBox3d box;
    for (const auto& corners : faces)
      for (const Vector3& p : corners) box.extend(p);
    return box.sizes().maxCoeff();
  }

  // Returns whether no cell is turned over in the polygon: cells are those that SurfaceMesh makes
  // of it, of its shape or of its texture coordinates, or all of them face its side.
  bool is_unfolded(const Patch& patch) const {
    const auto& polygon = surface_.polygons[patch.faces.front()];
    if (polygon.size() == 3) return true;
    std::vector<Vector3> corners;
    for (const Index v : polygon) corners.push_back(place(v));
    const Vector3 side = area_vector(corners).stableNormalized();
    std::set<std::set<Index>> usual;
    for (const auto& triangles :
         {triangulate_polygon(corners),
          triangles_of(surface_, patch.faces.front(), Crossing::Fanned, {})})
      for (const auto& t : triangles) usual.insert({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
    return std::all_of(patch.cells.begin(), patch.cells.end(), [&](Index c) {
      const auto vertex = [&](Index k) { return cells_.faces()(c, k); };
      const auto name = [&](Index k) { return surface_vertex(vertex(k)); };
      return usual.contains({name(0), name(1), name(2)}) ||
             area_vector({cell_place(vertex(0)), cell_place(vertex(1)), cell_place(vertex(2))})
                     .dot(side) > 0;
    });
  }

  bool is_triangulated_polygon(const Patch& patch) const {
    if (patch.faces.size() != 1) return false;
    const auto& polygon = surface_.polygons[patch.faces.front()];
    if (patch.cells.size() + 2 != polygon.size()) return false;
    for (const Index c : patch.cells)
      for (Index k = 0; k < 3; ++k) {
        const Index v = surface_vertex(cells_.faces()(c, k));
        if (std::find(polygon.begin(), polygon.end(), v) == polygon.end()) return false;
      }
    return true;
  }

  static Vector3 area_vector(const std::vector<Vector3>& corners) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      sum += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]) / 2;
    return sum;
  }

  void require_same_plane(const Patch& patch) const {
    const Index face = patch.faces.front();
    std::vector<std::vector<Vector3>> of_faces, of_cells;
    for (const Index p : patch.faces) {
      auto& corners = of_faces.emplace_back();
      for (const Index v : surface_.polygons[p]) corners.push_back(place(v));
    }
    for (const Index c : patch.cells) {
      auto& corners = of_cells.emplace_back();
      for (Index k = 0; k < 3; ++k) corners.push_back(cell_place(cells_.faces()(c, k)));
    }
    Vector3 total = Vector3::Zero();
    for (const auto& corners : of_faces) total += area_vector(corners);
    if (!(total.stableNorm() > close_ * close_))
      refuse_match("cells have other edges than the surface around face {}, where it is not flat",
                   face);
    const Vector3 normal = total.stableNormalized(), origin = of_faces.front().front();
    double areas[2] = {0, 0};
    for (const auto* list : {&of_faces, &of_cells})
      for (const auto& corners : *list) {
        for (const Vector3& p : corners)
          if (!(std::abs(normal.dot(p - origin)) <= close_))
            refuse_match("cells leave the plane of face {} of the surface", face);
        const double area = area_vector(corners).dot(normal);
        if (!(area >= -close_ * close_))
          refuse_match("a cell is turned over around face {} of the surface, or that is not flat",
                       face);
        areas[list == &of_cells] += area;
      }
    if (!(std::abs(areas[0] - areas[1]) <= kTenDigits * areas[0] + close_ * size_of(of_faces)))
      refuse_match("cells cover {:.9g} of the area {:.9g} around face {} of the surface", areas[1],
                   areas[0], face);
  }

  const SurfaceMesh& cells_;
  const PolygonMesh& surface_;
  const std::vector<Index>& face_of_cell_;
  double rounding_;                             // of the cells
  const std::vector<char>& unmapped_;           // faces of the surface without cells
  double size_ = 0, close_ = 0;                 // of the surface; what counts as the same place
  std::vector<char> used_;                      // vertices of the surface with a face
  std::vector<Side> sides_;                     // of the surface, polygon by polygon
  std::vector<Index> cell_vertex_;              // of the cells, by vertex of the surface, or -1
  std::optional<PairOrder> cell_edges_;         // half-edges of the cells by their ends
  std::vector<std::vector<Index>> neighbours_;  // of the cells' vertices
  std::vector<Index> face_left_;  // by half-edge of the cells: the face whose edge it lies on
  SurfaceMatch match_;
};

// Returns the surface as SurfaceMesh takes it.
PolygonMesh triangulated(const PolygonMesh& surface, const std::vector<char>& unmapped) {
  PolygonMesh out;
  out.positions = surface.positions;
  const TriangleList list = triangulate(surface, Crossing::Fanned, {});
  for (std::size_t f = 0; f < list.triangles.size(); ++f)
    if (unmapped.empty() || !unmapped[list.polygon[f]]) out.polygons.push_back(list.triangles[f]);
  return out;
}

}  // namespace

SurfaceMatch match_surface(const SurfaceMesh& cells, const PolygonMesh& surface,
                           const std::vector<Index>& face_of_cell, double rounding,
                           const std::vector<char>& unmapped) {
  try {
    return Matcher(cells, surface, face_of_cell, rounding, unmapped).run();
  } catch (const Mismatch& mismatch) {
    const bool has_polygons = std::any_of(surface.polygons.begin(), surface.polygons.end(),
                                          [](const auto& p) { return p.size() > 3; });
    if (!has_polygons || !face_of_cell.empty()) return {mismatch.line};
    // Pieces of the triangles of a polygon that is not flat.
    const SurfaceMatch triangles =
        match_surface(cells, triangulated(surface, unmapped), {}, rounding);
    return triangles.defect.empty() ? triangles : SurfaceMatch{mismatch.line};
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
