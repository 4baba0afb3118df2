#include "majorant/mesh/half_edge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "majorant/framework/error.h"
#include "majorant/mesh/union_find.h"

namespace majorant {

std::vector<Index> opposite_half_edges(const Cells& faces) {
  if (faces.rows() > 0 && faces.cols() != 3)
    throw InvalidArgument(
        fmt::format("opposite_half_edges: faces have {} columns, 3 are needed", faces.cols()));
  const Index count = 3 * static_cast<Index>(faces.rows());
  std::vector<std::array<Index, 3>> edges;  // smaller vertex, larger vertex, half-edge
  for (Index h = 0; h < count; ++h) {
    const auto [low, high] = std::minmax({from_vertex(faces, h), to_vertex(faces, h)});
    edges.push_back({low, high, h});
  }
  std::sort(edges.begin(), edges.end());
  const auto same = [&](std::size_t i, std::size_t j) {
    return j < edges.size() && edges[i][0] == edges[j][0] && edges[i][1] == edges[j][1];
  };
  std::vector<Index> opposite(to_size(count), -1);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (!same(k, k + 1)) continue;
    const Index h = edges[k][2], o = edges[k + 1][2];
    if (same(k, k + 2) || from_vertex(faces, h) == from_vertex(faces, o))
      throw InvalidArgument(
          fmt::format("opposite_half_edges: edge ({}, {}) has more than two faces, or two that run "
                      "the same way",
                      edges[k][0], edges[k][1]));
    opposite[h] = o;
    opposite[o] = h;
  }
  return opposite;
}

std::vector<std::vector<Index>> boundary_half_edges(const Cells& faces,
                                                    const std::vector<Index>& opposite) {
  std::map<Index, Index> leaving;  // vertex -> boundary half-edge
  for (Index h = 0; h < static_cast<Index>(opposite.size()); ++h)
    if (opposite[h] < 0) leaving[from_vertex(faces, h)] = h;
  std::vector<std::vector<Index>> loops;
  while (!leaving.empty()) {
    std::vector<Index> loop;
    for (auto it = leaving.begin(); it != leaving.end();) {
      loop.push_back(it->second);
      leaving.erase(it);
      it = leaving.find(to_vertex(faces, loop.back()));
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<Index> face_components(const std::vector<Index>& opposite) {
  const auto count = static_cast<Index>(opposite.size()) / 3;
  UnionFind sets(count);
  for (Index h = 0; h < 3 * count; ++h)
    if (opposite[h] >= 0) sets.join(face_of(h), face_of(opposite[h]));
  std::vector<Index> component;
  Index next_number = 0;
  for (Index f = 0; f < count; ++f)  // a set is named by its first face
    component.push_back(sets.find(f) == f ? next_number++ : component[sets.find(f)]);
  return component;
}

// Corners go by the half-edges that leave them; those of one fan are joined across its edges.
Index find_touching_vertex(const Cells& faces, const std::vector<Index>& opposite) {
  const auto count = static_cast<Index>(opposite.size());
  UnionFind fans(count);
  for (Index h = 0; h < count; ++h)
    if (opposite[h] >= 0) fans.join(h, next(opposite[h]));
  std::vector<Index> fan_of;  // by vertex, -1: not met
  Index touching = -1;
  for (Index h = 0; h < count; ++h) {
    const Index v = from_vertex(faces, h);
    if (to_size(v) >= fan_of.size()) fan_of.resize(to_size(v) + 1, -1);
    if (fan_of[v] < 0) fan_of[v] = fans.find(h);
    if (fan_of[v] != fans.find(h) && (touching < 0 || v < touching)) touching = v;
  }
  return touching;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
