#include "majorant/parametrization/cuts/choose_cuts.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include "majorant/framework/error.h"
#include "majorant/mesh/internal/cut_graph.h"
#include "majorant/mesh/internal/texture_borders.h"
#include "majorant/parametrization/cuts/internal/edge_costs.h"
#include "majorant/parametrization/cuts/internal/given_edges.h"
#include "majorant/parametrization/cuts/internal/pieces.h"
#include "majorant/parametrization/fields/cross_field.h"

namespace majorant {
namespace {

void require_valid(const SurfaceMesh& mesh, const CutOptions& options) {
  if (!(options.max_stretch > 1) || !std::isfinite(options.max_stretch))
    throw Error(ErrorKind::Usage, "the largest stretch of a cut must be a number above 1");
  if (!(options.sharp_angle > 0) || !(options.sharp_angle < 180))
    throw Error(ErrorKind::Usage, "the angle of sharp edges must lie between 0 and 180 degrees");
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
  if (options.method == CutMethod::Given) is_cut = flags_of_edges(mesh, options.edges);
  for (std::size_t h = 0; h < options.given.size(); ++h)
    if (const Index o = mesh.opposite(static_cast<Index>(h)); options.given[h] && o >= 0)
      is_cut[h] = is_cut[at(o)] = 1;
  return is_cut;
}

// Cuts one component, `part`, whose faces have these numbers in the whole.
void cut_automatically(const SurfaceMesh& part, const std::vector<Index>& faces,
                       std::vector<char>& is_cut, ComponentCuts& facts, const StopCheck& stop) {
  CrossFieldOptions field;
  field.stop = stop;
  const std::vector<Index> cones = cone_vertices(smoothest_cross_field(part, field));
  const std::vector<char> more = cut_graph(part, cones, cut_costs(part), stop);
  for (Index h = 0; h < part.half_edge_count(); ++h)
    if (more[at(h)]) is_cut[at(3 * faces[at(face_of(h))] + corner_of(h))] = 1;
  facts.terminals = static_cast<Index>(cones.size());
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

SurfaceCuts choose_cuts(const SurfaceMesh& mesh, const CutOptions& options,
                        const StopCheck& stop) {
  require_valid(mesh, options);
  SurfaceCuts out;
  out.is_cut = asked_cuts(mesh, options);
  std::vector<char> asked = out.is_cut;
  const auto components = component_faces(mesh.opposites());
  for (const std::vector<Index>& faces : components) {
    stop.poll();
    const SurfaceMesh part = mesh.with_components(faces, nullptr);
    ComponentCuts facts;
    facts.first_face = faces.front();
    facts.faces = part.face_count();
    facts.genus = genus(part);
    facts.boundary_loops = part.topology().boundary_loops;
    if (options.method == CutMethod::Automatic)
      cut_automatically(part, faces, out.is_cut, facts, stop);
    out.components.push_back(facts);
  }
  if (options.method == CutMethod::Automatic) asked = out.is_cut;
  open_pieces(mesh, cut_costs(mesh), out.is_cut, stop);
  add_up(mesh, asked, components, out);
  return out;
}

}  // namespace majorant
