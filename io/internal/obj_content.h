// The content of lines of an OBJ file, or of a piece of it: polygons and attributes, and the data
// to renumber and join them.
//
// Pieces that do not depend on earlier lines are read independently, and then appended.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/io/internal/dropped_parts.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// One of the three index spaces v, vt, vn: the number of elements so far. For v it also has the
// largest positive index in a face, which may point forward and is checked at the end.
struct ObjIndexSpace {
  std::string_view name;
  long long count = 0;
  long long largest = 0;
  long largest_line = 0;
};

// A point or a line.
struct ObjElement {
  std::size_t directive;
  Index largest;  // largest vertex index
  long line;
};

// Lines that do not concern polygons.
struct SkippedLines {
  static constexpr std::size_t kMaxNames = 8;  // number of keywords in the warning
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
  std::vector<Index> vertices_before;  // by directive
  SkippedLines skipped;
  bool counts_backwards = false;  // an index is negative
  long lines = 0;

  // Returns whether the content is independent of earlier lines: there are no negative indices and
  // no warnings, which name lines.
  bool is_independent() const {
    return !counts_backwards && dropped.is_empty() && skipped.count == 0;
  }
};

// A broken attribute, or a missing one of a vertex.
template <int N>
Eigen::Matrix<double, N, 1> no_attribute() {
  return Eigen::Matrix<double, N, 1>::Constant(std::numeric_limits<double>::quiet_NaN());
}

// Appends the content of the following lines.
void append(ObjContent& content, ObjContent&& next);

// Returns the mesh of all lines. Throws Error(Unreadable) for indices of faces that are out of
// range. Attributes and elements that are out of range are dropped and counted in the warnings of
// the mesh.
PolygonMesh conclude(ObjContent content);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
