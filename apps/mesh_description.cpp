#include "apps/mesh_description.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <vector>

#include "apps/refusal_message.h"
#include "apps/streams.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/claims.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/io.h"
#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/mesh/union_find.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant::app {
namespace {

// Returns "12 triangles, 4 quads, 1 polygon of 5" from a map: number of corners -> number of
// polygons.
std::string in_words(const std::map<std::size_t, Index>& polygons) {
  std::string text;
  for (const auto& [corners, count] : polygons) {
    const char* const plural = count == 1 ? "" : "s";
    text += text.empty() ? "" : ", ";
    text += corners == 3   ? fmt::format("{} triangle{}", count, plural)
            : corners == 4 ? fmt::format("{} quad{}", count, plural)
                           : fmt::format("{} polygon{} of {}", count, plural, corners);
  }
  return text;
}

void describe_polygons(const PolygonMesh& mesh, MeshDescription& out) {
  std::map<std::size_t, Index> polygons;
  for (const auto polygon : mesh.polygons) ++polygons[polygon.size()];
  out.add("polygons: {} ({})\n", mesh.polygons.size(), in_words(polygons));
  for (const auto& [corners, count] : polygons)
    out.report.result["polygons"][std::to_string(corners)] = count;
}

// Describes the size of the part that faces use, in model units.
void describe_size(const SurfaceMesh& mesh, MeshDescription& out) {
  const Vector3 low = mesh.origin() + Vector3(mesh.positions().colwise().minCoeff());
  const Vector3 high = mesh.origin() + Vector3(mesh.positions().colwise().maxCoeff());
  std::vector<double> lengths;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (h > mesh.opposite(h)) lengths.push_back(mesh.edge_length(h));
  std::sort(lengths.begin(), lengths.end());
  const double median = lengths[lengths.size() / 2];
  out.add("bounding box: ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", low.x(), low.y(),
          low.z(), high.x(), high.y(), high.z());
  out.add("edge lengths: {:.6g} to {:.6g}, median {:.6g}\n", lengths.front(), lengths.back(),
          median);
  out.report.result["bounding_box"] = {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
  out.report.result["edge_length"] = {
      {"min", lengths.front()}, {"median", median}, {"max", lengths.back()}};
}

// Returns the number of texture islands: faces joined across edges that have the same texture
// coordinates on both sides.
Index count_islands(const SurfaceMesh& mesh) {
  const std::vector<char> is_border = texture_borders(mesh);
  UnionFind islands(mesh.face_count());
  Index count = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) count += is_textured(mesh, f) ? 1 : 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) > h && !is_border[h] && is_textured(mesh, h / 3))
      count -= islands.join(h / 3, mesh.opposite(h) / 3) ? 1 : 0;
  return count;
}

void describe_texture_coordinates(const PolygonMesh& polygons, const SurfaceMesh& mesh,
                                  MeshDescription& out) {
  out.add("texture coordinates: {}", polygons.texcoords.size());
  if (mesh.corner_texcoords().rows() > 0) {
    Vector2 low = Vector2::Constant(INFINITY), high = -low;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      if (!is_textured(mesh, f)) continue;
      for (Index k = 0; k < 3; ++k) {
        const Vector2 uv = mesh.corner_texcoords().row(f).segment<2>(2 * k);
        low = low.cwiseMin(uv);
        high = high.cwiseMax(uv);
      }
    }
    const Index islands = count_islands(mesh);
    out.add(", from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}), {}", low.x(), low.y(), high.x(), high.y(),
            count_text(islands, "island"));
    out.report.result["texture_range"] = {{low.x(), low.y()}, {high.x(), high.y()}};
    out.report.result["texture_islands"] = islands;
  }
  out.add("\n");
}

// Describes the surface after repairs.
void describe_surface(const PolygonMesh& polygons, const SurfaceMesh& mesh, MeshDescription& out) {
  const Topology& t = mesh.topology();
  out.add("file: {}\nvertices: {}\n", one_line(polygons.file), polygons.positions.size());
  describe_polygons(polygons, out);
  describe_texture_coordinates(polygons, mesh, out);
  out.add(
      "triangles: {}\ncomponents: {}\nboundary loops: {}\nEuler characteristic: {}\n"
      "area: {:.10g}\n",
      t.faces, t.components, t.boundary_loops, t.euler_characteristic(), mesh.area());
  describe_size(mesh, out);
  out.report.input = input_section(polygons, mesh);
  out.report.warnings = polygons.warnings;
  for (const std::string& warning : polygons.warnings) out.add("warning: {}\n", one_line(warning));
  for (const auto& note : out.report.input["repairs"])
    out.add("note: {}\n", note.get<std::string>());
}

void describe_defects(const std::vector<Defect>& defects, MeshDescription& out) {
  Json list = Json::array();
  for (const Defect& d : defects) {
    out.add("defect: {}\n", describe(d));
    Json places = Json::array();
    for (const auto& [first, second] : d.places)
      places.push_back(second < 0 ? Json{first} : Json{first, second});
    list.push_back({{"kind", name_of(d.kind)}, {"count", d.count}, {"places", places}});
  }
  out.report.result["defects"] = list;
}

// Returns the map that a file holds; none if it holds a mesh.
std::optional<MapFile> described_map(const std::string& path, MeshDescription& out) {
  if (!is_for(FormatUse::ReadMap, path)) return {};
  std::optional<MapFile> map;
  try {
    map = read_map(path);
  } catch (const Error&) {  // the file holds a mesh
    return {};
  }
  if (map->degree == 1 && map->claims.empty()) return {};
  const Claims claims = parse_claims(map->claims, path);
  Json section{{"degree", map->degree}, {"claims", nullptr}};
  out.add("map: of degree {}", map->degree);
  if (!map->claims.empty()) {
    const bool is_bijective = claims.bijective.value_or(false);
    section["claims"] = {{"version", claims.version ? Json(*claims.version) : Json()},
                         {"energy", claims.energy ? Json(*claims.energy) : Json()},
                         {"value", claims.value ? Json(*claims.value) : Json()},
                         {"bijective", is_bijective},
                         {"seams", claims.seams.value_or(false)}};
    out.add("; it claims {}{}{}, {}", claims.energy.value_or("no energy"),
            claims.value ? fmt::format(" {:.6f}", *claims.value) : "",
            claims.seams.value_or(false) ? ", seams" : "",
            is_bijective ? "no overlaps" : "nothing of overlaps");
  }
  out.add("; `majorant check {}` proves it\n", path);
  out.report.result["map"] = section;
  return map;
}

// Returns the seamless map that the texture coordinates form; none if they do not fit along their
// cuts. curved: the map whose corners they are; then they need not be seamless by themselves.
std::optional<BezierMap> describe_texture(const SurfaceMesh& mesh, const MapFile* curved,
                                          MeshDescription& out) {
  if (mesh.corner_texcoords().rows() == 0) return std::nullopt;
  try {
    BezierMap map = seamless_from_texture(mesh).map;
    const Seams& seams = map.seams();
    const Json cones = cones_section(map);
    out.add("texture: seamless, {}, {} of {}\n",
            count_text(static_cast<Index>(cones.size()), "cone"),
            count_text(seams.chain_count(), "chain"),
            count_text(static_cast<Index>(seams.edges().size()), "seam edge"));
    out.report.result["texture"] = {{"seamless", true},
                                    {"cones", cones},
                                    {"chains", seams.chain_count()},
                                    {"seam_edges", seams.edges().size()}};
    return map;
  } catch (const Error& e) {
    const std::string reason =
        curved ? fmt::format("corners of the map of degree {}, whose faces are curved between them",
                             curved->degree)
               : command_message(e);
    out.add("texture: {}{}\n", curved ? "" : "not seamless: ", one_line(reason));
    out.report.result["texture"] = {{"seamless", curved ? Json() : Json(false)},
                                    {"message", reason}};
    return std::nullopt;
  }
}

// Makes the start of parametrize. Throws Error if that fails.
void require_start(const std::shared_ptr<const SurfaceMesh>& mesh, MapInjectivity injectivity) {
  MapOptions options;
  options.injectivity = injectivity;
  NormalizedStart(BezierMap::linear(mesh, initial_map(*mesh, options)), options);
}

// Returns the verbs that would run, by trying them. Throws Error if none does.
std::string runnable(const std::shared_ptr<const SurfaceMesh>& mesh, const MapFile* curved,
                     MeshDescription& out) {
  const bool is_disk = is_planar(*mesh) && mesh->topology().boundary_loops == 1;
  const std::optional<BezierMap> texture = describe_texture(*mesh, curved, out);
  const bool has_seams = texture && !texture->seams().trivial();
  if (has_seams && !is_disk) {
    NormalizedStart(*texture, MapOptions());
    return "parametrize --seamless can run";
  }
  try {
    require_start(mesh, MapInjectivity::Local);
  } catch (const Error&) {
    if (is_disk || !is_planar(*mesh)) throw;
    require_start(mesh, MapInjectivity::Global);
    return "parametrize --bijective can run";
  }
  return has_seams ? "parametrize can run, with --seamless too" : "parametrize can run";
}

// Returns why unwrap would refuse the surface with any options; empty if it would not.
std::string unwrap_refusal(const SurfaceMesh& surface) try {
  require_usable_sizes(surface);
  return "";
} catch (const Error& e) {
  return command_message(e);
}

std::string verdict(const PolygonMesh& polygons, const SurfaceMesh& repaired, const MapFile* curved,
                    MeshDescription& out) {
  std::string refusal, problem, other_verb;
  try {
    const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(polygons));
    other_verb = ", or `majorant seamless`, which tries a map with cones that may overlap";
    return runnable(mesh, curved, out);
  } catch (const Error& e) {
    refusal = command_message(e);
    problem = problem_of(e);
  } catch (const std::bad_alloc&) {
    return "parametrize would refuse: out of memory while making the start";
  }
  const std::string unwrapping = unwrap_refusal(repaired);
  if (!unwrapping.empty())
    return fmt::format("parametrize would refuse: {}; and unwrap: {}", refusal, unwrapping);
  return fmt::format("use `majorant unwrap {} -o OUT.obj`{}; parametrize would refuse: {}",
                     polygons.file, other_verb, problem);
}

// Describes the plan of `majorant unwrap` up to the solve. Throws Error where unwrap would.
void describe_plan(const RepairedSurface& surface, const StopCheck& stop, MeshDescription& out) {
  const SurfaceCuts cuts = choose_cuts(*surface.mesh, {}, stop);
  Index charts = 0;
  double stretch = 1;
  for (const ComponentCuts& component : cuts.components) {
    charts += component.pieces;
    stretch = std::max(stretch, component.estimated_stretch);
  }
  out.add("plan: unwrap makes {}, cut along {} of length {:.6g}, stretch about {:.3f}\n",
          count_text(charts, "chart"), count_text(cuts.edges + surface.cut_edges, "edge"),
          cuts.length + surface.cut_length, stretch);
  out.report.result["plan"] = cuts_section(cuts, surface);
  out.report.result["plan"]["charts"] = charts;
  out.report.result["plan"]["estimated_stretch"] = stretch;
}

void describe_plan_or_refusal(const RepairedSurface& surface, const StopCheck& stop,
                              MeshDescription& out) try {
  describe_plan(surface, stop, out);
} catch (const Error& e) {
  out.add("plan: unwrap would refuse: {}\n", one_line(command_message(e)));
  out.report.result["plan"] = {{"message", command_message(e)}};
}

}  // namespace

MeshDescription describe_mesh(const PolygonMesh& polygons, const DescriptionOptions& options,
                              const StopCheck& stop) {
  MeshDescription out;
  const RepairedSurface repaired = repair(polygons, {}, stop);
  describe_surface(polygons, *repaired.mesh, out);
  describe_defects(find_defects(polygons).defects, out);
  stop.poll();
  const std::optional<MapFile> map = described_map(polygons.file, out);
  const MapFile* const curved = map && map->degree > 1 ? &*map : nullptr;
  out.report.message = verdict(polygons, *repaired.mesh, curved, out);
  out.add("verdict: {}\n", one_line(out.report.message));
  stop.poll();
  if (options.plan)
    describe_plan_or_refusal(repair(polygons, {.welding = Welding::EqualPlaces}, stop), stop, out);
  return out;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
