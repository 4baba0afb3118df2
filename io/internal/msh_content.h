// What a .msh file holds, before anything is made of it: for read_msh and for meshes.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// gmsh's complete triangles: element type and degree; nodes in VTK's order.
inline constexpr std::array<std::pair<int, int>, 10> kMshTriangles = {
    {{2, 1}, {9, 2}, {21, 3}, {23, 4}, {25, 5}, {42, 6}, {43, 7}, {44, 8}, {45, 9}, {46, 10}}};

// A number as it was read; rounding: how far its decimals may be from the double.
struct MshNumber {
  double value = 0, rounding = 0;
};

// One number per node.
struct MshView {
  std::vector<MshNumber> values;  // empty: there is no such view
};

// Sections of our own, which other programs pass over: of every node the vertex, of every element
// the face of the input that it is, as the arrays of the same names in a .vtu.
inline constexpr std::string_view kMshInputVertex = "input_vertex", kMshInputFace = "input_face";

struct MshContents {
  int degree = 1;
  std::vector<std::array<MshNumber, 3>> nodes;  // in the order of their tags
  Cells cells;                                  // #F by (n+1)(n+2)/2 nodes, by element tag
  MshView u, v;
  Eigen::VectorXi input_vertex, input_face;  // by node, by element; empty: not there
};

// `content`: the bytes of the file. Throws Error(Unreadable, "file:line: ..."); Stopped.
MshContents read_msh_contents(const std::string& path, std::string content, const StopCheck& stop);

// The straight triangles between the corners; u and v, where they are there, as texture
// coordinates. Nodes that are no corner are left out. Throws as read_msh_contents.
PolygonMesh read_msh_mesh(const std::string& path, std::string content, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
