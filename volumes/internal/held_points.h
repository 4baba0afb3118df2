// The part of a mesh that stays where it is: nodes on its boundary, between its regions and on the
// cells of fewer dimensions that its file names; and the elements that these alone make invalid.
#pragma once

#include <optional>
#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/volumes/internal/control_net.h"
#include "majorant/volumes/internal/curved_boundary.h"
#include "majorant/volumes/optimize_volume_mesh.h"

namespace majorant {

// Rows of nodes that stay, as sums of control points, and n . x = n . p of control points that stay
// in planes.
class HeldPoints final : public Constraint {
 public:
  // x: the control points of the net. Free holds nothing but sides that are equal up to a
  // translation, and one point of each connected piece.
  HeldPoints(const VolumeMesh& mesh, const std::vector<CellSide>& sides, const ControlNet& net,
             VecIn x, VolumeBoundary boundary);

  void append_rows(ConstraintRows& rows) const override;

  // Holds all nodes but those of these cells.
  void hold_all_but(const std::vector<CellName>& cells);
  // Lets nodes of curved sides slide, under Slide: these are held in their tangents, where they
  // are at x, of the sides as they were. Everything else stays where it is at x.
  void let_slide(VecIn x);
  // Moves the nodes that slide from where they are to the sides as they were: #control points by
  // dim().
  void put_back(RowMatrix& nodes) const;
  bool has_sliding() const { return !sliding_.empty(); }
  // Lets go of the nodes of these cells, but of what others hold.
  void release(const std::vector<CellName>& cells, const HeldPoints& others);

  // Flags the coordinates of nodes that stay, at the places of their control points.
  const std::vector<char>& held() const { return held_; }
  // True where nothing of the node at a control point stays, in no plane either.
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
  void hold_periodic(const VolumeMesh& mesh, const std::vector<CellSide>& sides);
  void hold_pieces();
  // True where the coordinate of a control point stays: that of its node does, and those of all
  // others that the node is a sum of.
  bool is_still(Index point, int axis) const;

  const ControlNet& net_;
  Vec x_;
  std::vector<char> held_;
  struct PlaneRow {
    Index point;
    Vector3 normal;
    bool is_of_node = false;  // else of the control point
  };
  std::vector<PlaneRow> rows_;
  Index sides_ = 0, curved_sides_ = 0;
  std::optional<CurvedBoundary> curved_;
  std::vector<Index> sliding_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
