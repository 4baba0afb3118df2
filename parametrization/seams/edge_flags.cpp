#include "majorant/parametrization/seams/edge_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

enum class EdgeKind { None, InsidePolygon, Edge };

[[noreturn]] void refuse_edge(const std::string& source, const std::pair<Index, Index>& edge,
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
  std::map<std::pair<Index, Index>, EdgeKind> kinds;
  for (const auto& [a, b] : edges) kinds[std::minmax(a, b)] = EdgeKind::None;
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    const auto edge = kinds.find(
        std::minmax(mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))));
    if (edge == kinds.end()) continue;
    if (o >= 0 && mesh.input_face(face_of(h)) == mesh.input_face(face_of(o))) {
      edge->second = std::max(edge->second, EdgeKind::InsidePolygon);
    } else {
      edge->second = EdgeKind::Edge;
      is_cut[h] = o >= 0;
    }
  }
  for (const auto& [edge, kind] : kinds) {
    if (kind == EdgeKind::None)
      refuse_edge(source, edge,
                  "by no edge of " + (mesh.file().empty() ? "the mesh" : mesh.file()));
    if (kind == EdgeKind::InsidePolygon)
      refuse_edge(source, edge, "only inside a polygon, which has no edge there");
  }
  return is_cut;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
