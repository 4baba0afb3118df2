#include "majorant/parametrization/maps/bezier_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace majorant {

std::vector<Index> opposite_half_edges(const Cells& faces) {
  const Index count = 3 * static_cast<Index>(faces.rows());
  std::vector<std::array<Index, 3>> edges;  // smaller vertex, larger vertex, half-edge
  for (Index h = 0; h < count; ++h) {
    const Index a = faces(h / 3, h % 3), b = faces(h / 3, (h + 1) % 3);
    edges.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(edges.begin(), edges.end());
  const auto same = [&](std::size_t i, std::size_t j) {
    return j < edges.size() && edges[i][0] == edges[j][0] && edges[i][1] == edges[j][1];
  };
  std::vector<Index> opposite(static_cast<std::size_t>(count), -1);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (!same(k, k + 1)) continue;
    const Index h = edges[k][2], o = edges[k + 1][2];
    if (same(k, k + 2) || faces(h / 3, h % 3) == faces(o / 3, o % 3))
      throw std::invalid_argument(
          fmt::format("opposite_half_edges: edge ({}, {}) has more than two faces, or two that run "
                      "the same way",
                      edges[k][0], edges[k][1]));
    opposite[static_cast<std::size_t>(h)] = o;
    opposite[static_cast<std::size_t>(o)] = h;
  }
  return opposite;
}

BezierMesh bezier_mesh(int degree, const Cells& faces, const Cells& cells, VecIn x) {
  BezierMesh mesh;
  mesh.degree = degree;
  mesh.faces = faces;
  mesh.opposite = opposite_half_edges(faces);
  mesh.points.resize(cells.rows(), 2 * cells.cols());
  for (Index f = 0; f < cells.rows(); ++f)
    for (Index l = 0; l < cells.cols(); ++l)
      mesh.points.row(f).segment<2>(2 * l) = x.segment<2>(2 * cells(f, l));
  return mesh;
}

}  // namespace majorant
