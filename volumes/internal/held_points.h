// The fixed part of a mesh: nodes on its boundary, between its regions and on the lower-dimensional
// cells that its file names. It also finds the elements that these nodes alone make invalid.
#pragma once

#include <optional>
#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/volumes/internal/control_net.h"
#include "majorant/volumes/internal/curved_boundary.h"
#include "majorant/volumes/optimize_volume_mesh.h"

namespace majorant {

// The rows of fixed nodes, as sums of control points, and n . x = n . p for control points that
// stay in planes.
class HeldPoints final : public Constraint {
 public:
  // x: the control points of the net. Free holds only sides that are equal up to a translation, and
  // one point of each connected piece.
  HeldPoints(const VolumeMesh& mesh, const std::vector<CellSide>& sides, const ControlNet& net,
             VecIn x, VolumeBoundary boundary);

  void append_rows(ConstraintRows& rows) const override;

  // Holds all nodes except those of these cells.
  void hold_all_but(const std::vector<CellName>& cells);
  // Lets nodes of curved sides slide, under Slide: at x they are held to the tangents of the
  // original sides. All other nodes stay at x.
  void let_slide(VecIn x);
  // Moves sliding nodes back to the original sides. nodes: #control points by dim().
  void put_back(RowMatrix& nodes) const;
  bool has_sliding() const { return !sliding_.empty(); }
  // Releases the nodes of these cells, except those that `others` holds.
  void release(const std::vector<CellName>& cells, const HeldPoints& others);

  // Flags of the fixed coordinates of nodes, at the places of their control points.
  const std::vector<char>& held() const { return held_; }
  // Returns true if the node of a control point is held in no direction.
  bool is_free(Index point) const;
  Index sides() const { return sides_; }                // that are held
  Index curved_sides() const { return curved_sides_; }  // under Slide: held sides in no plane

  // Returns the cells with det J <= 0 at a point on which no movable control point has an
  // influence.
  std::vector<CellName> impossible_cells(const VolumeMesh& mesh) const;

 private:
  class Planes;
  void hold_boundary(const VolumeMesh& mesh, const std::vector<CellSide>& sides,
                     VolumeBoundary boundary);
  void hold(Index point);
  void hold_periodic(const VolumeMesh& mesh, const std::vector<CellSide>& sides);
  void hold_pieces();
  // Returns true if a coordinate of a control point is fixed: that of its node is, and those of all
  // other control points in the node's sum are.
  bool is_still(Index point, int axis) const;

  const ControlNet& net_;
  Vec x_;
  std::vector<char> held_;
  struct PlaneRow {
    Index point;
    Vector3 normal;
    bool is_of_node = false;  // otherwise of the control point
  };
  std::vector<PlaneRow> rows_;
  Index sides_ = 0, curved_sides_ = 0;
  std::optional<CurvedBoundary> curved_;
  std::vector<Index> sliding_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
