// Control points where the straight cells of their corners have them: a mesh of fewer unknowns,
// which folds in fewer ways.
#pragma once

#include "majorant/framework/constraint.h"
#include "majorant/volumes/internal/held_points.h"

namespace majorant {

// Rows N x = sum of w_c x_c over the corners c of a cell, of points that nothing holds; integers.
class StraightPoints final : public Constraint {
 public:
  // All three must outlive this.
  StraightPoints(const VolumeMesh& mesh, const ControlNet& net, const HeldPoints& held)
      : mesh_(mesh), net_(net), held_(held) {}

  void append_rows(ConstraintRows& rows) const override;

 private:
  const VolumeMesh& mesh_;
  const ControlNet& net_;
  const HeldPoints& held_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
