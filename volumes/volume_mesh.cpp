#include "majorant/volumes/volume_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace majorant {
namespace {

struct ShapeFacts {
  int dimension, corners;
  std::string_view plural;
};

// In the order of CellShape.
constexpr std::array<ShapeFacts, 7> kShapes{{{0, 1, "points"},
                                             {1, 2, "segments"},
                                             {2, 3, "triangles"},
                                             {2, 4, "quads"},
                                             {3, 4, "tetrahedra"},
                                             {3, 6, "wedges"},
                                             {3, 8, "hexahedra"}}};

const ShapeFacts& facts(CellShape shape) { return kShapes[static_cast<std::size_t>(shape)]; }

}  // namespace

int dimension(CellShape shape) { return facts(shape).dimension; }
int corner_count(CellShape shape) { return facts(shape).corners; }
std::string_view plural_of(CellShape shape) { return facts(shape).plural; }

int CellType::node_count() const {
  const int n = degree, triangle = (n + 1) * (n + 2) / 2;
  const bool is_full = set == NodeSet::Full;
  switch (shape) {
    case CellShape::Point:
      return 1;
    case CellShape::Segment:
      return n + 1;
    case CellShape::Triangle:
      return triangle;
    case CellShape::Quad:
      return is_full ? (n + 1) * (n + 1) : 8;
    case CellShape::Tetrahedron:
      return triangle * (n + 3) / 3;
    case CellShape::Wedge:
      return is_full ? triangle * (n + 1) : 15;
    case CellShape::Hexahedron:
      return is_full ? (n + 1) * (n + 1) * (n + 1) : 20;
  }
  return 0;
}

std::string describe(const CellType& type) {
  return fmt::format("{} of degree {}{}", plural_of(type.shape), type.degree,
                     type.set == NodeSet::Serendipity ? " (serendipity)" : "");
}

int VolumeMesh::dimension() const {
  int largest = 0;
  for (const CellBlock& block : blocks)
    largest = std::max(largest, majorant::dimension(block.type.shape));
  return largest;
}

bool VolumeMesh::is_planar() const {
  return points.rows() == 0 || (points.col(2).array() == points(0, 2)).all();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
