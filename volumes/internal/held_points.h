// What of a mesh stays where it is: control points on its boundary, between its regions and on the
// cells of fewer dimensions that its file names; and the elements that these alone make invalid.
#pragma once

#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/volumes/internal/control_net.h"
#include "majorant/volumes/optimize_volume_mesh.h"

namespace majorant {

// Rows n . x = n . p of points that stay in planes.
class HeldPoints final : public Constraint {
 public:
  // x: the control points of the net.
  HeldPoints(const VolumeMesh& mesh, const std::vector<CellSide>& sides, const ControlNet& net,
             VecIn x, VolumeBoundary boundary);

  void append_rows(ConstraintRows& rows) const override;

  // Lets go of the control points of these cells, but of what others hold.
  void release(const std::vector<CellName>& cells, const HeldPoints& others);

  // Flags the coordinates of control points that stay.
  const std::vector<char>& held() const { return held_; }
  // True where nothing of a control point stays, in no plane either.
  bool is_free(Index point) const;
  Index sides() const { return sides_; }                // that are held
  Index curved_sides() const { return curved_sides_; }  // of these under Slide: in no plane

  // Cells with det J <= 0 at a point that no point which may move has any part in.
  std::vector<CellName> impossible_cells(const VolumeMesh& mesh) const;

 private:
  class Planes;
  void hold_boundary(const VolumeMesh& mesh, const std::vector<CellSide>& sides,
                     VolumeBoundary boundary);
  void hold(Index point);
  void hold_pieces();

  const ControlNet& net_;
  Vec x_;
  std::vector<char> held_;
  struct PlaneRow {
    Index point;
    Vector3 normal;
  };
  std::vector<PlaneRow> rows_;
  Index sides_ = 0, curved_sides_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
