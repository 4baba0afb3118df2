#include "majorant/results/internal/check_seams.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "majorant/constraints/seamless_constraint.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/initialization/texture_seams.h"

namespace majorant {
namespace {

// From and to, vertices of the input.
using InputEdge = std::pair<Index, Index>;

InputEdge input_edge(const SurfaceMesh& mesh, Index h) {
  return {mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))};
}

std::string place(const InputEdge& edge) {
  return fmt::format("edge ({}, {})", edge.first, edge.second);
}

// Turns of both sides of every seam edge.
std::map<InputEdge, int> turns_by_edge(const BezierMap& map) {
  std::map<InputEdge, int> turns;
  for (const SeamEdge& edge : map.seams().edges()) {
    turns[input_edge(map.mesh(), edge.side)] = edge.turns;
    turns[input_edge(map.mesh(), edge.opposite)] = (4 - edge.turns) % 4;
  }
  return turns;
}

void check_cones(const BezierMap& map, const std::vector<Cone>& claims, Findings& findings) {
  std::map<Index, int> found, claimed;
  for (const Cone& cone : map.seams().cones())
    found[map.mesh().input_vertex(cone.vertex)] = cone.quarter_turns;
  for (const Cone& cone : claims) claimed[cone.vertex] = cone.quarter_turns;
  const auto turns = [](const std::map<Index, int>& cones, Index vertex) {
    const auto cone = cones.find(vertex);
    return cone == cones.end() ? 4 : cone->second;
  };
  for (const auto* list : {&claimed, &found})
    for (const auto& [vertex, ignored] : *list)
      if (turns(claimed, vertex) != turns(found, vertex))
        return findings.require(
            false, fmt::format("vertex {}: an angle of {} quarter turns is claimed, {} are found",
                               vertex, turns(claimed, vertex), turns(found, vertex)));
}

// The arrays `seam_edges` and `cone` of the file.
void check_marks(const MapFile& file, const BezierMap& map, Findings& findings) {
  const MapFile found = to_map_file(map);
  for (Index h = 0; h < 3 * file.seam_edges.rows(); ++h) {
    const bool is_marked = file.seam_edges(face_of(h), corner_of(h)) != 0;
    const bool is_found =
        found.seam_edges.size() > 0 && found.seam_edges(face_of(h), corner_of(h)) != 0;
    if (is_marked == is_found) continue;
    findings.require(
        false,
        fmt::format("cell {}: {} is {}", face_of(h), place(input_edge(map.mesh(), h)),
                    is_marked ? "marked as a seam and not cut" : "cut and not marked as a seam"));
    break;
  }
  if (file.cone.size() == 0) return;
  for (Index h = 0; h < 3 * file.cells.rows(); ++h) {
    const Index point = file.cells(face_of(h), corner_of(h));
    const int turns = found.cone.size() > 0 ? found.cone[found.cells(face_of(h), corner_of(h))] : 0;
    if (file.cone[point] == turns) continue;
    return findings.require(false,
                            fmt::format("vertex {}: marked as a cone of {} quarter turns, {} "
                                        "are found",
                                        input_edge(map.mesh(), h).first, file.cone[point], turns));
  }
}

void check_cut(const BezierMap& map, const SurfaceMesh& surface, Findings& findings) {
  const std::map<InputEdge, int> expected = turns_by_edge(seamless_from_texture(surface).map);
  const std::map<InputEdge, int> found = turns_by_edge(map);
  for (const auto& [edge, turns] : expected) {
    const auto same = found.find(edge);
    if (same == found.end())
      return findings.require(
          false, fmt::format("the surface's texture is cut at {}, the map is not", place(edge)));
    if (same->second != turns)
      return findings.require(
          false, fmt::format("{}: the surface's texture has {} quarter turns there, the map {}",
                             place(edge), turns, same->second));
  }
  for (const auto& [edge, turns] : found)
    if (!expected.contains(edge))
      return findings.require(
          false, fmt::format("the map is cut at {}, the surface's texture is not", place(edge)));
}

}  // namespace

bool keeps_texture_cuts(const CheckedMap& checked) {
  if (checked.surface == nullptr || checked.surface->polygon_texcoords.empty()) return false;
  const Claims& claims = checked.claims;
  if (!claims.version && !claims.seams) return true;  // it does not say where it comes from
  return claims.options && claims.options->seamless.value_or(false) &&
         (starts_at_tutte_boundary(claims) || claims.init == ClaimedStart::Input);
}

void check_seams(const CheckedMap& checked, Findings& findings) {
  const BezierMap& map = checked.map;
  if (checked.cuts.others > 0) return;
  if (checked.claims.cones) check_cones(map, *checked.claims.cones, findings);
  check_marks(checked.file, map, findings);
  if (map.seams().trivial()) return;
  if (!keeps_texture_cuts(checked)) return;
  try {
    check_cut(map, SurfaceMesh::from_polygons(*checked.surface), findings);
  } catch (const Error& e) {  // that texture is no seamless map: not asked, unless it is claimed
    if (checked.claims.version) findings.add_violation(problem_of(e));
  }
}

void check_fixed_texture_boundary(const CheckedMap& checked, Findings& findings) {
  if (!keeps_texture_cuts(checked)) return;  // not asked
  const BezierMap start = seamless_from_texture(SurfaceMesh::from_polygons(*checked.surface)).map;
  const SurfaceMesh& start_mesh = start.mesh();
  std::map<InputEdge, Index> start_edges;  // of the boundary of the cut surface
  for (Index h = 0; h < start_mesh.half_edge_count(); ++h)
    if (start_mesh.opposite(h) < 0) start_edges[input_edge(start_mesh, h)] = h;

  const BezierMap& map = checked.map;
  const std::map<InputEdge, int> seams = turns_by_edge(map);
  const Vec x = in_units_of_the_run(map.control_points(), checked.claims);
  double worst = 0;
  for (Index h = 0; h < map.mesh().half_edge_count(); ++h) {
    const InputEdge edge = input_edge(map.mesh(), h);
    if (map.mesh().opposite(h) >= 0 || seams.contains(edge)) continue;
    const auto source = start_edges.find(edge);
    if (source == start_edges.end())
      return findings.require(false, "the file maps edges the surface lacks");
    const auto at_start = [&](Index vertex) {
      return Vector2(start.control_points().segment<2>(2 * vertex));
    };
    const Vector2 from = at_start(start_mesh.from_vertex(source->second));
    const Vector2 to = at_start(start_mesh.to_vertex(source->second));
    const std::vector<Index> nodes = edge_nodes(map.space(), h);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector2 uv = x.segment<2>(2 * nodes[i]);
      const double s = static_cast<double>(i) / static_cast<double>(nodes.size() - 1);
      worst = std::max(worst, (uv - (1 - s) * from - s * to).norm());
    }
  }
  findings.require(x.allFinite() && worst <= kClose * x.cwiseAbs().maxCoeff(),
                   fmt::format("the boundary is off the initial map's by {:g}", worst));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
