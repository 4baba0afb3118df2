#include "majorant/parametrization/cuts/internal/given_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

enum class Found { Nothing, InnerEdge, Edge };

[[noreturn]] void refuse(const SurfaceMesh& mesh, const std::pair<Index, Index>& edge,
                         const char* what) {
  throw Error(ErrorKind::Usage, fmt::format("{}: seams: vertices {} and {} (counting from 0) {}",
                                            mesh.file(), edge.first, edge.second, what));
}

}  // namespace

std::vector<char> flags_of_edges(const SurfaceMesh& mesh,
                                 const std::vector<std::array<Index, 2>>& edges) {
  std::map<std::pair<Index, Index>, Found> wanted;
  for (const auto& [a, b] : edges) wanted[std::minmax(a, b)] = Found::Nothing;
  std::vector<char> is_cut(at(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    const auto edge = wanted.find(
        std::minmax(mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))));
    if (edge == wanted.end()) continue;
    if (o >= 0 && mesh.input_face(face_of(h)) == mesh.input_face(face_of(o))) {
      edge->second = std::max(edge->second, Found::InnerEdge);
    } else {
      edge->second = Found::Edge;
      is_cut[at(h)] = o >= 0;
    }
  }
  for (const auto& [edge, found] : wanted) {
    if (found == Found::Nothing)
      refuse(mesh, edge, "are not joined by an edge; correct the list of seams");
    if (found == Found::InnerEdge)
      refuse(mesh, edge, "are joined inside a polygon only; cut along its edges");
  }
  return is_cut;
}

}  // namespace majorant
