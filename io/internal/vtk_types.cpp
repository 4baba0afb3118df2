#include "majorant/io/internal/vtk_types.h"

#include <map>

namespace majorant {

std::optional<VtkType> vtk_type(long long number) {
  using enum CellShape;
  constexpr auto kControl = NodeKind::ControlPoints;
  constexpr auto kUniform = NodeKind::Uniform;
  constexpr auto kCorners = NodeSet::Serendipity;
  static const std::map<long long, VtkType> kTypes{{1, {Point, 1}},
                                                   {3, {Segment, 1}},
                                                   {5, {Triangle, 1}},
                                                   {9, {Quad, 1}},
                                                   {10, {Tetrahedron, 1}},
                                                   {12, {Hexahedron, 1}},
                                                   {kLinearWedge, {Wedge, 1}},
                                                   {21, {Segment, 2}},
                                                   {22, {Triangle, 2}},
                                                   {24, {Tetrahedron, 2}},
                                                   {28, {Quad, 2}},
                                                   {29, {Hexahedron, 2}},
                                                   {32, {Wedge, 2}},
                                                   {23, {Quad, 2, kUniform, kCorners}},
                                                   {25, {Hexahedron, 2, kUniform, kCorners}},
                                                   {26, {Wedge, 2, kUniform, kCorners}},
                                                   {68, {Segment, 0}},
                                                   {69, {Triangle, 0}},
                                                   {70, {Quad, 0}},
                                                   {71, {Tetrahedron, 0}},
                                                   {72, {Hexahedron, 0}},
                                                   {73, {Wedge, 0}},
                                                   {75, {Segment, 0, kControl}},
                                                   {76, {Triangle, 0, kControl}},
                                                   {77, {Quad, 0, kControl}},
                                                   {78, {Tetrahedron, 0, kControl}},
                                                   {79, {Hexahedron, 0, kControl}},
                                                   {80, {Wedge, 0, kControl}}};
  const auto found = kTypes.find(number);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

bool is_vtk_pyramid(long long number) {
  return number == 14 || number == 27 || number == 37 || number == 74 || number == 81;
}

bool is_lattice_hexahedron(long long number) { return number == 72 || number == 79; }

int vtk_number(const CellType& type) {
  const int shape = static_cast<int>(type.shape);
  constexpr int kStraight[] = {1, 3, 5, 9, 10, 13, 12}, kQuadratic[] = {1, 21, 22, 28, 24, 32, 29},
                kLagrange[] = {1, 68, 69, 70, 71, 73, 72}, kBezier[] = {1, 75, 76, 77, 78, 80, 79},
                kSerendipity[] = {0, 0, 0, 23, 0, 26, 25};
  if (type.degree == 1) return kStraight[shape];
  if (type.set == NodeSet::Serendipity) return kSerendipity[shape];
  if (type.kind != NodeKind::Uniform) return kBezier[shape];
  return type.degree == 2 ? kQuadratic[shape] : kLagrange[shape];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
