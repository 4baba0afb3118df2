#include "majorant/parametrization/seams/internal/given_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"

namespace majorant {
namespace {

enum class Found { Nothing, InnerEdge, Edge };

[[noreturn]] void refuse(const std::string& source, const std::pair<Index, Index>& edge,
                         const std::string& what) {
  throw Error(
      ErrorKind::Usage,
      fmt::format("{}{}vertices {} and {} (counting from 0) are joined {}; correct the list",
                  source, source.empty() ? "" : ": ", edge.first, edge.second, what));
}

}  // namespace

std::vector<char> flags_of_edges(const SurfaceMesh& mesh,
                                 const std::vector<std::array<Index, 2>>& edges,
                                 const std::string& source) {
  std::map<std::pair<Index, Index>, Found> wanted;
  for (const auto& [a, b] : edges) wanted[std::minmax(a, b)] = Found::Nothing;
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    const auto edge = wanted.find(
        std::minmax(mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))));
    if (edge == wanted.end()) continue;
    if (o >= 0 && mesh.input_face(face_of(h)) == mesh.input_face(face_of(o))) {
      edge->second = std::max(edge->second, Found::InnerEdge);
    } else {
      edge->second = Found::Edge;
      is_cut[h] = o >= 0;
    }
  }
  for (const auto& [edge, found] : wanted) {
    if (found == Found::Nothing)
      refuse(source, edge, "by no edge of " + (mesh.file().empty() ? "the mesh" : mesh.file()));
    if (found == Found::InnerEdge)
      refuse(source, edge, "inside a polygon only, along whose edges one can cut");
  }
  return is_cut;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
