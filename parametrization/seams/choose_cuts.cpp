#include "majorant/parametrization/seams/choose_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/model_unit.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/seams/edge_flags.h"
#include "majorant/parametrization/seams/internal/automatic_cut.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/cut_totals.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/pieces.h"
#include "majorant/parametrization/seams/internal/sharp_charts.h"
#include "majorant/parametrization/seams/internal/slivers.h"

namespace majorant {
namespace {

// The least area of a piece, relative to the total: squares of areas must stay in the range of
// doubles through many factors. Pieces of 1e-80 of the size are still mapped.
constexpr double kMinAreaRatio = 1e-160;

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
  const std::vector<double>& weight = options.preferences.weight;
  for (const auto& [count, what] : {std::pair(options.given.size(), "flags"),
                                    {options.preferences.creases.size(), "flags"},
                                    {weight.size(), "weights"}})
    if (count > 0 && count != to_size(mesh.half_edge_count()))
      throw InvalidArgument(
          fmt::format("choose_cuts: {} {} for {} half-edges", count, what, mesh.half_edge_count()));
  for (std::size_t h = 0; h < weight.size(); ++h)
    if (!(weight[h] > 0) || !std::isfinite(weight[h]))
      throw InvalidArgument(fmt::format(
          "choose_cuts: the weight of half-edge {} is {:g}, not a positive number", h, weight[h]));
  if (options.method == CutMethod::Texture && mesh.corner_texcoords().rows() == 0)
    throw Refusal(
        ErrorKind::Unsupported, mesh.file(),
        message_prefix(mesh) + "no face has texture coordinates, along which it could be cut; use ",
        Hint::AutomaticCuts);
}

// Returns the cuts that the method and the user name: 3 #F flags, both sides.
std::vector<char> requested_cuts(const SurfaceMesh& mesh, const CutOptions& options) {
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

// Throws if the area in model units is outside the range of doubles. surface: in multiples of
// `unit`.
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
  if (area > kMinAreaRatio * whole) return;
  throw Refusal(ErrorKind::Unsupported, part.mesh->file(),
                fmt::format("{}the piece of face {} has {:.3g} of the area of all, too little for "
                            "lengths in double precision; remove it or ",
                            message_prefix(*part.mesh), user_face(*part.mesh, 0), area / whole),
                Hint::MapAlone);
}
// Returns for each piece the first one that it is a copy of, if copies are to be cut alike.
std::vector<std::optional<StackPlace>> copies_among(const std::vector<SurfacePiece>& pieces,
                                                    const CutOptions& options) {
  std::vector<std::shared_ptr<const SurfaceMesh>> meshes;
  for (const SurfacePiece& piece : pieces) meshes.push_back(piece.mesh);
  const bool are_stacked = chooses_cuts(options.method) && options.whole.empty();
  return stack_places(meshes, are_stacked ? options.copies : Stacking::None, {});
}

// Returns whether texture coordinates open the piece. They do not if all of them lie at one point.
bool is_cut_by_texture(const SurfaceMesh& piece) {
  return piece.topology().boundary_loops > 0 && is_textured(piece, 0);
}

// Cuts each remaining piece to one chart; with Texture, only pieces that coordinates do not cut.
void cut_automatically(const SurfaceMesh& mesh, const CutRequest& request,
                       const CutOptions& options, SurfaceCuts& cuts, const StopCheck& stop) {
  std::vector<Index> uncut_vertex;
  const std::vector<Index> component = face_components(mesh.opposites());
  const std::vector<SurfacePiece> pieces = mesh.cut_along(cuts.is_cut, &uncut_vertex).split(stop);
  const std::vector<std::optional<StackPlace>> places = copies_among(pieces, options);
  std::vector<AutomaticCut> cut(pieces.size());
  const double all = mesh.face_count();
  double done = 0;  // faces
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    stop.poll();
    const auto& [part, faces, vertices] = pieces[k];
    const SurfaceMesh& piece = *part;
    const double before = std::exchange(done, done + piece.face_count());
    if (options.method == CutMethod::Texture && is_cut_by_texture(piece)) continue;
    CutRequest own{preferences_on(faces, request.preferences), std::vector<char>(vertices.size()),
                   request.enough};
    for (std::size_t v = 0; v < vertices.size(); ++v)
      own.whole[v] = request.whole[uncut_vertex[vertices[v]]];
    AutomaticCut& more = cut[k];
    if (places[k]) {
      more = cut[places[k]->chart];
      more.is_cut = flags_on(more.is_cut, *places[k]);
    } else {
      more = automatic_cut(piece, own, options.max_stretch, stop.between(before / all, done / all));
    }
    stop.advance(done / all);
    for (Index h = 0; h < piece.half_edge_count(); ++h)
      if (more.is_cut[h]) cuts.is_cut[3 * faces[face_of(h)] + corner_of(h)] = 1;
    ComponentCuts& facts = cuts.components[component[faces.front()]];
    facts.terminals += static_cast<Index>(more.ends.size());
    facts.estimated_stretch = std::max(facts.estimated_stretch, stretch_of_strain(more.strain));
  }
}

// Returns the cuts of a surface that is scaled so that its extent is of moderate size.
SurfaceCuts cuts_near_one(const SurfaceMesh& mesh, const CutOptions& options,
                          const StopCheck& stop) {
  CutRequest request{options.preferences, std::vector<char>(to_size(mesh.vertex_count()), 0),
                     options.enough};
  for (const Index v : options.whole) request.whole[v] = 1;
  SurfaceCuts out;
  out.is_cut = requested_cuts(mesh, options);
  std::vector<char> requested = out.is_cut;
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
    cut_apart_flat_piece(part, options.max_stretch, out.is_cut, stop);
    if (chooses_cuts(options.method)) cut_off_slivers(part, out.is_cut);
  }
  if (options.method != CutMethod::Given) cut_automatically(mesh, request, options, out, stop);
  if (options.method == CutMethod::Texture) out.untextured_faces = untextured_polygons(mesh);
  if (options.method == CutMethod::Automatic) requested = out.is_cut;
  open_pieces(mesh, cut_costs(mesh, request.preferences, request.whole), out.is_cut, stop);
  add_totals(mesh, requested, components, out);
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
