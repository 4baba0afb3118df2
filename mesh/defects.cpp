#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/internal/place_text.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/weld.h"

namespace majorant {
namespace {

// Vertices on the inside of boundary edges, where a neighbour was refined and its edge was not.

// Part of the edge's length: midpoints as files have them, in seven digits.
constexpr double kTJunctionDistance = 1e-6;

struct TJunction {
  Index vertex, half_edge;
  bool operator<(const TJunction& j) const { return vertex < j.vertex; }
};

// Points in space, halved again and again across the longer side of their box.
class PointTree {
 public:
  PointTree(const Points3& positions, std::vector<Index> points)
      : positions_(positions), points_(std::move(points)) {
    build(0, points_.size());
  }

  // Calls visit(point) for all points closer than `reach` to the segment, and some others.
  template <class Visit>
  void near_segment(const Vector3& a, const Vector3& b, double reach, const Visit& visit) const {
    std::vector<std::size_t> left = {0};
    while (!left.empty() && !nodes_.empty()) {
      const std::size_t n = left.back();
      const Node& node = nodes_[n];
      left.pop_back();
      if (!passes(node, a, b, reach)) continue;
      if (node.second_child == 0) {
        for (std::size_t k = node.first; k < node.last; ++k) visit(points_[k]);
      } else {
        left.push_back(node.second_child);
        left.push_back(n + 1);
      }
    }
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  struct Node {
    Vector3 low, high;
    std::size_t first, last;
    std::size_t second_child = 0;  // the first one follows its parent; 0: a leaf
  };

  void build(std::size_t first, std::size_t last) {
    if (first == last) return;
    Node node{positions_.row(points_[first]), positions_.row(points_[first]), first, last};
    for (std::size_t k = first; k < last; ++k) {
      const Vector3 p = positions_.row(points_[k]);
      node.low = node.low.cwiseMin(p);
      node.high = node.high.cwiseMax(p);
    }
    const std::size_t here = nodes_.size();
    nodes_.push_back(node);
    if (last - first <= kLeaf) return;
    Eigen::Index axis;
    (node.high - node.low).maxCoeff(&axis);
    const std::size_t middle = first + (last - first) / 2;
    const auto place = [&](std::size_t k) {
      return points_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::nth_element(place(first), place(middle), place(last),
                     [&](Index p, Index q) { return positions_(p, axis) < positions_(q, axis); });
    build(first, middle);
    nodes_[here].second_child = nodes_.size();
    build(middle, last);
  }

  // Returns whether the segment meets the box, made larger by `reach`.
  static bool passes(const Node& node, const Vector3& a, const Vector3& b, double reach) {
    double from = 0, to = 1;
    for (int k = 0; k < 3; ++k) {
      const double low = node.low[k] - reach - a[k], high = node.high[k] + reach - a[k];
      const double along = b[k] - a[k];
      if (along == 0) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      from = std::max(from, std::min(low / along, high / along));
      to = std::min(to, std::max(low / along, high / along));
    }
    return from <= to;
  }

  const Points3& positions_;
  std::vector<Index> points_;
  std::vector<Node> nodes_;
};

// One for each such vertex, ascending: boundary vertices that are kTJunctionDistance from a
// boundary edge and farther than that from its ends. O(n log n).
std::vector<TJunction> find_t_junctions(const SurfaceMesh& mesh, const StopCheck& stop = {}) {
  std::vector<Index> boundary;
  for (const auto& loop : mesh.boundary_loops())
    boundary.insert(boundary.end(), loop.begin(), loop.end());
  const PointTree tree(mesh.positions(), std::move(boundary));
  std::vector<TJunction> found;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) >= 0) continue;
    stop.poll_at(to_size(h));
    const Vector3 a = mesh.positions().row(mesh.from_vertex(h));
    const Vector3 b = mesh.positions().row(mesh.to_vertex(h));
    const double length = (b - a).norm(), reach = kTJunctionDistance * length;
    if (!(length > 0)) continue;
    tree.near_segment(a, b, reach, [&](Index v) {
      const Vector3 p = Vector3(mesh.positions().row(v)) - a;
      const double along = p.dot(b - a) / length;
      const double off = (p - along * (b - a) / length).norm();
      if (along > reach && along < length - reach && off <= reach) found.push_back({v, h});
    });
  }
  std::stable_sort(found.begin(), found.end());
  const auto same = [](const TJunction& i, const TJunction& j) { return i.vertex == j.vertex; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

using Places = std::vector<std::array<Index, 2>>;

const FindingText& text_of(DefectKind kind) {
  static constexpr std::array<FindingText, 14> kTexts = {{
      {"soup", "soup: no face shares a vertex with another", "soups", ""},
      {"repeated_vertex", "face has a vertex twice", "faces have a vertex twice", "face"},
      {"duplicate_face", "face has the vertices of another", "faces have the vertices of others",
       "face"},
      {"non_manifold_edge", "edge has more than two faces", "edges have more than two faces",
       "edge"},
      {"non_manifold_vertex", "vertex is where sheets of the surface touch",
       "vertices are where sheets of the surface touch", "vertex"},
      {"inconsistent_face", "face is oriented against its neighbours",
       "faces are oriented against their neighbours", "face"},
      {"one_sided", "component has one side only", "components have one side only",
       "cut along edge"},
      {"crossing_polygon", "polygon crosses itself", "polygons cross themselves", "face"},
      {"zero_area", "face has no area", "faces have no area", "face"},
      {"needle", "face is a needle", "faces are needles", "face"},
      {"far_from_origin", "mesh is far from the origin for its size", "meshes", ""},
      {"coincident_vertices", "vertex is exactly where another one is",
       "vertices are exactly where others are", "vertex"},
      {"t_junction", "vertex lies on the inside of a boundary edge",
       "vertices lie on the inside of boundary edges", "vertex"},
      {"isolated_vertex", "vertex has no face", "vertices have no face", "vertex"},
  }};
  return kTexts[static_cast<std::size_t>(kind)];
}

class Finding {
 public:
  Finding(const PolygonMesh& input, const StopCheck& stop)
      : input_(input), stop_(stop), repaired_(repair(input, {}, stop)) {}

  MeshDefects find() {
    if (is_soup(input_)) note(DefectKind::Soup, 1, {});
    take(RepairKind::RepeatedVertex, DefectKind::RepeatedVertex);
    take(RepairKind::DuplicateFace, DefectKind::DuplicateFace);
    take(RepairKind::SplitEdge, DefectKind::NonManifoldEdge);
    take(RepairKind::SplitVertex, DefectKind::NonManifoldVertex);
    take(RepairKind::TurnedFace, DefectKind::InconsistentFace);
    note(DefectKind::OneSided, repaired_.one_sided, places_of(RepairKind::CutEdge));
    take(RepairKind::CrossingPolygon, DefectKind::CrossingPolygon);
    judge_shapes();
    take(RepairKind::MovedToOrigin, DefectKind::FarFromOrigin);
    note(DefectKind::CoincidentVertices, vertices(left_unwelded()));
    Places junctions;
    for (const TJunction& j : find_t_junctions(*repaired_.mesh, stop_))
      junctions.push_back({repaired_.mesh->input_vertex(j.vertex), -1});
    junctions.erase(std::unique(junctions.begin(), junctions.end()), junctions.end());
    note(DefectKind::TJunction, std::move(junctions));
    note(DefectKind::IsolatedVertex, vertices(isolated()));
    list_components();
    return std::move(found_);
  }

 private:
  void note(DefectKind kind, Index count, Places places) {
    if (count > 0) found_.defects.push_back({kind, count, std::move(places)});
  }
  void note(DefectKind kind, Places places) {
    const auto count = static_cast<Index>(places.size());
    if (places.size() > kNamedPlaces) places.resize(kNamedPlaces);
    note(kind, count, std::move(places));
  }
  void take(RepairKind from, DefectKind kind) {
    for (const Repair& r : repaired_.repairs)
      if (r.kind == from) note(kind, r.count, r.places);
  }
  Places places_of(RepairKind kind) const {
    for (const Repair& r : repaired_.repairs)
      if (r.kind == kind) return r.places;
    return {};
  }
  static Places vertices(const std::vector<Index>& vertices) {
    Places places;
    for (const Index v : vertices) places.push_back({v, -1});
    return places;
  }

  void judge_shapes() {
    const SurfaceMesh& mesh = *repaired_.mesh;
    Places zero, needles;
    for (const RestTriangle& t : mesh.rest_triangles()) {
      Places& places = has_area(mesh.positions().row(mesh.faces()(t.face, 0)),
                                mesh.positions().row(mesh.faces()(t.face, 1)),
                                mesh.positions().row(mesh.faces()(t.face, 2)))
                           ? needles
                           : zero;
      if (places.empty() || places.back()[0] != mesh.input_face(t.face))
        places.push_back({mesh.input_face(t.face), -1});
    }
    note(DefectKind::ZeroArea, std::move(zero));
    note(DefectKind::Needle, std::move(needles));
  }

  std::vector<Index> left_unwelded() const {
    if (is_soup(input_)) return {};
    return coincident_vertices(input_);
  }

  std::vector<Index> isolated() const {
    std::vector<char> is_used(input_.positions.size(), 0);
    for (const Index v : input_.polygons.indices()) is_used[v] = 1;
    std::vector<Index> isolated;
    for (std::size_t v = 0; v < is_used.size(); ++v)
      if (!is_used[v]) isolated.push_back(static_cast<Index>(v));
    return isolated;
  }

  void list_components() {
    const SurfaceMesh& mesh = *repaired_.mesh;
    const std::vector<Index> component = face_components(mesh.opposites());
    found_.components.assign(to_size(mesh.topology().components), {-1, 0, 0, 0});
    const auto shape = [&](Index face) -> ComponentShape& {
      return found_.components[component[face]];
    };
    std::vector<Index> face_at(to_size(mesh.vertex_count()), -1);
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      ComponentShape& c = shape(face_of(h));
      if (c.faces == 0) c.first_face = mesh.input_face(face_of(h));
      if (corner_of(h) == 0) {
        ++c.faces;
        ++c.euler_characteristic;
      }
      if (mesh.opposite(h) < h) --c.euler_characteristic;  // every edge once
      Index& f = face_at[mesh.from_vertex(h)];
      if (f < 0) ++c.euler_characteristic;
      f = face_of(h);
    }
    for (const auto& loop : mesh.boundary_loops()) ++shape(face_at[loop.front()]).boundary_loops;
  }

  const PolygonMesh& input_;
  const StopCheck& stop_;
  RepairedSurface repaired_;
  MeshDefects found_;
};

}  // namespace

std::string_view name_of(DefectKind kind) { return text_of(kind).name; }

std::string describe(const Defect& defect) {
  return described(text_of(defect.kind), defect.count, defect.places);
}

MeshDefects find_defects(const PolygonMesh& input, const StopCheck& stop) {
  return Finding(input, stop).find();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
