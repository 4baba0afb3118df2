#include "majorant/parametrization/seams/choose_cuts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/model_unit.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/seams/internal/automatic_cut.h"
#include "majorant/parametrization/seams/internal/edge_costs.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/given_edges.h"
#include "majorant/parametrization/seams/internal/pieces.h"
#include "majorant/parametrization/seams/internal/sharp_charts.h"

namespace majorant {
namespace {

// Of a piece, of the area of all: squares of areas, and what remains of them after many
// factors, must be doubles; 1e-80 of the size is mapped.
constexpr double kLeastArea = 1e-160;

void require_valid(const SurfaceMesh& mesh, const CutOptions& options) {
  if (!(options.max_stretch > 1) || !std::isfinite(options.max_stretch))
    throw InvalidArgument(
        fmt::format("the largest stretch of a chart, {:g}, must be above 1, that of an "
                    "isometry; try {:g}",
                    options.max_stretch, CutOptions().max_stretch));
  if (!(options.sharp_angle > 0) || !(options.sharp_angle < 180))
    throw InvalidArgument("the angle of sharp edges must lie between 0 and 180 degrees");
  for (const Index v : options.whole)
    if (v < 0 || v >= mesh.vertex_count())
      throw InvalidArgument(
          fmt::format("{}vertex {}, to be left whole, does not exist", message_prefix(mesh), v));
  if (!options.given.empty() && options.given.size() != to_size(mesh.half_edge_count()))
    throw InvalidArgument(fmt::format("choose_cuts: {} flags for {} half-edges",
                                      options.given.size(), mesh.half_edge_count()));
  if (options.method == CutMethod::Texture && mesh.corner_texcoords().rows() == 0)
    throw Refusal(
        ErrorKind::Unsupported, mesh.file(),
        message_prefix(mesh) + "no face has texture coordinates, along which it could be cut; use ",
        Hint::AutomaticCuts);
}

// What is asked for: flags of both sides.
std::vector<char> asked_cuts(const SurfaceMesh& mesh, const CutOptions& options) {
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  if (options.method == CutMethod::Texture) is_cut = texture_borders(mesh);
  if (options.method == CutMethod::Sharp) is_cut = sharp_charts(mesh, options.sharp_angle);
  if (options.method == CutMethod::Given)
    is_cut = flags_of_edges(mesh, options.edges, options.edges_source);
  for (std::size_t h = 0; h < options.given.size(); ++h)
    if (const Index o = mesh.opposite(static_cast<Index>(h)); options.given[h] && o >= 0)
      is_cut[h] = is_cut[o] = 1;
  return is_cut;
}

// surface: in units in which its extent is an ordinary number.
void require_area_in_range(const SurfaceMesh& surface, double unit) {
  const double area = surface.area() * unit * unit;
  if (area >= std::numeric_limits<double>::min() && std::isfinite(area)) return;
  throw Error(ErrorKind::Unsupported,
              fmt::format("{}of some {:.0e} units, its area leaves the range of doubles; scale "
                          "the mesh",
                          message_prefix(surface), unit));
}

void require_usable_size(const SurfacePiece& part, double whole) {
  const double area = part.mesh->area();
  if (area > kLeastArea * whole) return;
  throw Refusal(ErrorKind::Unsupported, part.mesh->file(),
                fmt::format("{}the piece of face {} has {:.3g} of the area of all, too little for "
                            "lengths in double precision; remove it or ",
                            message_prefix(*part.mesh), user_face(*part.mesh, 0), area / whole),
                Hint::MapAlone);
}

// Twice the largest area of a face, where all have none but for rounding.
std::optional<double> area_of_slivers(const SurfaceMesh& mesh) {
  double largest = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](Index k) -> Vector3 {
      return mesh.positions().row(mesh.faces()(f, k));
    };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    if (has_area(a, b, c)) return {};
    largest = std::max(largest, (b - a).cross(c - a).norm());
  }
  return largest;
}

// A piece whose faces all have no area is taken apart, unless they are thin beyond measure and lie
// in the plane: nothing is known of their shapes beside each other.
void take_apart_if_flat(const SurfacePiece& part, double max_stretch, std::vector<char>& is_cut,
                        const StopCheck& stop) {
  const SurfaceMesh& mesh = *part.mesh;
  const std::optional<double> largest = area_of_slivers(mesh);
  if (!largest) return;
  if (*largest > 0 && is_planar(mesh) &&
      FlatteningStrain(mesh, -1, stop).strain() <= strain_of_stretch(max_stretch))
    return;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0) is_cut[3 * part.face[face_of(h)] + corner_of(h)] = 1;
}

// Which of the pieces that are left so far. NotByTexture: those that are closed, as no coordinates
// cut them (all zero, say), and those whose faces have none.
enum class Pieces { All, NotByTexture };

// Cuts them, each to one chart.
void cut_automatically(const SurfaceMesh& mesh, const std::vector<char>& is_whole,
                       double max_stretch, Pieces which, SurfaceCuts& cuts, const StopCheck& stop) {
  std::vector<Index> uncut_vertex;
  const std::vector<Index> component = face_components(mesh.opposites());
  for (const auto& [part, faces, vertices] :
       mesh.cut_along(cuts.is_cut, &uncut_vertex).split(stop)) {
    stop.poll();
    const SurfaceMesh& piece = *part;
    if (which == Pieces::NotByTexture && piece.topology().boundary_loops > 0 &&
        is_textured(piece, 0))
      continue;
    std::vector<char> whole(vertices.size());
    for (std::size_t v = 0; v < whole.size(); ++v) whole[v] = is_whole[uncut_vertex[vertices[v]]];
    const AutomaticCut more =
        automatic_cut(piece, cut_costs(piece, whole), whole, max_stretch, stop);
    for (Index h = 0; h < piece.half_edge_count(); ++h)
      if (more.is_cut[h]) cuts.is_cut[3 * faces[face_of(h)] + corner_of(h)] = 1;
    ComponentCuts& facts = cuts.components[component[faces.front()]];
    facts.terminals += static_cast<Index>(more.ends.size());
    facts.estimated_stretch = std::max(facts.estimated_stretch, stretch_of_strain(more.strain));
  }
}

// Lengths and counts, from the flags.
void add_up(const SurfaceMesh& mesh, const std::vector<char>& asked,
            const std::vector<std::vector<Index>>& components, SurfaceCuts& cuts) {
  const std::vector<Index> piece =
      face_components(mesh.cut_along(cuts.is_cut, nullptr).opposites());
  for (std::size_t c = 0; c < components.size(); ++c) {
    ComponentCuts& facts = cuts.components[c];
    std::set<Index> pieces;
    for (const Index f : components[c]) {
      pieces.insert(piece[f]);
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (!cuts.is_cut[h] || h > mesh.opposite(h)) continue;
        const double length = mesh.edge_length(h);
        facts.length += length;
        ++cuts.edges;
        if (asked[h]) continue;
        cuts.added_length += length;
        ++cuts.added_edges;
      }
    }
    facts.pieces = static_cast<Index>(pieces.size());
    cuts.length += facts.length;
  }
}

SurfaceCuts cuts_near_one(const SurfaceMesh& mesh, const CutOptions& options,
                          const StopCheck& stop) {
  std::vector<char> is_whole(to_size(mesh.vertex_count()), 0);
  for (const Index v : options.whole) is_whole[v] = 1;
  SurfaceCuts out;
  out.is_cut = asked_cuts(mesh, options);
  std::vector<char> asked = out.is_cut;
  const auto components = component_faces(mesh.opposites());
  const double area = mesh.area();
  for (const SurfacePiece& part : mesh.split(stop)) {
    stop.poll();
    ComponentCuts facts;
    facts.first_face = part.face.front();
    facts.faces = part.mesh->face_count();
    facts.genus = genus(*part.mesh);
    facts.boundary_loops = part.mesh->topology().boundary_loops;
    out.components.push_back(facts);
    require_usable_size(part, area);
    take_apart_if_flat(part, options.max_stretch, out.is_cut, stop);
  }
  if (options.method == CutMethod::Automatic || options.method == CutMethod::Sharp)
    cut_automatically(mesh, is_whole, options.max_stretch, Pieces::All, out, stop);
  if (options.method == CutMethod::Texture) {
    cut_automatically(mesh, is_whole, options.max_stretch, Pieces::NotByTexture, out, stop);
    out.untextured_faces = untextured_polygons(mesh);
  }
  if (options.method == CutMethod::Automatic) asked = out.is_cut;
  open_pieces(mesh, cut_costs(mesh, is_whole), out.is_cut, stop);
  add_up(mesh, asked, components, out);
  return out;
}

}  // namespace

void require_usable_sizes(const SurfaceMesh& mesh, const StopCheck& stop) {
  const double unit = model_unit(mesh);
  if (unit != 1) {
    const auto scaled = in_units(mesh, unit);
    require_area_in_range(*scaled, unit);
    return require_usable_sizes(*scaled, stop);
  }
  const double area = mesh.area();
  for (const SurfacePiece& part : mesh.split(stop)) require_usable_size(part, area);
}

SurfaceCuts choose_cuts(const SurfaceMesh& mesh, const CutOptions& options, const StopCheck& stop) {
  require_valid(mesh, options);
  const double unit = model_unit(mesh);
  if (unit == 1) return cuts_near_one(mesh, options, stop);
  const auto scaled = in_units(mesh, unit);
  require_area_in_range(*scaled, unit);
  SurfaceCuts cuts = cuts_near_one(*scaled, options, stop);
  cuts.length *= unit;
  cuts.added_length *= unit;
  for (ComponentCuts& component : cuts.components) component.length *= unit;
  return cuts;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
