#include <fmt/format.h>

#include <algorithm>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/msh_content.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

// Points of the surface that an image is a map of: those of the flat triangles between its corners.
void flatten(MapFile& map) {
  const auto indices = bezier_multi_indices(map.degree);
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (std::size_t k = 3; k < indices.size(); ++k) {
      Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        point += indices[k][i] * map.points.row(map.cells(c, static_cast<Index>(i)));
      map.points.row(map.cells(c, static_cast<Index>(k))) = point / map.degree;
    }
}

}  // namespace

MapFile read_msh(const std::string& path, const StopCheck& stop) {
  const MshContents contents = read_msh_contents(path, read_whole_file(path, stop), stop);
  const bool has_views = !contents.u.values.empty() && !contents.v.values.empty();
  const bool is_flat = std::all_of(contents.nodes.begin(), contents.nodes.end(),
                                   [](const auto& node) { return node[2].value == 0; });
  if (!has_views && !is_flat)
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: neither views u and v, nor nodes in the plane; no map", path));
  MapFile map;
  map.degree = contents.degree;
  map.cells = contents.cells;
  const auto count = static_cast<Index>(contents.nodes.size());
  map.points.resize(count, 3);
  map.uv.resize(count, 2);
  map.uv_rounding.resize(count, 2);
  for (Index p = 0; p < count; ++p) {
    const auto& node = contents.nodes[p];
    const MshNumber& u = has_views ? contents.u.values[p] : node[0];
    const MshNumber& v = has_views ? contents.v.values[p] : node[1];
    map.points.row(p) << node[0].value, node[1].value, node[2].value;
    map.uv.row(p) << u.value, v.value;
    map.uv_rounding.row(p) << u.rounding, v.rounding;
  }
  if (has_views) {
    map.input_vertex = contents.input_vertex;
    map.input_face = contents.input_face;
  } else {
    flatten(map);
    map.input_vertex = Eigen::VectorXi::LinSpaced(count, 0, count - 1);
  }
  if (const std::string defect = map_defect(map); !defect.empty())
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path, defect));
  take_as_lagrange_nodes(map, path, stop);
  return map;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
