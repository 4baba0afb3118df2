// Points and single unknowns that are held exactly, by elimination.
//
//   builder.add(FixedPoints({{12, {0.1, 0.2}}}));                 // node 12, of the plane
//   builder.add(FixedUnknowns({{3 * 12 + 2, 0.5}}));              // z of node 12, in space
//
// Not for what may give way: QuadraticPenalty (terms/quadratic_penalty.h) makes either soft.
#pragma once

#include <utility>
#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/framework/types.h"

namespace majorant {

// Control points held at given positions by elimination.
//
//   builder.add(FixedPoints({{12, {0.1, 0.2}}}));                 // a pin in the plane
//   builder.add(FixedPoints::at({12, 13, 14}, x));                // held where x has them
//   builder.add(FixedPoints::in_space({{7, {0.1, 0.2, 0.3}}}));   // 3 unknowns a node
//
// A problem whose terms have nodes of another dimension refuses them, with InvalidArgument.

struct FixedPoint {
  Index node;
  Vector2 position;
};
struct FixedPoint3 {
  Index node;
  Vector3 position;
};

class FixedPoints final : public Constraint {
 public:
  explicit FixedPoints(const std::vector<FixedPoint>& points);
  static FixedPoints in_space(std::vector<FixedPoint3> points);
  // Holds `nodes` where x has them, which has `dim` numbers per node. Throws InvalidArgument for a
  // node that x does not have, and unless dim is 2 or 3.
  static FixedPoints at(const std::vector<Index>& nodes, VecIn x, int dim = 2);

  void append_rows(ConstraintRows& rows) const override;

 private:
  FixedPoints(std::vector<FixedPoint3> points, int dim) : points_(std::move(points)), dim_(dim) {}
  std::vector<FixedPoint3> points_;  // of the plane: z is not looked at
  int dim_;
};

// Hard constraints on single unknowns, whatever they are: coordinates of nodes of any dimension.
//
//   const std::vector<FixedUnknown> held{{3 * 12 + 2, 0.5}};                     // z of node 12
//   builder.add(FixedUnknowns(held));
//   builder.add(std::make_shared<QuadraticPenalty>(FixedUnknowns(held)), 1e3);   // the same, soft
//
// For points of the plane or of space FixedPoints is shorter.

struct FixedUnknown {
  Index unknown;  // of the full unknowns x
  double value;
};

class FixedUnknowns final : public Constraint {
 public:
  explicit FixedUnknowns(std::vector<FixedUnknown> unknowns) : unknowns_(std::move(unknowns)) {}
  void append_rows(ConstraintRows& rows) const override;

 private:
  std::vector<FixedUnknown> unknowns_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
