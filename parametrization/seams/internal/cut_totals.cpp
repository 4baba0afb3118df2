// The functions add_cuts() and remove_cuts() of choose_cuts.h, and the totals of cuts.
#include "majorant/parametrization/seams/internal/cut_totals.h"

#include <set>

#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// Sets the flags of these half-edges, both sides, and updates the totals.
void set_cuts(const SurfaceMesh& mesh, const CutOptions& options,
              const std::vector<Index>& half_edges, char flag, SurfaceCuts& cuts) {
  const std::vector<Index> component = face_components(mesh.opposites());
  const int sign = flag ? 1 : -1;
  for (const Index h : half_edges) {
    const Index o = mesh.opposite(h);
    if (o < 0 || cuts.is_cut[h] == flag) continue;
    cuts.is_cut[h] = cuts.is_cut[o] = flag;
    const double length = sign * mesh.edge_length(h);
    cuts.length += length;
    cuts.edges += sign;
    cuts.components[component[face_of(h)]].length += length;
    if (options.method == CutMethod::Automatic) continue;
    cuts.added_length += length;
    cuts.added_edges += sign;
  }
  for (ComponentCuts& facts : cuts.components) facts.pieces = 0;
  const auto pieces = component_faces(mesh.cut_along(cuts.is_cut, nullptr).opposites());
  for (const std::vector<Index>& faces : pieces) ++cuts.components[component[faces.front()]].pieces;
}

}  // namespace

void add_totals(const SurfaceMesh& mesh, const std::vector<char>& requested,
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
        if (requested[h]) continue;
        cuts.added_length += length;
        ++cuts.added_edges;
      }
    }
    facts.pieces = static_cast<Index>(pieces.size());
    cuts.length += facts.length;
  }
}

void add_cuts(const SurfaceMesh& mesh, const CutOptions& options,
              const std::vector<Index>& half_edges, SurfaceCuts& cuts) {
  set_cuts(mesh, options, half_edges, 1, cuts);
}

void remove_cuts(const SurfaceMesh& mesh, const CutOptions& options,
                 const std::vector<Index>& half_edges, SurfaceCuts& cuts) {
  set_cuts(mesh, options, half_edges, 0, cuts);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
