#include "majorant/parametrization/cuts/choose_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "majorant/framework/error.h"
#include "majorant/mesh/internal/texture_borders.h"
#include "majorant/parametrization/cuts/internal/automatic_cut.h"
#include "majorant/parametrization/cuts/internal/edge_costs.h"
#include "majorant/parametrization/cuts/internal/flattening_strain.h"
#include "majorant/parametrization/cuts/internal/given_edges.h"
#include "majorant/parametrization/cuts/internal/pieces.h"
#include "majorant/parametrization/cuts/internal/sharp_charts.h"

namespace majorant {
namespace {

void require_valid(const SurfaceMesh& mesh, const CutOptions& options) {
  if (!(options.max_stretch > 1) || !std::isfinite(options.max_stretch))
    throw Error(ErrorKind::Usage,
                fmt::format("the largest stretch of a chart, {:g}, must be above 1, that of an "
                            "isometry; try {:g}",
                            options.max_stretch, CutOptions().max_stretch));
  if (!(options.sharp_angle > 0) || !(options.sharp_angle < 180))
    throw Error(ErrorKind::Usage, "the angle of sharp edges must lie between 0 and 180 degrees");
  for (const Index v : options.whole)
    if (v < 0 || v >= mesh.vertex_count())
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: vertex {}, to be left whole, does not exist", mesh.file(), v));
  if (!options.given.empty() && options.given.size() != at(mesh.half_edge_count()))
    throw std::invalid_argument("choose_cuts: one flag per half-edge is needed");
  if (options.method == CutMethod::Texture && mesh.corner_texcoords().rows() == 0)
    throw Error(ErrorKind::Unsupported,
                mesh.file() +
                    ": not every face corner has texture coordinates, along which it could be "
                    "cut; use --seams auto");
}

// What is asked for: flags of both sides.
std::vector<char> asked_cuts(const SurfaceMesh& mesh, const CutOptions& options) {
  std::vector<char> is_cut(at(mesh.half_edge_count()), 0);
  if (options.method == CutMethod::Texture) is_cut = texture_borders(mesh);
  if (options.method == CutMethod::Sharp) is_cut = sharp_charts(mesh, options.sharp_angle);
  if (options.method == CutMethod::Given)
    is_cut = flags_of_edges(mesh, options.edges, options.edges_source);
  for (std::size_t h = 0; h < options.given.size(); ++h)
    if (const Index o = mesh.opposite(static_cast<Index>(h)); options.given[h] && o >= 0)
      is_cut[h] = is_cut[at(o)] = 1;
  return is_cut;
}

// Which of the pieces that are left so far.
enum class Pieces { All, Closed };

// Cuts them, each to one chart.
void cut_automatically(const SurfaceMesh& mesh, const std::vector<char>& is_whole,
                       double max_stretch, Pieces which, SurfaceCuts& cuts, const StopCheck& stop) {
  std::vector<Index> uncut_vertex;
  const std::vector<Index> component = face_components(mesh.opposites());
  for (const auto& [part, faces, vertices] :
       mesh.cut_along(cuts.is_cut, &uncut_vertex).split(stop)) {
    stop.poll();
    const SurfaceMesh& piece = *part;
    if (which == Pieces::Closed && piece.topology().boundary_loops > 0) continue;
    std::vector<char> whole(vertices.size());
    for (std::size_t v = 0; v < whole.size(); ++v)
      whole[v] = is_whole[at(uncut_vertex[at(vertices[v])])];
    const AutomaticCut more =
        automatic_cut(piece, cut_costs(piece, whole), whole, max_stretch, stop);
    for (Index h = 0; h < piece.half_edge_count(); ++h)
      if (more.is_cut[at(h)]) cuts.is_cut[at(3 * faces[at(face_of(h))] + corner_of(h))] = 1;
    ComponentCuts& facts = cuts.components[at(component[at(faces.front())])];
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
      pieces.insert(piece[at(f)]);
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (!cuts.is_cut[at(h)] || h > mesh.opposite(h)) continue;
        const double length = mesh.edge_length(h);
        facts.length += length;
        ++cuts.edges;
        if (asked[at(h)]) continue;
        cuts.added_length += length;
        ++cuts.added_edges;
      }
    }
    facts.pieces = static_cast<Index>(pieces.size());
    cuts.length += facts.length;
  }
}

}  // namespace

SurfaceCuts choose_cuts(const SurfaceMesh& mesh, const CutOptions& options, const StopCheck& stop) {
  require_valid(mesh, options);
  std::vector<char> is_whole(at(mesh.vertex_count()), 0);
  for (const Index v : options.whole) is_whole[at(v)] = 1;
  SurfaceCuts out;
  out.is_cut = asked_cuts(mesh, options);
  std::vector<char> asked = out.is_cut;
  const auto components = component_faces(mesh.opposites());
  for (const SurfacePiece& part : mesh.split(stop)) {
    stop.poll();
    ComponentCuts facts;
    facts.first_face = part.face.front();
    facts.faces = part.mesh->face_count();
    facts.genus = genus(*part.mesh);
    facts.boundary_loops = part.mesh->topology().boundary_loops;
    out.components.push_back(facts);
  }
  if (options.method == CutMethod::Automatic || options.method == CutMethod::Sharp)
    cut_automatically(mesh, is_whole, options.max_stretch, Pieces::All, out, stop);
  if (options.method == CutMethod::Texture)  // no coordinates cut these: all zero, say
    cut_automatically(mesh, is_whole, options.max_stretch, Pieces::Closed, out, stop);
  if (options.method == CutMethod::Automatic) asked = out.is_cut;
  open_pieces(mesh, cut_costs(mesh, is_whole), out.is_cut, stop);
  add_up(mesh, asked, components, out);
  return out;
}

}  // namespace majorant
