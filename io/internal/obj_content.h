// What the lines of an OBJ file, or of a piece of it, hold: polygons and attributes as they stand,
// and what is needed to number, join and complete them.
//
// Pieces that are independent of the lines before are read by themselves, and appended.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/io/internal/dropped_parts.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// One of the three index spaces v, vt, vn: how many elements there are so far, and of v the largest
// positive index of a face yet, which may point forward and is checked at the end.
struct ObjIndexSpace {
  std::string_view name;
  long long count = 0;
  long long largest = 0;
  long largest_line = 0;
};

// A point or a line that is kept.
struct ObjElement {
  std::size_t directive;
  Index largest;  // vertex
  long line;
};

// Lines that say nothing about polygons.
struct SkippedLines {
  static constexpr std::size_t kMaxNames = 8;  // keywords in the warning
  std::vector<std::string> names;              // in quotes
  long count = 0, first = 0;
};

struct ObjContent {
  ObjContent(const std::string& file, Strictness strictness) : dropped(strictness) {
    mesh.file = file;
  }

  PolygonMesh mesh;
  std::array<ObjIndexSpace, 3> spaces = {ObjIndexSpace{"v"}, ObjIndexSpace{"vt"},
                                         ObjIndexSpace{"vn"}};
  DroppedParts dropped;
  std::vector<ObjElement> elements;
  std::vector<Index> vertices_before;  // every directive
  SkippedLines skipped;
  bool counts_backwards = false;  // an index does
  long lines = 0;

  // True where nothing depends on the lines before: indices that count backwards, and warnings,
  // which name lines.
  bool is_independent() const {
    return !counts_backwards && dropped.is_empty() && skipped.count == 0;
  }
};

// A broken attribute, or one that a vertex does not have.
template <int N>
Eigen::Matrix<double, N, 1> no_attribute() {
  return Eigen::Matrix<double, N, 1>::Constant(std::numeric_limits<double>::quiet_NaN());
}

// Adds the lines that follow.
void append(ObjContent& content, ObjContent&& next);

// The mesh of all lines. Throws Error(Unreadable) for indices of faces that are out of range; drops
// attributes and elements that are, which are counted in the warnings of the mesh.
PolygonMesh conclude(ObjContent content);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
