// Edges that stay parallel to an axis: u or v constant along the control points of chosen
// half-edges, as feature lines and boundaries of maps for quadrangulation want it.
//
//   builder.add(AxisAlignment(space, {{12, 0}, {40, 1}}));  // u along half-edge 12, v along 40
//
// Composes with seams (align one side, the other follows) and with hard points. Edges that meet and
// hold the same coordinate share its value.
#pragma once

#include <memory>
#include <vector>

#include "majorant/elements/bezier_triangle_space.h"
#include "majorant/framework/constraint.h"

namespace majorant {

struct AlignedEdge {
  Index half_edge;  // 3 face + corner, as in surface_mesh.h
  int coordinate;   // 0: u is constant along it, 1: v
};

class AxisAlignment final : public Constraint {
 public:
  // Throws InvalidArgument for a half-edge or coordinate that does not exist.
  AxisAlignment(std::shared_ptr<const BezierTriangleSpace> space, std::vector<AlignedEdge> edges);
  void append_rows(ConstraintRows& rows) const override;

 private:
  std::shared_ptr<const BezierTriangleSpace> space_;
  std::vector<AlignedEdge> edges_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
