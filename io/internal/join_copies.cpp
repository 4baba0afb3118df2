#include "majorant/io/internal/join_copies.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"

namespace majorant {

void join_copies(PolygonMesh& mesh, const std::vector<Index>& copy_of) {
  const auto damaged = [&](std::string_view problem) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: input_vertex {}; damaged file", mesh.file, problem));
  };
  const Index largest = *std::max_element(copy_of.begin(), copy_of.end());
  if (to_size(largest) >= copy_of.size()) damaged(fmt::format("{} is out of range", largest));
  std::vector<Index> first(to_size(largest) + 1, -1);
  for (std::size_t k = 0; k < copy_of.size(); ++k) {
    Index& original = first[copy_of[k]];
    if (original < 0) original = static_cast<Index>(k);
    if (mesh.positions[original] != mesh.positions[k])
      damaged(fmt::format("{} is at two places", copy_of[k]));
  }
  std::vector<Vector3> positions, colors;
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] < 0) damaged(fmt::format("{} is missing", v));
    positions.push_back(mesh.positions[first[v]]);
    if (!mesh.colors.empty()) colors.push_back(mesh.colors[first[v]]);
  }
  mesh.positions = std::move(positions);
  mesh.colors = std::move(colors);
  for (auto& polygon : mesh.polygons)
    for (Index& v : polygon) v = copy_of[v];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
