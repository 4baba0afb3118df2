#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/internal/place_text.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/weld.h"

namespace majorant {
namespace {

// T-junctions: vertices on the inside of boundary edges, left where a neighbour was refined.

// The largest distance, relative to the length of the edge: files give midpoints with seven digits.
constexpr double kTJunctionDistance = 1e-6;

struct TJunction {
  Index vertex, half_edge;
  bool operator<(const TJunction& j) const { return vertex < j.vertex; }
};

// Returns one T-junction for each boundary vertex within kTJunctionDistance of a boundary edge and
// farther from its ends, ascending. Takes O(n log n).
std::vector<TJunction> find_t_junctions(const SurfaceMesh& mesh, const StopCheck& stop = {}) {
  std::vector<Index> boundary;
  for (const auto& loop : mesh.boundary_loops())
    boundary.insert(boundary.end(), loop.begin(), loop.end());
  std::vector<Box3> boxes;
  for (const Index v : boundary)
    boxes.push_back({mesh.positions().row(v), mesh.positions().row(v)});
  const BoxTree<3> tree(std::move(boxes));
  std::vector<TJunction> found;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) >= 0) continue;
    stop.poll_at(to_size(h));
    const Vector3 a = mesh.positions().row(mesh.from_vertex(h));
    const Vector3 b = mesh.positions().row(mesh.to_vertex(h));
    const double length = (b - a).norm(), reach = kTJunctionDistance * length;
    if (!(length > 0)) continue;
    tree.visit_along({a, b - a, 1}, reach, [&](Index place) {
      const Index v = boundary[to_size(place)];
      const Vector3 p = Vector3(mesh.positions().row(v)) - a;
      const double along = p.dot(b - a) / length;
      const double off = (p - along * (b - a) / length).norm();
      if (along > reach && along < length - reach && off <= reach) found.push_back({v, h});
      return true;
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
    note(DefectKind::OneSided, repaired_.one_sided, repair_places(RepairKind::CutEdge));
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
  Places repair_places(RepairKind kind) const {
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
    for (const Topology& counts : component_topologies<3>(
             mesh.vertex_count(), mesh.opposites(), [&](Index h) { return mesh.from_vertex(h); }))
      found_.components.push_back(
          {-1, counts.faces, counts.boundary_loops, counts.euler_characteristic()});
    for (Index f = mesh.face_count() - 1; f >= 0; --f)
      found_.components[component[f]].first_face = mesh.input_face(f);
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
