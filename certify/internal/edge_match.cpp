#include "majorant/certify/internal/edge_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "majorant/certify/internal/patch_match.h"
#include "majorant/framework/pair_order.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/triangle_list.h"
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

// A partition of 0 to count - 1 into groups, each ascending; group(k) is the number of k's group,
// below `count_of_groups`.
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

class EdgeMatcher {
 public:
  EdgeMatcher(const ShownCells& cells, const PolygonMesh& surface)
      : shown_(cells),
        cells_(cells.mesh),
        surface_(surface),
        sides_(sides_of(cells, surface)),
        close_(match_distance(cells, surface)),
        face_left_(to_size(cells.mesh.half_edge_count()), kUnknown) {}

  SurfaceMatch run() {
    name_cell_vertices();
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
  static constexpr Index kUnknown = -2, kOutside = -1;  // values of face_left_
  static constexpr Index kPiece = 4096;                 // vertices of a task, about 0.3 ms

  static std::vector<Side> sides_of(const ShownCells& cells, const PolygonMesh& surface) {
    std::vector<Side> sides;
    sides.reserve(surface.polygons.indices().size());
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
      if (!cells.is_mapped(static_cast<Index>(p))) continue;
      const auto& polygon = surface.polygons[p];
      for (std::size_t k = 0; k < polygon.size(); ++k)
        sides.push_back(
            {polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0], static_cast<Index>(p)});
    }
    return sides;
  }

  const Vector3& place(Index v) const { return surface_.positions[v]; }
  Vector3 cell_place(Index vertex) const { return cells_.input_position(vertex); }
  // Returns the surface's number of a vertex of the cells, or kNew.
  Index surface_vertex(Index vertex) const { return names_.of_cells[vertex]; }

  void name_cell_vertices() {
    std::vector<char> is_used(surface_.positions.size(), 0);
    for (const Side& side : sides_) is_used[side.from] = 1;
    names_ = name_vertices(shown_, surface_, is_used, close_);
    if (!names_.defect.empty()) throw Mismatch{names_.defect};
  }

  void number_vertices() {
    cell_vertex_.assign(surface_.positions.size(), -1);
    for (Index v = cells_.vertex_count() - 1; v >= 0; --v)
      if (const auto known = to_size(cells_.input_vertex(v)); known < cell_vertex_.size())
        cell_vertex_[known] = v;
  }

  void require_one_direction(const PairOrder& order) const {
    auto second = static_cast<Index>(sides_.size());  // the first side with the same direction as
                                                      // an earlier one
    order.for_each_run([&](std::span<const PairOrder::Entry> run) {
      if (run.size() > 1) second = std::min(second, run[1].number);
    });
    if (to_size(second) < sides_.size())
      refuse_match("two faces of the surface have edge ({}, {}) in the same direction",
                   sides_[second].from, sides_[second].to);
  }

  // Returns the half-edge of the cells; -1 if there is none.
  Index half_edge(Index from, Index to) const { return cell_edges_->find(from, to); }
  bool has_edge(Index a, Index b) const { return half_edge(a, b) >= 0 || half_edge(b, a) >= 0; }

  // Returns the face on the other side of an edge of the surface.
  Index across(const Side& side, const PairOrder& order) const {
    const Index other = order.find(side.to, side.from);
    return other < 0 ? kOutside : sides_[other].face;
  }

  // Returns the sides that are not single edges of the cells, in order. For other sides it records
  // the faces on both sides. No two faces have a half-edge in common, neither with each other nor
  // with the edges that follow() uses.
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

  // Returns the vertices of the cells along the straight edge of the surface; empty if the cells
  // lack it. The search is depth first and visits every new vertex once. Several vertices may
  // continue the edge, because the other side of a slit lies in the same place and ends elsewhere.
  std::vector<Index> chain(const Side& edge) {
    const Index a = cell_vertex_[edge.from], b = cell_vertex_[edge.to];
    if (a < 0 || b < 0) return {};
    if (has_edge(a, b)) return {a, b};
    std::map<Index, Index> before{{a, -1}};  // predecessor of each vertex
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

  // Returns the position of a new vertex along an edge of the surface, between 0 and 1, if it lies
  // on the edge.
  std::optional<double> place_along(const Side& edge, Index vertex) const {
    if (surface_vertex(vertex) != NamedVertices::kNew) return {};
    const Vector3 start = place(edge.from), step = place(edge.to) - start;
    const Vector3 offset = cell_place(vertex) - start;
    const double t = offset.dot(step) / step.squaredNorm();
    const bool is_on = t > 0 && t < 1 && (offset - t * step).norm() <= close_;
    return is_on ? std::optional(t) : std::nullopt;
  }

  // Records on which side of the cells' edges the face lies, or joins it with its neighbour if the
  // cells lack the edge.
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
      if (shown_.is_mapped(p) && cells_of[faces.find(p)] == kNone)
        refuse_match("face {} is mapped by no cell", p);
    for (Index c = 0; c < cells_.face_count(); ++c)
      if (faces_of[cells.find(c)] == kNone)
        refuse_match("cell {} belongs to no face", cells_.input_face(c));
    // Patches are named by their smallest face.
    const Groups of_faces(count, count, [&](Index p) { return faces.find(p); });
    const Groups of_cells(count, cells_.face_count(),
                          [&](Index c) { return faces_of[cells.find(c)]; });
    for (Index p = 0; p < count; ++p)
      if (shown_.is_mapped(p) && !of_faces[p].empty())
        if (const std::string defect = compare_patch({shown_, surface_, names_.of_cells, close_},
                                                     {of_faces[p], of_cells[p]}, match_);
            !defect.empty())
          throw Mismatch{defect};
  }

  const ShownCells& shown_;
  const SurfaceMesh& cells_;
  const PolygonMesh& surface_;
  std::vector<Side> sides_;  // of the surface, polygon by polygon
  double close_;             // distance within which places are the same
  NamedVertices names_;
  std::vector<Index> cell_vertex_;       // vertex of the cells by vertex of the surface, or -1
  std::optional<PairOrder> cell_edges_;  // half-edges of the cells by their ends
  std::vector<std::vector<Index>> neighbours_;  // of the cells' vertices
  std::vector<Index> face_left_;  // face whose edge the half-edge of the cells lies on
  SurfaceMatch match_;
};

// Returns the mapped part of the surface in triangles, as SurfaceMesh takes it.
PolygonMesh triangulated(const PolygonMesh& surface, const ShownCells& cells) {
  PolygonMesh out;
  out.positions = surface.positions;
  const TriangleList list = triangulate(surface, Crossing::Fanned, {});
  for (std::size_t f = 0; f < list.triangles.size(); ++f)
    if (cells.is_mapped(list.polygon[f])) out.polygons.push_back(list.triangles[f]);
  return out;
}

}  // namespace

SurfaceMatch match_along_edges(const ShownCells& cells, const PolygonMesh& surface) {
  try {
    return EdgeMatcher(cells, surface).run();
  } catch (const Mismatch& mismatch) {
    const bool has_polygons = std::any_of(surface.polygons.begin(), surface.polygons.end(),
                                          [](const auto& p) { return p.size() > 3; });
    if (!has_polygons || !cells.face.empty()) return {mismatch.line};
    // Cells may be pieces of the triangles of a polygon that is not flat.
    const SurfaceMatch triangles = match_along_edges(
        {.mesh = cells.mesh, .rounding = cells.rounding}, triangulated(surface, cells));
    return triangles.defect.empty() ? triangles : SurfaceMatch{mismatch.line};
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
