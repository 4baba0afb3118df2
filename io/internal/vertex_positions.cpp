#include "majorant/io/internal/vertex_positions.h"

#include <fmt/format.h>

#include <algorithm>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

// Vertices without a cell may exist, up to this number of a vertex, or this many times the points
// of the file. Origin: memory that a damaged file may ask for, 100 MB; chosen, not tuned.
constexpr long long kUnsuspicious = 1LL << 22;
constexpr long long kUnsuspiciousTimes = 4;

}  // namespace

std::vector<Vector3> vertex_positions(const MapFile& file,
                                      const Eigen::Ref<const Eigen::VectorXi>& vertex,
                                      const std::string& name) {
  const auto corners = file.cells.leftCols<3>();
  const Index largest = vertex(corners.reshaped()).maxCoeff();
  if (largest > std::max<long long>(kUnsuspicious, kUnsuspiciousTimes * file.points.rows()))
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: input_vertex {} in a map of {} points; damaged file", name,
                            largest, file.points.rows()));
  std::vector<Vector3> positions(at(largest) + 1, file.points.row(corners(0, 0)));
  std::vector<char> is_placed(positions.size(), 0);
  for (const Index point : corners.reshaped<Eigen::RowMajor>()) {
    const Vector3 position = file.points.row(point);
    const auto v = at(vertex[point]);
    if (is_placed[v] && positions[v] != position)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: input_vertex {} is at two places; damaged file", name, v));
    positions[v] = position;
    is_placed[v] = 1;
  }
  return positions;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
