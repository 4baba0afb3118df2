#include "majorant/io/internal/repaired_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "majorant/io/internal/close_of.h"
#include "majorant/mesh/half_edge.h"
#include "majorant/mesh/internal/weld.h"
#include "majorant/mesh/repair.h"

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

class FaceMatcher {
 public:
  FaceMatcher(const SurfaceMesh& cells, const PolygonMesh& surface, const RepairedSurface& repaired,
              const std::vector<Index>& face_of_cell)
      : cells_(cells),
        surface_(surface),
        repaired_(repaired),
        face_of_cell_(face_of_cell),
        place_(weld(surface, 0)) {}

  SurfaceMatch run() {
    SurfaceMatch match;
    match.defect = misplaced();
    const auto count = surface_.polygons.size();
    std::vector<std::vector<Index>> cells_of(count), faces_of(count);
    for (Index c = 0; c < cells_.face_count() && match.defect.empty(); ++c) {
      const Index face = face_of_cell_[at(c)];
      if (face < 0 || at(face) >= count)
        match.defect = fmt::format("the surface has no face {}", face);
      else
        cells_of[at(face)].push_back(c);
    }
    for (Index f = 0; f < repaired_.mesh->face_count(); ++f)
      faces_of[at(repaired_.mesh->input_face(f))].push_back(f);
    for (std::size_t p = 0; p < count && match.defect.empty(); ++p)
      match.defect = compare(static_cast<Index>(p), cells_of[p], faces_of[p]);
    match.same = static_cast<Index>(count);
    return match;
  }

 private:
  // The first cell with a vertex that the surface lacks, or has elsewhere.
  std::string misplaced() const {
    const double close = close_of(box_of(surface_));
    for (Index v = 0; v < cells_.vertex_count(); ++v) {
      const Index name = cells_.input_vertex(v);
      if (at(name) >= place_.size()) return fmt::format("the surface has no vertex {}", name);
      if (!((cells_.input_position(v) - surface_.positions[at(name)]).norm() <= close))
        return fmt::format("vertex {} is not where the surface has it", name);
    }
    return {};
  }

  std::string compare(Index p, const std::vector<Index>& cells,
                      const std::vector<Index>& faces) const {
    if (cells.size() != faces.size())
      return fmt::format("face {} of the surface has {} cells instead of {}", p, cells.size(),
                         faces.size());
    if (are_those_of_repair(p, cells, faces) || are_another_triangulation(p, cells, faces))
      return {};
    return fmt::format("face {} is mapped by cells that are not its own, or turned over", p);
  }

  Corners polygon_corners(Index face) const {
    const auto row = repaired_.polygon_corner.row(face);
    return {row[0], row[1], row[2]};
  }

  Index place(Index polygon, Index corner) const {
    return place_[at(surface_.polygons[at(polygon)][at(corner)])];
  }

  Corners places(Index cell) const {
    Corners out;
    for (Index k = 0; k < 3; ++k)
      out[at(k)] = place_[at(cells_.input_vertex(cells_.faces()(cell, k)))];
    return out;
  }

  // Every face has its cell: they come in the same order as a rule.
  bool are_those_of_repair(Index p, std::vector<Index> cells,
                           const std::vector<Index>& faces) const {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      Corners wanted = polygon_corners(faces[k]);
      for (Index& corner : wanted) corner = place(p, corner);
      const auto it =
          std::find_if(cells.begin() + static_cast<std::ptrdiff_t>(k), cells.end(), [&](Index c) {
            const Corners has = places(c);
            return has == wanted || turned(has, 1) == wanted || turned(has, 2) == wanted;
          });
      if (it == cells.end()) return false;
      std::iter_swap(cells.begin() + static_cast<std::ptrdiff_t>(k), it);
    }
    return true;
  }

  // Of a polygon whose corners are at different places: n - 2 triangles whose edges are those of
  // the polygon, once each, and pairs that cancel are a disk; none faces the other way.
  bool are_another_triangulation(Index p, const std::vector<Index>& cells,
                                 const std::vector<Index>& faces) const {
    const auto size = static_cast<Index>(surface_.polygons[at(p)].size());
    const bool is_turned = !is_ascending(polygon_corners(faces.front()));
    for (const Index f : faces)
      if (is_ascending(polygon_corners(f)) == is_turned) return false;
    std::set<Index> different;
    std::set<std::pair<Index, Index>> wanted, edges;
    Vector3 side = Vector3::Zero();
    for (Index k = 0; k < size; ++k) {
      const Index a = place(p, k), b = place(p, (k + 1) % size);
      different.insert(a);
      wanted.insert(is_turned ? std::pair(b, a) : std::pair(a, b));
    }
    if (static_cast<Index>(different.size()) != size) return false;
    for (const Index f : faces) side += area_vector(*repaired_.mesh, f);
    for (const Index c : cells) {
      const Corners corners = places(c);
      if (!(area_vector(cells_, c).dot(side) > 0)) return false;
      for (Index k = 0; k < 3; ++k)
        if (!edges.emplace(corners[at(k)], corners[at(next(k))]).second) return false;
    }
    std::erase_if(edges, [edges](const auto& e) { return edges.contains({e.second, e.first}); });
    return edges == wanted;
  }

  static Vector3 area_vector(const SurfaceMesh& mesh, Index face) {
    const auto corner = [&](Index k) -> Eigen::Vector3d {
      return mesh.positions().row(mesh.faces()(face, k));
    };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)) / 2;
  }

  const SurfaceMesh& cells_;
  const PolygonMesh& surface_;
  const RepairedSurface& repaired_;
  const std::vector<Index>& face_of_cell_;
  std::vector<Index> place_;  // by vertex of the surface: the first one exactly there
};

}  // namespace

std::optional<SurfaceMatch> match_repaired(const SurfaceMesh& cells, const PolygonMesh& surface,
                                           const std::vector<Index>& face_of_cell) {
  if (surface.polygons.empty()) return {};
  const RepairedSurface repaired = repair(surface);
  if (!takes_apart(repaired)) return {};
  return FaceMatcher(cells, surface, repaired, face_of_cell).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
